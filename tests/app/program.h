#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

/// Runs the built program `vitrel` as a user would, for the end-to-end tests.
namespace vitrel::testing_program {

struct Outcome {
  int code = 0;  ///< exit code; 128 + number if a signal ended the program
  std::string output;
  std::string errors;
  double memory_bytes = 0;  ///< largest resident set
};

/// Runs the program in `folder` to its end.
Outcome run(const std::filesystem::path& folder, const std::vector<std::string>& arguments);

/// The same with a full disk for standard output.
Outcome run_on_full_disk(const std::filesystem::path& folder,
                         const std::vector<std::string>& arguments);

/// The same with a terminal for standard output and standard error, both in `output` as they appear; TERM is xterm and
/// NO_COLOR unset but for `environment`.
Outcome run_on_terminal(const std::filesystem::path& folder,
                        const std::vector<std::string>& arguments,
                        const std::map<std::string, std::string>& environment = {});

/// The same, but sends `signal` as soon as it is `time`, unless the program has ended before.
Outcome run_and_signal(const std::filesystem::path& folder,
                       const std::vector<std::string>& arguments, const std::function<bool()>& time,
                       int signal);
/// The same after `delay`.
Outcome run_and_signal(const std::filesystem::path& folder,
                       const std::vector<std::string>& arguments, std::chrono::milliseconds delay,
                       int signal);

/// One message on standard error, that exit code, and nothing on standard output.
void expect_refusal(const Outcome& outcome, int code, const std::string& part);

/// A command line, the exit code with which the program refuses it, and a part of the message.
struct Refusal {
  std::string command;
  int code;
  std::string part;
};

/// The words of a command line without the name of the program, such as "run p.toml -o run.h5". As in
/// a shell, 'single quotes' around a word keep its blanks; nothing else is special.
std::vector<std::string> words_of(const std::string& command);

/// An empty folder of this name below the test's temporary folder, removed with everything in it at the
/// end of the scope; and the program, which runs there.
class Folder {
 public:
  explicit Folder(const std::string& name);
  /// With a file p.toml of these parameters.
  Folder(const std::string& name, const std::string& parameters);
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& text) const;
  /// The whole file.
  std::string read(const std::string& name) const;

  /// Runs a command line (`words_of`) to its end.
  Outcome run(const std::string& command) const;
  /// The same, expects the exit code 0, and returns what the program prints.
  std::string succeed(const std::string& command) const;
  /// The same of a command that prints a summary as JSON; null if it prints nothing.
  nlohmann::json summary(const std::string& command) const;
  /// Runs it where no file may become larger.
  Outcome run_with_file_limit(std::uint64_t bytes, const std::string& command) const;
  /// One message on standard error, that exit code, and nothing on standard output.
  void expect_refusal(const std::string& command, int code, const std::string& part) const;
  void expect_refusals(const std::vector<Refusal>& refusals) const;
  /// Two HDF5 files of these names have the same datasets (`differing_datasets`).
  void expect_same_datasets(const std::string& first, const std::string& second) const;

 private:
  std::filesystem::path path_;
};

/// The values of datasets by their names.
using Datasets = std::map<std::string, std::vector<double>>;

/// All datasets of an HDF5 file outside /parameters and /provenance; names like /particles/all/mass.
Datasets all_datasets(const std::filesystem::path& file);

/// The names of all datasets of an HDF5 file, outside /parameters and /provenance, whose shapes or bits differ from those of
/// another file, or which only one of them has.
std::vector<std::string> differing_datasets(const std::filesystem::path& first,
                                            const std::filesystem::path& second);

}  // namespace vitrel::testing_program
