#include "mandoline/for_each_brick.h"

#include <bit>

#include "cut/brick_triangles.h"
#include "cut/contradiction.h"
#include "cut/driver.h"
#include "cut/restricted.h"
#include "cut/stages/input.h"
#include "mesh/excerpt.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"

namespace mandoline {
namespace detail {
namespace {

int shiftOf(int64_t cells) {
  constexpr int64_t kMost = int64_t(1) << 24;
  if (cells < 1 || cells > kMost || !std::has_single_bit(uint64_t(cells)))
    throw Failure{{Status::badOption, -1, -1, "cells must be a power of two from 1 to 2^24."}};
  return std::countr_zero(uint64_t(cells));
}

class BrickByBrick {
 public:
  /// `mesh` is that of the user, which was prepared with the intersections of `cutOptions`.
  BrickByBrick(const Prepared& prepared, const MeshView& mesh, const Grid& grid, const CutOptions& cutOptions, Run& run)
      : prepared_(prepared), mesh_(mesh), grid_(grid), cutOptions_(cutOptions), run_(run) {}

  void run(const std::function<void(CutPiece)>& f, const ForEachBrickOptions& options) {
    run_.monitor.beginStage("grid", 0);
    input_ = prepareInput(prepared_, grid_, run_);
    bricks_ = BrickGrid(input_, shiftOf(options.cells));
    triangles_ = findBrickTriangles(input_, bricks_);
    run_.monitor.beginStage("bricks", 1);
    const uint64_t all = uint64_t(bricks_.counts[0]) * uint64_t(bricks_.counts[1]) * uint64_t(bricks_.counts[2]);
    total_ = options.untouched ? all : triangles_.near.keys.size();
    for (done_ = 0; done_ < total_; ++done_) {
      CutPiece piece = cut(options.untouched ? done_ : triangles_.near.keys[done_], options);
      if (options.untouched || piece.cutMesh.cellCount() > 0) callBack(f, std::move(piece));
    }
  }

 private:
  CutPiece cut(uint64_t key, const ForEachBrickOptions& options) {
    const Excerpt excerpt(prepared_, triangles_.near[key]);
    const BrickBox box = withMargin(bricks_, key);
    CutPiece piece;
    takeMesh(excerpt, piece);
    BrickBox brick = bricks_.boxOf(key);
    for (size_t d = 0; d < 3; ++d) {
      piece.first[d] = brick.first[d];
      brick.first[d] -= box.first[d];
    }
    piece.cutMesh = restrictedTo(brick, cutBox(excerpt, key, piece.mesh, options));
    sign(piece.cutMesh, fingerprintOf(piece.mesh), cutOptions_);
    return piece;
  }

  /// The brick with its margin.
  CutMesh cutBox(const Excerpt& excerpt, uint64_t key, const MeshView& mesh, const ForEachBrickOptions& options) {
    const BrickBox box = withMargin(bricks_, key);
    std::array<std::vector<double>, 3> planes;
    for (size_t d = 0; d < 3; ++d) planes[d] = planesOf(grid_.planes[d], box, d);
    RunOptions part{options.threads, {}};
    if (options.progress)
      part.progress = [&](const Progress&) { return options.progress({"bricks", 1, 2, size_t(done_), size_t(total_)}); };
    constexpr int kStages = 1;  // none is told of
    Monitor monitor(part, kStages);
    CutStats stats;
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    CutState state;
    setInput(excerpt, key, state.surface.input);
    try {
      return cutInput(state, mesh, Grid::rectilinear(std::move(planes)), clock, run);
    } catch (Failure& failure) {
      throw Failure{ofWhole(failure.error, excerpt)};
    }
  }

  void takeMesh(const Excerpt& excerpt, CutPiece& piece) const {
    piece.triangles = excerpt.triangles;
    piece.triVertices.assign(excerpt.vertices.begin(), excerpt.vertices.begin() + excerpt.mesh.triVertices);
    for (const uint32_t v : piece.triVertices) {
      const double* p = &mesh_.positions[3 * size_t(v)];
      piece.mesh.positions.insert(piece.mesh.positions.end(), p, p + 3);
    }
    for (const auto& corners : excerpt.mesh.triangles)
      piece.mesh.triangles.insert(piece.mesh.triangles.end(), corners.begin(), corners.end());
  }

  /// As prepareInput() would: the same slabs, but counted from the margin.
  void setInput(const Excerpt& excerpt, uint64_t key, Input& input) const {
    const BrickBox box = withMargin(bricks_, key);
    input.mesh = &excerpt.mesh;
    for (size_t d = 0; d < 3; ++d) input.planes[d] = planesOf(input_.planes[d], box, d);
    input.slabs.reserve(excerpt.vertices.size());
    for (const uint32_t v : excerpt.vertices) {
      Slab slab = input_.slabs[{v}];
      for (size_t d = 0; d < 3; ++d) slab[d] = std::clamp(slab[d] - 2 * box.first[d], -1, 2 * box.count[d] + 1);
      input.slabs.push_back(slab);
    }
    input.cornerWinding = windingAtBrick(input_, bricks_, triangles_, key);
  }

  /// An error that names triangles of an excerpt.
  Error ofWhole(Error error, const Excerpt& excerpt) const {
    for (int64_t* triangle : {&error.element, &error.element2}) {
      if (*triangle >= 0) *triangle = excerpt.triangles[size_t(*triangle)];
    }
    if (error.status != Status::selfIntersection) return error;
    return explainContradiction(input_, error.element, error.element2, run_);
  }

  /// What f throws passes through, even if the library throws the same.
  static void callBack(const std::function<void(CutPiece)>& f, CutPiece piece) {
    try {
      f(std::move(piece));
    } catch (...) {
      throw ProgressFailed{std::current_exception()};
    }
  }

  const Prepared& prepared_;
  const MeshView& mesh_;
  const Grid& grid_;
  const CutOptions& cutOptions_;
  Run& run_;
  Input input_;
  BrickGrid bricks_;
  BrickTriangles triangles_;
  uint64_t done_ = 0, total_ = 0;
};

}  // namespace
}  // namespace detail

void forEachBrick(const PreparedMesh& mesh, const Grid& grid, const std::function<void(CutPiece)>& f, const ForEachBrickOptions& options) {
  using namespace detail;
  runCall("cut", [&] {
    checkGrid(grid, 0);
    const MeshView view = mesh.mesh();
    Monitor monitor(options, 2);
    CutStats stats;
    Run run{stats, monitor};
    const PreparedMeshData* data = mesh.data();
    CutOptions cutOptions;
    if (data) cutOptions.intersections = data->intersections;
    std::unique_ptr<const Prepared> again;  // where the grid is far larger than the mesh
    if (!data || !fits(*data->prepared, grid))
      again = prepareMesh(view, {largestCoordinate(grid), cutOptions.intersections}, monitor, [](const char*) {});
    BrickByBrick(again ? *again : *data->prepared, view, grid, cutOptions, run).run(f, options);
  });
}

}  // namespace mandoline
