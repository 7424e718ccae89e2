// Uses each public header as a stranger would: cuts a tetrahedron, validates, measures, triangulates and writes the result.
#include <cmath>
#include <cstdio>
#include <sstream>

#include "mandoline/io.h"
#include "mandoline/mandoline.h"
#include "mandoline/measure.h"
#include "mandoline/triangulate.h"
#include "mandoline/validate.h"

int main() {
  const mandoline::Mesh mesh{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
  const mandoline::CutResult result = mandoline::cut(mesh, mandoline::Grid::around(mesh, 4));
  if (!result) return std::printf("%s\n", result.error.message.c_str()), 1;
  const mandoline::CutMesh& cutMesh = result.mesh;
  const std::vector<double> volumes = regionVolumes(cutMesh, measure(mesh, cutMesh));
  const bool volumeFound = volumes.size() == 2 && (std::abs(volumes[0] - 1. / 6) < 1e-14 || std::abs(volumes[1] - 1. / 6) < 1e-14);
  const bool triangulated = triangulateFaces(cutMesh).triangles.size() >= 3 * cutMesh.faceCount();
  std::ostringstream json;
  mandoline::writeJson(json, cutMesh);
  const bool fine = validate(mesh, cutMesh).pass && volumeFound && triangulated && !json.str().empty();
  std::printf("%zu cut-cells: %s\n", cutMesh.cellCount(), fine ? "fine" : "wrong");
  return fine ? 0 : 1;
}
