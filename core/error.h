#pragma once

#include <stdexcept>

/// @file
/// Errors that reach the user. Each message is complete: what is wrong, where, what would be right.
namespace vitrel {

/// The user's mistake (parameters, command line): exit code 2.
struct UserError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file could not be read or written; the message names it: exit code 3.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A broken invariant, such as an overlap in a hard run: exit code 4.
struct InvariantError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace vitrel
