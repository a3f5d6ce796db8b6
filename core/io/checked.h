#pragma once

#include <cerrno>
#include <new>
#include <system_error>

/// @file
/// Functions that pass on the results of C functions if they did not fail, and throw otherwise.
namespace vitrel {

/// Returns the result of a system call. Throws std::system_error with the name of the call if it failed.
template <class Result>
Result checked(Result result, const char* call) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), call);
  return result;
}

/// Returns what a library function returned. Throws std::bad_alloc if that is null, for functions that return null only
/// if memory is short.
template <class T>
T* obtained(T* result) {
  return result ? result : throw std::bad_alloc();
}

}  // namespace vitrel
