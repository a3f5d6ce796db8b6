#pragma once

#include <string>

namespace vitrel {

/// One property of a state in readable form.
struct QualityRow {
  std::string name;
  std::string value;
  std::string remark;  ///< how it was found, or what to compare it with; may be empty
};

}  // namespace vitrel
