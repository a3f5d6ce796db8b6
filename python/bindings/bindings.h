#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

/// @file
/// The parts of the compiled module `vitrel._vitrel`.
namespace vitrel::python {

void bind_errors(pybind11::module_& module);
void bind_pairs(pybind11::module_& module);
void bind_pictures(pybind11::module_& module);
void bind_files(pybind11::module_& module);
void bind_states(pybind11::module_& module);
void bind_work(pybind11::module_& module);
void bind_results(pybind11::module_& module);

}  // namespace vitrel::python
