#pragma once

#include <cerrno>
#include <new>
#include <system_error>

/// @file
/// What C functions return, once it is known that they did not fail.
namespace vitrel {

/// The result of a system call that should not fail; throws std::system_error with the name of the call.
template <class Result>
Result checked(Result result, const char* call) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), call);
  return result;
}

/// What a library returned, which has no other reason to return nothing than that memory is short: std::bad_alloc.
template <class T>
T* obtained(T* result) {
  return result ? result : throw std::bad_alloc();
}

}  // namespace vitrel
