// A module for Python, which is a shared library: static ones have to be position independent to become part of it.
#include <pybind11/pybind11.h>

#include "outcome.h"

PYBIND11_MODULE(cutting, module) {
  pybind11::register_exception<mandoline::FileError>(module, "FileError");
  module.def("outcome", &outcome);
  module.def("count_triangles", [](const std::string& path) { return mandoline::readMesh(path).triangleCount(); });
}
