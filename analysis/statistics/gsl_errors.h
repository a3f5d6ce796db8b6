#pragma once

#include <gsl/gsl_errno.h>

#include <new>
#include <stdexcept>
#include <string>

/// @file
/// GSL reports an error to a handler of the whole process, and its own handler aborts. Every source that calls GSL
/// includes this header: when the program starts, or loads the library, GSL's handler is turned off, and errors are
/// reported by results only. A handler that a program around the library has set before, or sets later, stays.
namespace vitrel {

inline const bool gsl_reports_by_results = [] {
  gsl_error_handler_t* const own = gsl_set_error_handler_off();
  if (own) static_cast<void>(gsl_set_error_handler(own));
  return true;
}();

/// Throws if a function of GSL failed that can fail only by a defect or a lack of memory.
inline void check_gsl(int status) {
  if (status == GSL_ENOMEM) throw std::bad_alloc();
  if (status != GSL_SUCCESS) throw std::runtime_error(std::string("GSL: ") + gsl_strerror(status));
}

}  // namespace vitrel
