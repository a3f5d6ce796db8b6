#include "app/commands/commands.h"

#include <unistd.h>

#include <filesystem>

#include "app/terminal/exit_codes.h"
#include "core/error.h"

namespace vitrel {

void become_bench(const std::vector<std::string>& words) {
  namespace fs = std::filesystem;
  const std::string name = "vitrel-bench";
  std::vector<char*> arguments = {const_cast<char*>(name.c_str())};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& program : {folder / name, folder / "../bench" / name})
    static_cast<void>(execv(program.c_str(), arguments.data()));  // returns only if it fails
  static_cast<void>(execvp(name.c_str(), arguments.data()));
  throw UserError(
      "cannot find vitrel-bench beside this program or on PATH; install its package, or build it "
      "with cmake -DVITREL_BUILD_BENCH=ON, target vitrel-bench");
}

int bench_command(char** words) {
  std::vector<std::string> rest;
  for (char** word = words + 1; *word; ++word) rest.emplace_back(*word);
  return exit_code_of("vitrel bench", [&]() -> int { become_bench(rest); });
}

}  // namespace vitrel
