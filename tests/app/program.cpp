#include "tests/app/program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "core/io/checked.h"
#include "core/io/h5.h"

namespace vitrel::testing_program {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void redirect(const fs::path& file, int descriptor) {
  const int opened = checked(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), "open");
  checked(dup2(opened, descriptor), "dup2");
}

/// The command line of the program; valid as long as the arguments.
std::vector<char*> command_line(const std::vector<std::string>& arguments) {
  std::vector<char*> words = {const_cast<char*>(VITREL_PROGRAM)};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  return words;
}

[[noreturn]] void execute(const fs::path& folder, char* const* words) {
  if (chdir(folder.c_str()) == 0) static_cast<void>(execv(words[0], words));
  _exit(127);
}

pid_t start(const fs::path& folder, const std::vector<std::string>& arguments,
            const fs::path& output, const fs::path& errors) {
  const std::vector<char*> words = command_line(arguments);
  const pid_t pid = fork();
  if (pid == 0) {
    redirect(output, STDOUT_FILENO);
    redirect(errors, STDERR_FILENO);
    execute(folder, words.data());
  }
  return pid;
}

int exit_code(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void collect(const h5::Group& group, const std::string& path, Datasets& datasets) {
  for (const std::string& name : group.members()) {
    const std::string full = path + "/" + name;
    if (full == "/parameters" || full == "/provenance") continue;
    if (group.has_group(name))
      collect(group.group(name), full, datasets);
    else
      datasets[full] = group.dataset(name).read<double>();
  }
}

bool same_bits(const std::vector<double>& x, const std::vector<double>& y) {
  return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
}

}  // namespace

Outcome run_and_signal(const fs::path& folder, const std::vector<std::string>& arguments,
                       const std::function<bool()>& time, int signal) {
  const fs::path output = folder / "standard_output", errors = folder / "standard_error";
  const pid_t pid = start(folder, arguments, output, errors);
  int status = 0;
  bool ended = false;
  while (!(ended = waitpid(pid, &status, WNOHANG) == pid) && !time())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (!ended) {
    checked(kill(pid, signal), "kill");
    checked(waitpid(pid, &status, 0), "waitpid");
  }
  return {exit_code(status), content(output), content(errors)};
}

Outcome run_and_signal(const fs::path& folder, const std::vector<std::string>& arguments,
                       std::chrono::milliseconds delay, int signal) {
  const auto end = std::chrono::steady_clock::now() + delay;
  return run_and_signal(
      folder, arguments, [end] { return std::chrono::steady_clock::now() >= end; }, signal);
}

Outcome run(const fs::path& folder, const std::vector<std::string>& arguments) {
  const fs::path output = folder / "standard_output", errors = folder / "standard_error";
  int status = 0;
  rusage used{};
  checked(wait4(start(folder, arguments, output, errors), &status, 0, &used), "wait4");
  return {exit_code(status), content(output), content(errors), 1024. * used.ru_maxrss};
}

Outcome run_on_full_disk(const fs::path& folder, const std::vector<std::string>& arguments) {
  const fs::path errors = folder / "standard_error";
  int status = 0;
  checked(waitpid(start(folder, arguments, "/dev/full", errors), &status, 0), "waitpid");
  return {exit_code(status), "", content(errors)};
}

Outcome run_on_terminal(const fs::path& folder, const std::vector<std::string>& arguments,
                        const std::map<std::string, std::string>& environment) {
  const std::vector<char*> words = command_line(arguments);
  int terminal = -1;
  const pid_t pid = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (pid == 0) {
    checked(unsetenv("NO_COLOR"), "unsetenv");
    checked(setenv("TERM", "xterm", 1), "setenv");
    for (const auto& [name, value] : environment)
      checked(setenv(name.c_str(), value.c_str(), 1), "setenv");
    execute(folder, words.data());
  }
  // Reading fails when the program has ended and all it printed has been read.
  std::string shown;
  char part[4096];
  for (ssize_t count = 0; (count = read(terminal, part, sizeof part)) > 0;)
    shown.append(part, static_cast<std::size_t>(count));
  checked(close(terminal), "close");
  int status = 0;
  checked(waitpid(pid, &status, 0), "waitpid");
  return {exit_code(status), shown, ""};
}

void expect_refusal(const Outcome& outcome, int code, const std::string& part) {
  EXPECT_EQ(outcome.code, code);
  EXPECT_THAT(outcome.errors, ::testing::HasSubstr(part));
  EXPECT_EQ(outcome.output, "");
  const auto last_line = outcome.errors.rfind("vitrel");
  EXPECT_EQ(outcome.errors.find('\n', last_line), outcome.errors.size() - 1) << outcome.errors;
}

std::vector<std::string> words_of(const std::string& command) {
  std::istringstream stream(command);
  std::vector<std::string> words;
  for (std::string word; stream >> std::quoted(word, '\'', '\0');) words.push_back(word);
  return words;
}

Folder::Folder(const std::string& name)
    : path_(fs::path(::testing::TempDir()) / ("vitrel_" + name + "_" + std::to_string(getpid()))) {
  fs::remove_all(path_);
  fs::create_directories(path_);
}

Folder::Folder(const std::string& name, const std::string& parameters) : Folder(name) {
  write("p.toml", parameters);
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name) << text;
}

std::string Folder::read(const std::string& name) const {
  std::ifstream stream(path_ / name);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Outcome Folder::run(const std::string& command) const {
  return testing_program::run(path_, words_of(command));
}

std::string Folder::succeed(const std::string& command) const {
  const Outcome outcome = run(command);
  EXPECT_EQ(outcome.code, 0) << command << '\n' << outcome.errors;
  return outcome.output;
}

nlohmann::json Folder::summary(const std::string& command) const {
  const std::string output = succeed(command + " --json -q");
  return output.empty() ? nlohmann::json() : nlohmann::json::parse(output);
}

Outcome Folder::run_with_file_limit(std::uint64_t bytes, const std::string& command) const {
  rlimit before{};
  checked(getrlimit(RLIMIT_FSIZE, &before), "getrlimit");
  const rlimit limit{bytes, before.rlim_max};
  checked(setrlimit(RLIMIT_FSIZE, &limit), "setrlimit");
  const Outcome outcome = run(command);
  checked(setrlimit(RLIMIT_FSIZE, &before), "setrlimit");
  return outcome;
}

void Folder::expect_refusal(const std::string& command, int code, const std::string& part) const {
  SCOPED_TRACE(command);
  testing_program::expect_refusal(run(command), code, part);
}

void Folder::expect_refusals(const std::vector<Refusal>& refusals) const {
  for (const auto& [command, code, part] : refusals) expect_refusal(command, code, part);
}

void Folder::expect_same_datasets(const std::string& first, const std::string& second) const {
  EXPECT_THAT(differing_datasets(path_ / first, path_ / second), ::testing::IsEmpty())
      << first << ", " << second;
}

Datasets all_datasets(const fs::path& file) {
  Datasets datasets;
  collect(h5::File::open(file, h5::Access::read).root(), "", datasets);
  return datasets;
}

std::vector<std::string> differing_datasets(const fs::path& first, const fs::path& second) {
  const auto left = all_datasets(first), right = all_datasets(second);
  std::vector<std::string> different;
  for (const auto& [name, values] : left) {
    const auto other = right.find(name);
    if (other == right.end() || !same_bits(values, other->second)) different.push_back(name);
  }
  for (const auto& [name, values] : right)
    if (!left.contains(name)) different.push_back(name);
  return different;
}

}  // namespace vitrel::testing_program
