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

std::string succeed(const Folder& folder, const std::vector<std::string>& arguments) {
  const Outcome outcome = run(folder.path(), arguments);
  EXPECT_EQ(outcome.code, 0) << testing::PrintToString(arguments) << outcome.errors;
  return outcome.output;
}

nlohmann::json summary_of(const Folder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--json", "-q"});
  const std::string output = succeed(folder, arguments);
  return output.empty() ? nlohmann::json() : nlohmann::json::parse(output);
}

Folder::Folder(const std::string& name)
    : path_(fs::path(::testing::TempDir()) / ("vitrel_" + name + "_" + std::to_string(getpid()))) {
  fs::remove_all(path_);
  fs::create_directories(path_);
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
