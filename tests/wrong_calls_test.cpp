// Calls with arguments that do not belong together: each works, or reports by a CallError; none crashes. The sanitizers look on.
#include <functional>
#include <limits>
#include <random>

#include "catch.h"
#include "mandoline/locate.h"
#include "mandoline/mandoline.h"
#include "mandoline/measure.h"
#include "mandoline/slice.h"
#include "mandoline/triangulate.h"
#include "mandoline/validate.h"
#include "shapes.h"

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
  ValidateOptions validateOptions() {
    ValidateOptions options;
    options.snapTolerance = below(2) == 0 ? 0 : number();
    options.threads = unsigned(below(4));
    return options;
  }

 private:
  const Family& family() { return families_[below(families_.size())]; }

  const std::vector<Family>& families_;
  std::mt19937 random_;
};

struct Call {
  const char* name;
  std::function<void(Draw&)> run;
};

/// A line for each function that takes arguments which may not fit.
const std::vector<Call> kCalls{
    {"measure", [](Draw& draw) { measure(draw.mesh(), draw.cutMesh()); }},
    {"cutEdges", [](Draw& draw) { cutEdges(draw.mesh(), draw.cutMesh()); }},
    {"regionVolumes", [](Draw& draw) { regionVolumes(draw.cutMesh(), draw.measures()); }},
    {"adjacency", [](Draw& draw) { adjacency(draw.cutMesh()); }},
    {"triangulateFaces", [](Draw& draw) { triangulateFaces(draw.cutMesh()); }},
    {"triangulateCell", [](Draw& draw) { triangulateCell(draw.cutMesh(), draw.id()); }},
    {"triangulateRegion", [](Draw& draw) { triangulateRegion(draw.cutMesh(), uint32_t(draw.id())); }},
    {"locate", [](Draw& draw) { locate(draw.cutMesh(), draw.numbers()); }},
    {"slice",
     [](Draw& draw) {
       slice(draw.cutMesh(), {draw.triple(), draw.number()});
     }},
    {"slices", [](Draw& draw) { slices(draw.cutMesh(), draw.triple(), draw.numbers()); }},
    {"outlines", [](Draw& draw) { outlines(draw.cutMesh(), draw.triple(), draw.numbers()); }},
    {"planeAxes", [](Draw& draw) { planeAxes(draw.triple()); }},
    {"validate", [](Draw& draw) { validate(draw.mesh(), draw.cutMesh(), draw.validateOptions()); }},
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
      if (all[i].cutMesh.cellCount() == all[j].cutMesh.cellCount()) {
        CHECK_NOTHROW(regionVolumes(all[j].cutMesh, all[i].measures));
      } else {
        CHECK_THROWS_AS(regionVolumes(all[j].cutMesh, all[i].measures), CallError);
      }
    }
  }
}
