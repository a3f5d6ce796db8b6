#include "core/io/json.h"

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace vitrel {

std::string json_text(const Json& json, int indent, JsonCharacters characters) {
  return json.dump(indent, ' ', characters == JsonCharacters::ascii,
                   Json::error_handler_t::replace);
}

double number_or(const Json& json, double if_null) {
  return json.is_null() ? if_null : json.get<double>();
}

Json parse_json(std::string_view text, const std::string& file) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw FileError(file + ": is not JSON: " + error.what());
  }
}

}  // namespace vitrel
