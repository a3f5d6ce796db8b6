#pragma once

#include <string_view>

namespace vitrel::sweep_templates {

/// The content of a file of this folder that is compiled into the program ("sweep/export/Snakefile"). Throws
/// std::logic_error for any other file.
std::string_view asset(std::string_view path);

}  // namespace vitrel::sweep_templates
