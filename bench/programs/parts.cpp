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
  print_text(json_text(result, 2) + '\n');
}

}  // namespace vitrel::bench
