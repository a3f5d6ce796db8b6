#pragma once

#include <string>

#include "app/terminal/program_description.h"

namespace vitrel {

/// The manual page in section 1, as roff with the macros `man`.
std::string manual_page(const ProgramDescription& program);

}  // namespace vitrel
