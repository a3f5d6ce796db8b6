#pragma once

#include <string_view>

namespace vitrel::bench {

/// The content of a file of bench that is compiled into the program ("pages/page.html"). Throws std::logic_error for
/// any other file.
std::string_view asset(std::string_view path);

}  // namespace vitrel::bench
