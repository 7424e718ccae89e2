// Calls with arguments that do not belong together: each works, or reports by a CallError; none crashes. The sanitizers look on.
#include <algorithm>
#include <climits>
#include <functional>
#include <limits>
#include <numeric>
#include <random>

#include "catch.h"
#include "mandoline/io.h"
#include "mandoline/mandoline.h"
#include "shapes.h"
#include "temporary_folder.h"

using namespace mandoline;

namespace {

/// A mesh, its cut-mesh, and what was made from these.
struct Family {
  explicit Family(const Mesh& mesh_) : mesh(mesh_) {}
  Family(const Mesh& mesh_, const Grid& grid) : mesh(mesh_), cutMesh(cut(mesh, grid).mesh), measures(measure(mesh, cutMesh)) {
    REQUIRE(cutMesh.vertexCount() > 0);
  }

  Mesh mesh;
  CutMesh cutMesh;
  Measures measures;
};

std::vector<Family> families() {
  const auto around = [](const Mesh& mesh, int64_t n) { return Family(mesh, Grid::around(mesh, n)); };
  const Mesh sphere = shapes::icosphere({0, 0, 0}, 1, 1);
  std::vector<Family> result{around(shapes::cube(0, 1), 3),
                             around(sphere, 4),
                             around(sphere, 5),
                             around(shapes::translated(sphere, {0.125, 0, 0}), 4),
                             around(shapes::torus({0, 0, 0}, 1, 0.4, 12, 8), 5),
                             around(shapes::moebius({0, 0, 0}, 1, 0.4, 12), 3)};
  // Nothing at all, and meshes that can't be cut.
  result.push_back(Family(Mesh{}));
  result.push_back(Family(Mesh{{0, 0, 0}, {0, 0, 1}}));
  result.push_back(Family(Mesh{{0, 0, 0, 1}, {0, 0}}));
  Mesh infinite = sphere;
  infinite.positions[4] = std::numeric_limits<double>::infinity();
  result.push_back(Family(infinite));
  return result;
}

/// Arguments drawn at random.
class Draw {
 public:
  Draw(const std::vector<Family>& families, uint32_t seed) : families_(families), random_(seed) {}

  size_t below(size_t n) { return random_() % n; }
  const Mesh& mesh() { return family().mesh; }
  const CutMesh& cutMesh() { return family().cutMesh; }
  const Measures& measures() { return family().measures; }
  double number() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kNumbers[] = {0, -1, 0.25, 0.5, 1, 3, 1e-300, 1e300, -kInfinity, kInfinity, kNan};
    return kNumbers[below(std::size(kNumbers))];
  }
  std::vector<double> numbers() {
    std::vector<double> result(below(8));
    for (double& x : result) x = number();
    return result;
  }
  std::array<double, 3> triple() { return {number(), number(), number()}; }
  size_t id() {
    constexpr size_t kIds[] = {0, 1, 7, 100, 99999999, UINT32_MAX, SIZE_MAX};
    return kIds[below(std::size(kIds))];
  }
  FileFormat of(const std::vector<FileFormat>& formats) { return formats[below(formats.size())]; }
  WriteOptions writeOptions() {
    WriteOptions options;
    options.untouched = below(2) == 0;
    if (below(2) == 0) options.regions = regions();
    return options;
  }
  /// A mesh's own, or one that has lost or been given arrays.
  ResolvedMesh resolvedMesh() {
    ResolvedMesh result = resolve(mesh()).mesh;
    if (below(4) == 0) result.mesh = mesh();
    if (below(4) == 0) result.frontWinding.resize(below(20));
    if (below(4) == 0) result.hasWinding = true;
    return result;
  }
  WindingRule rule() { return WindingRule(below(3)); }
  double threshold() { return below(2) == 0 ? 0.5 : number(); }
  /// Per region of some cut-mesh, or of none.
  std::vector<uint8_t> regions() { return std::vector<uint8_t>(below(5), uint8_t(below(2))); }
  TriangleGroups groups() {
    TriangleGroups result;
    result.names.assign(below(3), "group");
    result.triangleGroup.assign(below(2) == 0 ? mesh().triangleCount() : below(20), uint32_t(below(3)));
    return result;
  }
  Intersections intersections() { return Intersections(below(3)); }
  int64_t count() {
    constexpr int64_t kCounts[] = {-1, 0, 1, 2, 3, 4, 5, 6, INT64_MIN, INT64_MAX};
    return kCounts[below(std::size(kCounts))];
  }
  std::array<int64_t, 3> counts() {
    const int64_t x = count(), y = count();
    return {x, y, count()};
  }
  /// Often one that can be cut with.
  Grid grid() {
    const std::array<double, 3> min = triple(), max = triple();
    switch (below(6)) {
      case 0:
        return Grid::around(mesh(), count());
      case 1:
        return Grid::box(min, max, counts());
      case 2:
        return Grid::regular(min, max, counts());
      case 3: {
        std::vector<double> x = numbers(), y = numbers();
        if (below(2) == 0) std::sort(x.begin(), x.end());
        return Grid::rectilinear({std::move(x), std::move(y), {0, 0.5, 1}});
      }
      default:
        return Grid::box({-1, -1, -1}, {1, 1, 1}, {2, 3, 4});
    }
  }
  CutOptions cutOptions() {
    CutOptions options;
    options.intersections = intersections();
    if (below(3) == 0) options.snapTolerance = number();
    return options;
  }
  CoarsenOptions coarsenOptions() {
    constexpr int kLevels[] = {INT_MIN, -1, 0, 1, 24, 40, INT_MAX};
    CoarsenOptions options;
    options.maxLevel = kLevels[below(std::size(kLevels))];
    options.fineLayers = below(2) == 0 ? 0 : kLevels[below(std::size(kLevels))];
    options.layersPerLevel = below(2) == 0 ? 0 : kLevels[below(std::size(kLevels))];
    options.balanceEdges = below(2) == 0;
    return options;
  }
  /// A cut-mesh's own, or what has some of its arrays changed.
  OctreeCells octreeOf(const CutMesh& cutMesh) {
    OctreeCells result = coarsen(cutMesh);
    if (below(8) == 0) result.cellCorner.resize(below(20));
    if (below(8) == 0) result.cellLevel.resize(below(20), uint8_t(id()));
    if (below(8) == 0) result.cellRegion.resize(below(20));
    if (below(8) == 0 && !result.cellLevel.empty()) result.cellLevel[below(result.cellLevel.size())] = uint8_t(below(256));
    if (below(8) == 0 && !result.cellCorner.empty()) result.cellCorner[below(result.cellCorner.size())] = int32_t(id());
    if (below(8) == 0) result.gridCells[below(3)] = int32_t(count());
    return result;
  }
  /// With its own or another's octree cells.
  CellComplex cells() { return cellsOf(cutMesh()); }
  CellComplex cellsOf(const CutMesh& one) { return cellComplex(mesh(), one, octreeOf(below(4) == 0 ? cutMesh() : one)); }
  RunOptions runOptions() {
    RunOptions options;
    options.threads = unsigned(below(4));
    return options;
  }

 private:
  const Family& family() { return families_[below(families_.size())]; }

  const std::vector<Family>& families_;
  std::mt19937 random_;
};

/// Calls that give their error instead of throwing it count alike.
template <class Result>
void report(const Result& result) {
  if (!result) throw CallError(result.error);
}

const Sink kNowhere = [](std::string_view) {};

struct Call {
  const char* name;
  std::function<void(Draw&)> run;
};

/// A line for each function that takes arguments which may not fit.
const std::vector<Call> kCalls{
    {"made shapes",
     [](Draw& draw) {
       const int counts[] = {int(draw.below(6)) - 1, int(draw.below(6)) - 1};
       makeBox(draw.triple(), draw.triple());
       makeSphere(draw.triple(), draw.number(), counts[0]);
       makeTorus(draw.number(), draw.number(), counts[0], counts[1]);
       makeTorusKnot(draw.number(), counts[0], counts[1]);
     }},
    {"measure", [](Draw& draw) { measure(draw.mesh(), draw.cutMesh()); }},
    {"cutEdges", [](Draw& draw) { cutEdges(draw.mesh(), draw.cutMesh()); }},
    {"regionVolumes", [](Draw& draw) { regionVolumes(draw.cutMesh(), draw.measures()); }},
    {"adjacency", [](Draw& draw) { adjacency(draw.cutMesh()); }},
    {"triangulateFaces", [](Draw& draw) { triangulateFaces(draw.cutMesh()); }},
    {"triangulateCell", [](Draw& draw) { triangulateCell(draw.cutMesh(), draw.id()); }},
    {"triangulateRegion", [](Draw& draw) { triangulateRegion(draw.cutMesh(), uint32_t(draw.id())); }},
    {"cellsAt", [](Draw& draw) { cellsAt(draw.cutMesh(), draw.numbers()); }},
    {"slice",
     [](Draw& draw) {
       slice(draw.cutMesh(), {draw.triple(), draw.number()});
     }},
    {"slices", [](Draw& draw) { slices(draw.cutMesh(), draw.triple(), draw.numbers()); }},
    {"outlines", [](Draw& draw) { outlines(draw.cutMesh(), draw.triple(), draw.numbers()); }},
    {"outlines in one plane",
     [](Draw& draw) {
       outlines(draw.cutMesh(), {draw.triple(), draw.number()});
     }},
    {"inspect", [](Draw& draw) { inspect(draw.mesh()); }},
    {"orient", [](Draw& draw) { orient(draw.mesh()); }},
    {"insideRegions",
     [](Draw& draw) {
       insideRegions(draw.cutMesh(), {draw.rule(), draw.threshold()});
     }},
    {"estimateInside",
     [](Draw& draw) {
       estimateInside(draw.mesh(), draw.cutMesh(), {{}, draw.threshold()});
     }},
    {"generalizedWindingNumbers", [](Draw& draw) { generalizedWindingNumbers(draw.mesh(), draw.numbers()); }},
    {"findIntersections",
     [](Draw& draw) {
       findIntersections(draw.mesh(), {{}, draw.below(3)});
     }},
    {"prepare",
     [](Draw& draw) {
       report(prepare(draw.mesh(), {{}, draw.intersections()}));
     }},
    {"cut", [](Draw& draw) { report(cut(draw.mesh(), draw.grid(), draw.cutOptions())); }},
    {"cut of a prepared mesh", [](Draw& draw) { report(cut(prepare(draw.mesh()).mesh, draw.grid(), draw.cutOptions())); }},
    {"resolve", [](Draw& draw) { report(resolve(draw.mesh())); }},
    {"coarsen", [](Draw& draw) { coarsen(draw.cutMesh(), draw.coarsenOptions()); }},
    {"cellComplex", [](Draw& draw) { draw.cells(); }},
    {"subComplex",
     [](Draw& draw) {
       const std::vector<uint32_t> ids{uint32_t(draw.id()), uint32_t(draw.below(9))};
       subComplex(draw.cells(), ids);
     }},
    {"regionComplex", [](Draw& draw) { regionComplex(draw.cells(), uint32_t(draw.id())); }},
    {"cells at a place",
     [](Draw& draw) {
       const CutMesh& cutMesh = draw.cutMesh();
       const auto [i, j, k] = draw.counts();
       cutMesh.cutCellsAt(i, j, k);
       UntouchedCells(cutMesh).regionAt(i, j, k);
       coarsen(cutMesh).find(i, j, k);
     }},
    {"boundary of a resolved mesh", [](Draw& draw) { boundary(draw.resolvedMesh(), draw.rule()); }},
    {"boundary of a cut-mesh", [](Draw& draw) { boundary(draw.cutMesh(), draw.rule()); }},
    {"boundary of regions", [](Draw& draw) { boundary(draw.cutMesh(), draw.regions()); }},
    {"writeMesh",
     [](Draw& draw) {
       writeMesh(kNowhere, draw.of({FileFormat::obj, FileFormat::stl, FileFormat::ply}), draw.mesh());
     }},
    {"writeCutMesh",
     [](Draw& draw) {
       const FileFormat format = draw.of({FileFormat::vtu, FileFormat::obj, FileFormat::stl, FileFormat::ply});
       writeCutMesh(kNowhere, format, draw.mesh(), draw.cutMesh(), draw.writeOptions());
     }},
    {"writeJson", [](Draw& draw) { writeJson(kNowhere, draw.cutMesh(), draw.groups(), {}); }},
    {"writeJson of cells",
     [](Draw& draw) {
       const CutMesh& cutMesh = draw.cutMesh();
       writeJson(kNowhere, draw.below(4) == 0 ? draw.cutMesh() : cutMesh, draw.cellsOf(cutMesh), draw.writeOptions());
     }},
    {"writeMcm", [](Draw& draw) { writeMcm(kNowhere, draw.cutMesh()); }},
    {"writeVtu and writeFacesVtu of cells",
     [](Draw& draw) {
       const CutMesh& cutMesh = draw.cutMesh();
       const CellComplex cells = draw.cellsOf(cutMesh);
       const CutMesh& ofFile = draw.below(4) == 0 ? draw.cutMesh() : cutMesh;
       const std::vector<double> values(draw.below(2) == 0 ? cells.cellCount() : draw.below(9));
       const std::vector<Field> fields(draw.below(3), Field{draw.below(2) == 0 ? "field" : "", values});
       if (draw.below(2) == 0) return writeVtu(kNowhere, ofFile, cells, fields, draw.writeOptions());
       writeFacesVtu(kNowhere, ofFile, cells, fields, draw.writeOptions());
     }},
    {"writePolyMesh",
     [](Draw& draw) {
       const TemporaryFolder folder;
       const CutMesh& cutMesh = draw.cutMesh();
       writePolyMesh(folder.path("polyMesh"), draw.below(4) == 0 ? draw.cutMesh() : cutMesh, draw.cellsOf(cutMesh), draw.writeOptions());
     }},
    {"writeDefects", [](Draw& draw) { writeDefects(kNowhere, draw.mesh(), inspect(draw.mesh())); }},
    {"writeOutlines",
     [](Draw& draw) {
       const std::vector<double> offsets = {0.25, 0.5};
       OutlineStack stack{draw.triple(), draw.numbers(), outlines(draw.cutMesh(), {0, 0, 1}, offsets)};
       writeOutlines(kNowhere, draw.of({FileFormat::svg, FileFormat::dxf, FileFormat::obj}), stack, draw.writeOptions());
     }},
    {"planeAxes", [](Draw& draw) { planeAxes(draw.triple()); }},
    {"validate", [](Draw& draw) { validate(draw.mesh(), draw.cutMesh(), draw.runOptions()); }},
};

}  // namespace

TEST_CASE("wrong calls: a thousand at random work or report", "[wrong_calls]") {
  const std::vector<Family> all = families();
  Draw draw(all, 1);
  int worked = 0, reported = 0;
  for (int i = 0; i < 1000; ++i) {
    const Call& call = kCalls[draw.below(kCalls.size())];
    INFO(call.name << ", call " << i);
    try {
      call.run(draw);
      ++worked;
    } catch (const CallError& error) {
      ++reported;
      CHECK(error.error.status != Status::ok);
      REQUIRE_FALSE(error.error.message.empty());
      CHECK(error.error.message.back() == '.');
      CHECK(error.what() == error.error.message);
    }
  }
  CHECK(worked > 200);
  CHECK(reported > 200);
}

TEST_CASE("wrong calls: only the cut-mesh's own mesh and measures are taken", "[wrong_calls]") {
  const std::vector<Family> all = families();
  constexpr size_t kCuttable = 6;
  for (size_t i = 0; i < all.size(); ++i) {
    for (size_t j = 0; j < kCuttable; ++j) {
      INFO("mesh " << i << ", cut-mesh " << j);
      const bool same = all[i].mesh.positions == all[j].mesh.positions && all[i].mesh.triangles == all[j].mesh.triangles;
      if (same) {
        CHECK_NOTHROW(measure(all[i].mesh, all[j].cutMesh));
        CHECK_NOTHROW(cutEdges(all[i].mesh, all[j].cutMesh));
      } else {
        CHECK_THROWS_AS(measure(all[i].mesh, all[j].cutMesh), CallError);
        CHECK_THROWS_AS(cutEdges(all[i].mesh, all[j].cutMesh), CallError);
      }
      CHECK(validate(all[i].mesh, all[j].cutMesh).pass == same);
      if (i == j) {
        CHECK_NOTHROW(regionVolumes(all[j].cutMesh, all[i].measures));
      } else {
        CHECK_THROWS_AS(regionVolumes(all[j].cutMesh, all[i].measures), CallError);
      }
    }
  }
}

TEST_CASE("wrong calls: a mesh whose triangles have been reordered since is noticed", "[wrong_calls]") {
  std::vector<Family> all = families();
  const Mesh soup = shapes::unwelded(shapes::icosphere({0, 0, 0}, 1, 1));
  all.push_back(Family(soup, Grid::around(soup, 4)));
  CutOptions snapping;
  snapping.snapTolerance = 0.3;
  all.push_back(Family(soup));
  all.back().cutMesh = cut(soup, Grid::around(soup, 4), snapping).mesh;
  for (const Family& family : all) {
    if (family.cutMesh.faceCount() == 0) continue;
    CHECK_NOTHROW(cellComplex(family.mesh, family.cutMesh, coarsen(family.cutMesh)));
    Mesh reordered = family.mesh;
    std::vector<size_t> order(reordered.triangleCount());
    std::iota(order.begin(), order.end(), size_t(0));
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    for (size_t t = 0; t < order.size(); ++t) std::copy_n(&family.mesh.triangles[3 * order[t]], 3, &reordered.triangles[3 * t]);
    CHECK_THROWS_AS(cellComplex(reordered, family.cutMesh, coarsen(family.cutMesh)), CallError);
  }
}
