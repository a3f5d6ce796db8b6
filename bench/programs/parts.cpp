#include "bench/programs/parts.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/terminal/session.h"
#include "core/io/json.h"

namespace vitrel::bench {

void say(const std::string& what) {
  fmt::print(stderr, "{}\n", what);
}

void print(const Json& result) {
  fmt::print("{}\n", json_text(result, 2));
  flush_output();
}

}  // namespace vitrel::bench
