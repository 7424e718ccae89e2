// Cell complexes may come from elsewhere: what is wrong with their arrays is named, and those that pass checkArrays() must not lead any
// function astray. Wrong answers are fine, wrong memory accesses are what the sanitizers look for here.
#include <algorithm>
#include <limits>
#include <random>

#include "complexes.h"
#include "mandoline/validate.h"
#include "shapes.h"

using namespace mandoline;

namespace {

CellComplex sample() { return complexOf(shapes::icosphere({4, 4, 4}, 1.3, 1), Grid::regular({0, 0, 0}, {1, 1, 1}, {8, 8, 8}), 3); }

class Damage {
 public:
  CellComplex operator()(CellComplex cells) {
    switch (random_() % 10) {
      case 0:
        damage(cells.loopOffsets);
        break;
      case 1:
        damage(cells.loopVertices);
        break;
      case 2:
        damage(cells.faceLoopOffsets);
        break;
      case 3:
        damage(cells.faceCells);
        break;
      case 4:
        damage(cells.faceTag);
        break;
      case 5:
        damage(cells.cellHalfFaces);
        break;
      case 6:
        damage(cells.cellCorner);
        break;
      case 7:
        damage(cells.cellLevel);
        break;
      case 8:
        damage(cells.faceNormal);
        break;
      default:
        damage(cells.cellCentre);
    }
    return cells;
  }

 private:
  /// Entries that are wrong, but often in range.
  template <class Item>
  void damage(std::vector<Item>& array) {
    for (int i = 0; i < 2; ++i) array[random_() % array.size()] = random_() % 2 ? array[random_() % array.size()] : Item(random_() % 9);
    if (random_() % 16 == 0) array.pop_back();
  }

  std::mt19937 random_{1};
};

void useAll(const CellComplex& cells) {
  const ComplexEdges edges = complexEdges(cells);
  cellFaceIncidence(cells), faceEdgeIncidence(cells, edges), edgeVertexIncidence(cells, edges);
  for (const DualPoints dualPoints : {DualPoints::centres, DualPoints::centroids})
    laplacian(cells, dualPoints), faceMass(cells, dualPoints);
  regionComplex(cells, cells.cellRegion[0]);
  PoissonProblem problem;
  problem.boundary = boundaryOf(cells);
  setBoundary(problem.boundary, cells, FaceTag::xMin, Condition::dirichlet, 1);
  outwardNormals(problem.boundary, cells);
  solvePoisson(cells, problem);
}

}  // namespace

TEST_CASE("damaged cell complexes lead no function astray", "[physics]") {
  const CellComplex cells = sample();
  Damage damage;
  int harmless = 0;
  for (int round = 0; round < 300; ++round) {
    const CellComplex damaged = damage(cells);
    if (!checkArrays(damaged).pass) continue;
    ++harmless;
    useAll(damaged);
  }
  CHECK(harmless > 60);
  CHECK(harmless < 240);
}

TEST_CASE("what is wrong with a cell complex is named", "[physics]") {
  const CellComplex cells = sample();
  CHECK(checkArrays(cells).pass);
  const auto complaint = [&](const auto& change) {
    CellComplex changed = cells;
    change(changed);
    return checkArrays(changed).message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const uint32_t inner = uint32_t(std::find(cells.faceTag.begin(), cells.faceTag.end(), FaceTag::inner) - cells.faceTag.begin());
  const std::string face = "Face " + std::to_string(inner);
  CHECK(complaint([](CellComplex& c) { c.faceArea.pop_back(); }) == "An array of the faces has a wrong length.");
  CHECK(complaint([](CellComplex& c) { c.cutCells = 100000; }) == "An array has fewer items than are said to be the cut-mesh's.");
  CHECK(complaint([](CellComplex& c) { c.loopOffsets[2] = 0; }) == "Loop 1 has wrong offsets.");
  CHECK(complaint([](CellComplex& c) { c.loopVertices[5] = 1u << 31; }) == "Entry 5 of loopVertices names a vertex that does not exist.");
  CHECK(complaint([](CellComplex& c) { c.faceCells[0] = -2; }) == "Face 0 names a cell that does not exist.");
  CHECK(complaint([](CellComplex& c) { c.faceTag[1] = FaceTag(8); }) == "Face 1 has a tag that there is not.");
  CHECK(complaint([&](CellComplex& c) { c.faceCells[2 * inner] = c.faceCells[2 * inner + 1]; }) ==
        face + " is inner, and has nothing or one cell on both sides.");
  CHECK(complaint([](CellComplex& c) { std::swap(c.cellHalfFaces[0], c.cellHalfFaces[1]); }) ==
        "Cell 0 has a half-face that is not its own, or is out of order.");
  CHECK(complaint([](CellComplex& c) { c.cellLevel[3] = 25; }) == "Cell 3 has a level that is too high.");
  CHECK(complaint([&](CellComplex& c) { c.cellCentroid[6] = nan; }) == "Cell 2 has a number that is not finite.");
}
