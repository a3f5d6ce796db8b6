#include "app/commands/bench.h"

#include <unistd.h>

#include <filesystem>

#include "app/terminal/exit_codes.h"

namespace vitrel {

int bench_command(char** words) {
  namespace fs = std::filesystem;
  static char name[] = "vitrel-bench";
  words[0] = name;
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& program : {folder / name, folder / "../bench" / name})
    execv(program.c_str(), words);
  execvp(name, words);
  return complain("vitrel bench",
                  "cannot find vitrel-bench beside this program or on PATH; build it with cmake "
                  "-DVITREL_BUILD_BENCH=ON, target vitrel-bench",
                  user_error);
}

}  // namespace vitrel
