#include "workflow/storage/checkpoint_items.h"

#include <fmt/format.h>

#include "core/error.h"

namespace vitrel {
namespace {

template <class Map>
const typename Map::mapped_type& find(const Map& items, const std::string& name,
                                      const std::filesystem::path& file) {
  const auto found = items.find(name);
  if (found == items.end())
    throw FileError(
        fmt::format("{}: is no checkpoint of this kind of work: '{}' is missing; delete "
                    "it to start anew",
                    file.string(), name));
  return found->second;
}

}  // namespace

void ItemReader::operator()(const std::string& name, double& value) const {
  value = find(checkpoint_.reals, name, file_);
}

void ItemReader::operator()(const std::string& name, std::uint64_t& value) const {
  value = find(checkpoint_.counters, name, file_);
}

void ItemReader::operator()(const std::string& name, bool& value) const {
  value = find(checkpoint_.counters, name, file_) != 0;
}

void ItemReader::operator()(const std::string& name, std::string& value) const {
  value = find(checkpoint_.texts, name, file_);
}

void ItemReader::operator()(const std::string& name, std::vector<double>& value) const {
  value = find(checkpoint_.series, name, file_);
}

void ItemReader::if_recorded(const std::string& name, double& value) const {
  if (checkpoint_.reals.contains(name)) (*this)(name, value);
}

void ItemReader::if_recorded(const std::string& name, std::uint64_t& value) const {
  if (checkpoint_.counters.contains(name)) (*this)(name, value);
}

void ItemReader::if_recorded(const std::string& name, bool& value) const {
  if (checkpoint_.counters.contains(name)) (*this)(name, value);
}

void ItemReader::if_recorded(const std::string& name, std::vector<double>& value) const {
  if (checkpoint_.series.contains(name)) (*this)(name, value);
}

}  // namespace vitrel
