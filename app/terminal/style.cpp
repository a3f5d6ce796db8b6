#include "app/terminal/style.h"

#include <fmt/format.h>
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

std::string visible(std::string_view text) {
  std::string shown;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const auto next = k + 1 < text.size() ? static_cast<unsigned char>(text[k + 1]) : 0;
    const bool is_c1 = byte == 0xC2 && next >= 0x80 && next < 0xA0;  // C1 controls in UTF-8
    if (is_c1) ++k;
    if (is_c1 || (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7F)
      shown += fmt::format("\\x{:02x}", is_c1 ? next : byte);
    else
      shown += text[k];
  }
  return shown;
}

bool is_terminal(int descriptor) {
  const std::string_view kind = environment("TERM");
  return isatty(descriptor) != 0 && !kind.empty() && kind != "dumb";
}

std::string styled(const std::string& text, Style style, int descriptor) {
  if (!is_terminal(descriptor) || !environment("NO_COLOR").empty()) return text;
  return (style == Style::error ? "\033[1;31m" : "\033[1m") + text + "\033[0m";
}

}  // namespace vitrel
