#include "workflow/export/pending_folder.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "core/error.h"

namespace vitrel {
namespace fs = std::filesystem;

PendingFolder::PendingFolder(fs::path folder) : folder_(std::move(folder)), partial_(folder_) {
  partial_ += ".partial";
  std::error_code error;
  fs::remove_all(partial_, error);
  if (!fs::create_directory(partial_, error))
    throw FileError(fmt::format("{}: cannot be made: {}", partial_.string(), error.message()));
}

PendingFolder::~PendingFolder() {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
}

void PendingFolder::commit() {
  std::error_code error;
  fs::rename(partial_, folder_, error);
  if (error)
    throw FileError(fmt::format("{}: cannot rename {} to it: {}", folder_.string(),
                                partial_.string(), error.message()));
}

}  // namespace vitrel
