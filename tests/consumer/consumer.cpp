// Uses the public headers as a stranger would: cuts a torus knot, validates, measures, triangulates, writes the result and reads it. Prints
// a hash of all that, which must not depend on how the library was built and taken.
#include <cstdio>
#include <sstream>

#include "mandoline/io.h"
#include "mandoline/mandoline.h"
#ifdef WITH_OPERATORS
#include "mandoline/poisson.h"
#endif

#if MANDOLINE_VERSION_NUMBER < 100
#error "mandoline/version.h names no version"
#endif

namespace {

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

}  // namespace

int main() {
  const mandoline::Mesh mesh = mandoline::makeTorusKnot(0.4, 96, 8);
  const mandoline::CutResult result = mandoline::cut(mesh, mandoline::Grid::around(mesh, 9));
  if (!result) return std::printf("%s\n", result.error.message.c_str()), 1;
  const mandoline::Validation validation = validate(mesh, result.mesh);
  for (const mandoline::Check& check : validation.checks) {
    if (!check.pass) std::printf("%s does not hold\n", check.name.c_str());
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
  hash.add(system.matrix.valuePtr(), size_t(system.matrix.nonZeros()) * sizeof(double));
  hash.add(system.rhs);
#endif
  std::printf("%zu cut-cells, hash %llx\n", result.mesh.cellCount(), hash.value());
  return validation.pass ? 0 : 1;
}
