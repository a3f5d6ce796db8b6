#include "app/terminal/style.h"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace vitrel {
namespace {

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

bool is_terminal(int descriptor) {
  const std::string_view kind = environment("TERM");
  return isatty(descriptor) != 0 && !kind.empty() && kind != "dumb";
}

std::string styled(const std::string& text, Style style, int descriptor) {
  if (!is_terminal(descriptor) || !environment("NO_COLOR").empty()) return text;
  return (style == Style::error ? "\033[1;31m" : "\033[1m") + text + "\033[0m";
}

}  // namespace vitrel
