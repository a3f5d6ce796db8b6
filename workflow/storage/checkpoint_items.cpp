#include "workflow/storage/checkpoint_items.h"

#include <fmt/format.h>

#include "core/error.h"

namespace vitrel {

void ItemReader::refuse_without(const std::string& name) const {
  throw FileError(
      fmt::format("{}: is no checkpoint of this kind of work: '{}' is missing; delete "
                  "it to start anew",
                  file_.string(), name));
}

}  // namespace vitrel
