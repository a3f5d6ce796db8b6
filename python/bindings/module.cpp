#include "core/error.h"
#include "core/io/provenance.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interruption.h"

namespace vitrel::python {

namespace py = pybind11;

void bind_errors(py::module_& module) {
  py::register_exception<UserError>(module, "UserError", PyExc_ValueError);
  py::register_exception<FileError>(module, "FileError", PyExc_OSError);
  py::register_exception<InvariantError>(module, "InvariantError", PyExc_RuntimeError);
}

}  // namespace vitrel::python

PYBIND11_MODULE(_vitrel, module) {
  module.doc() = "What the package vitrel builds on; use that.";
  module.attr("version") = vitrel::program_version();
  module.attr("commit") = vitrel::program_commit();
  vitrel::python::bind_errors(module);
  vitrel::python::wait_at_exit();
  vitrel::python::bind_pairs(module);
  vitrel::python::bind_states(module);
  vitrel::python::bind_pictures(module);
  vitrel::python::bind_files(module);
  vitrel::python::bind_work(module);
  vitrel::python::bind_results(module);
}
