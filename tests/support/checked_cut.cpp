#include "checked_cut.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "catch.h"
#include "shapes.h"

using namespace mandoline;

double CheckedCut::volume() const {
  const std::vector<double> volumes = regionVolumes();
  return std::accumulate(volumes.begin(), volumes.end(), 0.);
}

std::vector<double> CheckedCut::regionVolumes() const {
  std::vector<double> volumes = mandoline::regionVolumes(mesh, measures);
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

double CheckedCut::windingVolume(int winding) const {
  const std::vector<double> volumes = mandoline::regionVolumes(mesh, measures);
  REQUIRE(mesh.hasWinding);
  double sum = 0;
  for (size_t r = 0; r < volumes.size(); ++r)
    if (mesh.regionWinding[r] == winding) sum += volumes[r];
  return sum;
}

std::vector<double> CheckedCut::volumesIn(int i, int j, int k) const {
  std::vector<double> volumes;
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    if (mesh.cellGridCell[3 * c] == i && mesh.cellGridCell[3 * c + 1] == j && mesh.cellGridCell[3 * c + 2] == k)
      volumes.push_back(measures.cellVolume[c]);
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

static size_t holesOf(const CutMesh& mesh, size_t face) {
  // A loop of two entries is a slit and has no area.
  size_t holes = 0;
  for (uint32_t l = mesh.faceLoopOffsets[face] + 1; l < mesh.faceLoopOffsets[face + 1]; ++l) holes += mesh.loop(l).size() > 2;
  return holes;
}

size_t CheckedCut::facesWithHoles() const {
  size_t count = 0;
  for (size_t f = 0; f < mesh.faceCount(); ++f) count += holesOf(mesh, f) > 0;
  return count;
}

size_t CheckedCut::facesIn(int axis, int plane, size_t holes) const {
  size_t count = 0;
  for (size_t f = 0; f < mesh.faceCount(); ++f)
    count += mesh.faceAxis[f] == axis && mesh.facePlane[f] == plane && holesOf(mesh, f) >= holes;
  return count;
}

static bool hasFaceTwice(const CutMesh& mesh) {
  std::vector<std::vector<uint32_t>> faces(mesh.faceCount());
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    for (uint32_t l = mesh.faceLoopOffsets[f]; l < mesh.faceLoopOffsets[f + 1]; ++l)
      faces[f].insert(faces[f].end(), mesh.loop(l).begin(), mesh.loop(l).end());
    std::sort(faces[f].begin(), faces[f].end());
    // Triangles of one small component may share all their vertices with a piece of a grid-face: only faces in one plane are the same.
    faces[f].push_back(uint32_t(mesh.faceAxis[f] + 1));
    faces[f].push_back(mesh.faceAxis[f] < 0 ? uint32_t(mesh.faceTriangle[f]) : 0);
  }
  std::sort(faces.begin(), faces.end());
  return std::adjacent_find(faces.begin(), faces.end()) != faces.end();
}

CheckedCut checkedCut(const Mesh& mesh, const Grid& grid, const CutOptions& options) {
  CutResult result = cut(mesh, grid, options);
  INFO(name(result.error.status) << " " << result.error.message);
  REQUIRE(result);
  const Validation validation = validate(mesh, result.mesh, RunOptions{options.threads, nullptr});
  for (const Check& check : validation.checks) {
    INFO(check.name << ": worst " << check.worst << " of " << check.tolerance << " at " << check.elementKind << " " << check.element << " "
                    << check.message);
    CHECK(check.pass);
  }
  REQUIRE(validation.pass);
  CHECK_FALSE(hasFaceTwice(result.mesh));
  Measures measures = measure(mesh, result.mesh);
  CheckedCut checked{std::move(result.mesh), std::move(result.stats), std::move(measures)};
  double boxVolume = 1;
  for (const auto& planes : grid.planes) boxVolume *= planes.back() - planes.front();
  CHECK(checked.volume() == Approx(boxVolume).epsilon(1e-12));
  CHECK(checked.mesh.triangleCount == mesh.triangleCount());
  return checked;
}

void atBothOrientations(const Mesh& mesh, const Grid& grid, const std::function<void(const CheckedCut&, int orientation)>& body) {
  {
    INFO("as given");
    body(checkedCut(mesh, grid), 1);
  }
  INFO("flipped");
  body(checkedCut(shapes::flipped(mesh), grid), -1);
}

bool near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  const auto close = [&](double x, double y) { return std::abs(x - y) <= tolerance; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), close);
}
