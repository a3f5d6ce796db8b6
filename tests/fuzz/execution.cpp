#include "tests/fuzz/execution.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "app/program.h"
#include "core/io/checked.h"

namespace vitrel::fuzz {
namespace {

/// While it lives, what is written to a descriptor goes to another.
class Redirection {
 public:
  Redirection(int descriptor, int target) : descriptor_(descriptor), before_(dup(descriptor)) {
    flush();
    checked(dup2(target, descriptor_), "dup2");
  }
  ~Redirection() {
    flush();
    static_cast<void>(dup2(before_, descriptor_));
    static_cast<void>(close(before_));
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;

 private:
  static void flush() {
    static_cast<void>(std::fflush(nullptr));
    std::cout.flush();
    std::cerr.flush();
  }

  int descriptor_, before_;
};

std::string content(int file) {
  std::string text(static_cast<std::size_t>(lseek(file, 0, SEEK_END)), '\0');
  text.resize(
      static_cast<std::size_t>(std::max<ssize_t>(0, pread(file, text.data(), text.size(), 0))));
  return text;
}

}  // namespace

std::string command_line(const std::vector<std::string>& words) {
  return fmt::format("vitrel {}", fmt::join(words, " "));
}

Outcome execute(const std::vector<std::string>& words) {
  std::vector<std::string> all = {"vitrel"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : all) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int errors = checked(memfd_create("errors", 0), "memfd_create");
  const int nowhere = checked(open("/dev/null", O_WRONLY), "open");
  Outcome outcome{};
  {
    const Redirection to_nowhere(STDOUT_FILENO, nowhere), to_file(STDERR_FILENO, errors);
    outcome.code = vitrel_main(static_cast<int>(all.size()), pointers.data());
  }
  outcome.errors = content(errors);
  checked(close(errors), "close");
  checked(close(nowhere), "close");
  return outcome;
}

}  // namespace vitrel::fuzz
