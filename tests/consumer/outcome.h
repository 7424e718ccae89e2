// Uses the public headers as a stranger would: cuts a torus knot, validates, measures, triangulates, writes the result and reads it, and
// catches what is thrown. What comes of it must not depend on how the library was built and taken.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include "mandoline/io.h"
#include "mandoline/mandoline.h"
#ifdef WITH_OPERATORS
#include "mandoline/poisson.h"
#endif

#if MANDOLINE_VERSION_NUMBER < 100
#error "mandoline/version.h names no version"
#endif

class Hash {
 public:
  void add(const void* data, size_t bytes) {
    for (size_t i = 0; i < bytes; ++i) value_ = (value_ ^ static_cast<const unsigned char*>(data)[i]) * 0x100000001b3;
  }
  template <class Item>
  void add(const std::vector<Item>& items) {
    add(items.data(), items.size() * sizeof(Item));
  }
  unsigned long long value() const { return value_; }

 private:
  uint64_t value_ = 0xcbf29ce484222325;
};

/// Throws unless the library's exceptions can be caught by their types.
inline void catchByType() {
  try {
    triangulateFaces(mandoline::CutMesh{});
    throw std::logic_error("an empty cut-mesh was taken");
  } catch (const mandoline::CallError& caught) {
    if (caught.error.status != mandoline::Status::badArgument) throw;
  }
  try {
    mandoline::readMesh("no such file.obj");
    throw std::logic_error("a file was read that is not there");
  } catch (const mandoline::FileError&) {
  }
}

/// The number of cut-cells, and a hash of all arrays.
inline std::string outcome() {
  catchByType();
  const mandoline::Mesh mesh = mandoline::makeTorusKnot(0.4, 96, 8);
  const mandoline::CutResult result = mandoline::cut(mesh, mandoline::Grid::around(mesh, 9));
  if (!result) throw std::runtime_error(result.error.message);
  const mandoline::Validation validation = validate(mesh, result.mesh);
  for (const mandoline::Check& check : validation.checks) {
    if (!check.pass) throw std::runtime_error(check.name + " does not hold");
  }
  const mandoline::Measures measures = measure(mesh, result.mesh);
  std::ostringstream json;
  mandoline::writeJson(json, result.mesh);
  std::ostringstream obj;
  mandoline::writeObj(obj, result.mesh);

  Hash hash;
  hash.add(mesh.positions);
  hash.add(json.str().data(), json.str().size());
  hash.add(mandoline::readMesh(obj.str(), "surface.obj").positions);
  hash.add(measures.cellVolume);
  hash.add(measures.faceArea);
  hash.add(triangulateFaces(result.mesh).triangles);
#ifdef WITH_OPERATORS
  const mandoline::CellComplex cells = mandoline::cellComplex(mesh, result.mesh, mandoline::coarsen(result.mesh));
  mandoline::PoissonProblem problem;
  problem.boundary = mandoline::boundaryOf(cells);
  setBoundary(problem.boundary, cells, mandoline::FaceTag::xMax, mandoline::Condition::dirichlet, 0.3);
  const mandoline::PoissonSystem system = mandoline::poissonSystem(cells, problem);
  hash.add(system.matrix.entryValues);
  hash.add(system.rhs);
#endif
  std::ostringstream out;
  out << result.mesh.cellCount() << " cut-cells, hash " << std::hex << hash.value();
  return out.str();
}
