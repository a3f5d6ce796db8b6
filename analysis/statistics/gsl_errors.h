#pragma once

#include <gsl/gsl_errno.h>

#include <new>
#include <stdexcept>
#include <string>

/// @file
/// GSL reports an error to a handler of the whole process, and its own one aborts. Every source that calls GSL includes
/// this: when the program starts, or loads the library, GSL's handler is turned off, and errors are results only. A
/// handler that was set before or is set later, by a program around the library, stays.
namespace vitrel {

inline const bool gsl_reports_by_results = [] {
  gsl_error_handler_t* const own = gsl_set_error_handler_off();
  if (own) static_cast<void>(gsl_set_error_handler(own));
  return true;
}();

/// Throws where a function of GSL failed for which only a defect or a lack of memory is a reason.
inline void check_gsl(int status) {
  if (status == GSL_ENOMEM) throw std::bad_alloc();
  if (status != GSL_SUCCESS) throw std::runtime_error(std::string("GSL: ") + gsl_strerror(status));
}

}  // namespace vitrel
