#include "workflow/export/pending_folder.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/io/atomic_file.h"

namespace vitrel {
namespace fs = std::filesystem;

PendingFolder::PendingFolder(fs::path folder)
    : folder_(std::move(folder)), partial_(make_partial_folder(folder_)) {}

PendingFolder::~PendingFolder() {
  std::error_code ignored;
  if (!partial_.empty()) fs::remove_all(partial_, ignored);
}

void PendingFolder::commit() {
  std::error_code error;
  fs::rename(partial_, folder_, error);
  if (error)
    throw FileError(fmt::format("{}: cannot rename {} to it: {}", folder_.string(),
                                partial_.string(), error.message()));
  partial_.clear();
}

}  // namespace vitrel
