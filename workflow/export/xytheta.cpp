#include "workflow/export/xytheta.h"

#include <fmt/format.h>

#include <iterator>

namespace vitrel {

void XyThetaSink::write(const StoredFrame<2>& frame) {
  const Configuration2& configuration = frame.configuration;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{}", configuration.time);
  for (std::size_t i = 0; i < configuration.size(); ++i)
    fmt::format_to(out, " {} {} {}", configuration.position[i].x(), configuration.position[i].y(),
                   configuration.angle[i]);
  text.push_back('\n');
  file_.write({text.data(), text.size()});
}

}  // namespace vitrel
