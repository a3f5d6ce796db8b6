// Damages files at random and has the program read them: no crash, no hang, one short message and a known exit code.
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <optional>
#include <thread>

#include "core/io/checked.h"
#include "core/random/stream.h"
#include "tests/fuzz/execution.h"
#include "tests/fuzz/targets.h"

namespace vitrel::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr double max_seconds = 5;  // of processor time, for one input
constexpr std::uint64_t inputs_per_process = 1000;
constexpr int finding_code = 99;

struct Options {
  std::string target;
  std::uint64_t inputs = 1000, first = 0, seed = 1;
  fs::path keep;
};

/// What the process that reads files tells the one that watches it.
struct Shared {
  std::atomic<std::uint64_t> input;
  std::atomic<double> begun;  ///< processor time at its start
  char finding[4096];
};

Shared& make_shared_memory() {
  void* const memory =
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no memory to share");
  return *new (memory) Shared{};
}

double processor_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What is wrong with an outcome, if anything.
std::optional<std::string> complaint(const Outcome& outcome) {
  constexpr std::ptrdiff_t max_lines = 3;
  if (outcome.code < 0 || outcome.code > 5 || outcome.code == 1)
    return fmt::format("exit code {}", outcome.code);
  const std::ptrdiff_t lines = std::ranges::count(outcome.errors, '\n');
  if (outcome.code != 0 && lines == 0) return "no message";
  if (outcome.code != 0 && lines > max_lines) return fmt::format("{} lines", lines);
  return std::nullopt;
}

/// In a process of its own. Ends at the first finding.
[[noreturn]] void read_inputs(const Target& target, const Options& options, std::uint64_t first,
                              std::uint64_t last, Shared& shared) {
  for (std::uint64_t input = first; input < last; ++input) {
    shared.begun = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    shared.input = input;
    Stream stream(options.seed, Purpose::tests, 0, input);
    const std::vector<std::string>& command = write_input(target, stream);
    std::snprintf(shared.finding, sizeof shared.finding, "%s", command_line(command).c_str());
    const Outcome outcome = execute(command);
    if (const auto what = complaint(outcome)) {
      const std::string text =
          fmt::format("{}: {}:\n{}", command_line(command), *what, outcome.errors);
      std::snprintf(shared.finding, sizeof shared.finding, "%s", text.c_str());
      _exit(finding_code);
    }
  }
  _exit(0);
}

/// Waits for the process; the finding, if there is one.
std::optional<std::string> watch(pid_t process, const Shared& shared) {
  clockid_t clock{};
  clock_getcpuclockid(process, &clock);
  int status = 0;
  bool hangs = false;
  while (waitpid(process, &status, WNOHANG) == 0) {
    hangs = hangs || processor_seconds(clock) - shared.begun > max_seconds;
    if (hangs) checked(kill(process, SIGKILL), "kill");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (hangs) return fmt::format("{}: takes longer than {} s", shared.finding, max_seconds);
  if (WIFSIGNALED(status))
    return fmt::format("{}: {}", shared.finding, strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == finding_code) return shared.finding;
  if (WEXITSTATUS(status) != 0)
    return fmt::format("{}: the process ended with {}", shared.finding, WEXITSTATUS(status));
  return std::nullopt;
}

void keep(const std::string& name, const std::string& file, const Options& options,
          std::uint64_t input) {
  if (options.keep.empty()) return;
  fs::create_directories(options.keep);
  fs::copy_file(file, options.keep / fmt::format("{}-{}-{}", name, input, file),
                fs::copy_options::overwrite_existing);
}

std::uint64_t fuzz(const NamedTarget& named, const Options& options) {
  const Target target = named.make();
  Shared& shared = make_shared_memory();
  std::uint64_t findings = 0;
  const std::uint64_t end = options.first + options.inputs;
  for (std::uint64_t next = options.first; next < end;) {
    const std::uint64_t last = std::min(end, next + inputs_per_process);
    static_cast<void>(std::fflush(nullptr));
    const pid_t process = fork();
    if (process == 0) read_inputs(target, options, next, last, shared);
    const std::optional<std::string> finding = watch(process, shared);
    next = last;
    if (!finding) continue;
    ++findings;
    fmt::print("{} --first {}: {}\n", named.name, shared.input.load(), *finding);
    keep(named.name, target.file, options, shared.input);
    next = shared.input + 1;
  }
  fmt::print("{}: {} inputs, {} findings\n", named.name, options.inputs, findings);
  return findings;
}

/// An empty folder, in memory if there is one, removed at the end with everything in it.
class Folder {
 public:
  Folder() {
    const fs::path memory = "/dev/shm";
    const fs::path parent = fs::exists(memory) ? memory : fs::temp_directory_path();
    std::string name = parent / "vitrel_fuzz_XXXXXX";
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__)  // whose shadow exceeds every limit
  constexpr rlim_t bytes = rlim_t{4} << 30;
  const rlimit limit{bytes, bytes};
  checked(setrlimit(RLIMIT_AS, &limit), "setrlimit");
#endif
}

int run(const Options& options) {
  limit_memory();
  const Folder folder;
  checked(setenv("XDG_CACHE_HOME", folder.path().c_str(), 1), "setenv");
  std::uint64_t findings = 0;
  bool found = false;
  fs::current_path(folder.path());
  for (const NamedTarget& target : targets()) {
    if (!options.target.empty() && target.name != options.target) continue;
    found = true;
    findings += fuzz(target, options);
  }
  if (!found) throw std::runtime_error(options.target + ": no such target");
  return findings == 0 ? 0 : 1;
}

}  // namespace
}  // namespace vitrel::fuzz

int main(int count, char** words) {
  vitrel::fuzz::Options options;
  CLI::App program("Has vitrel read damaged files.");
  program.add_option("--target", options.target, "Kind of file; without it all kinds");
  program.add_option("--inputs", options.inputs, "Number of damaged files of each kind");
  program.add_option("--first", options.first, "Number of the first");
  program.add_option("--seed", options.seed, "Seed of all damage");
  program.add_option("--keep", options.keep, "Folder for files that are read badly");
  CLI11_PARSE(program, count, words);
  try {
    if (!options.keep.empty()) options.keep = std::filesystem::absolute(options.keep);
    return vitrel::fuzz::run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "vitrel-fuzz: {}\n", error.what());
    return 1;
  }
}
