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

void requireBrick(uint64_t brick, uint64_t count) {
  if (brick < count) return;
  const std::string message = "There is no brick " + std::to_string(brick) + ": there are " + std::to_string(count) + ".";
  throw CallError({Status::badArgument, int64_t(brick), -1, message});
}

}  // namespace

/// A mesh and a grid, and what each brick has to know of them.
class BrickSource {
 public:
  /// `mesh` is that of the user, which was prepared with the intersections of `cutOptions`.
  BrickSource(const Prepared& prepared, const MeshView& mesh, const Grid& grid, const CutOptions& cutOptions,
              const ForEachBrickOptions& options)
      : prepared_(prepared), mesh_(mesh), grid_(grid), cutOptions_(cutOptions), untouched_(options.untouched) {
    Monitor monitor(options, 1);
    monitor.beginStage("grid", 0);
    CutStats stats;
    Run run{stats, monitor};
    input_ = prepareInput(prepared_, grid_, run);
    bricks_ = BrickGrid(input_, BrickGrid::same(shiftOf(options.cells)));
    triangles_ = findBrickTriangles(input_, bricks_);
  }

  uint64_t count() const {
    const uint64_t all = uint64_t(bricks_.counts[0]) * uint64_t(bricks_.counts[1]) * uint64_t(bricks_.counts[2]);
    return untouched_ ? all : triangles_.near.keys.size();
  }

  BrickBox boxOf(uint64_t brick) const { return bricks_.boxOf(keyOf(brick)); }

  CutPiece cut(uint64_t brick, const RunOptions& options) const {
    const uint64_t key = keyOf(brick);
    const Excerpt excerpt(prepared_, triangles_.near[key]);
    const BrickBox margin = withMargin(bricks_, key);
    CutPiece piece;
    takeMesh(excerpt, piece);
    BrickBox box = bricks_.boxOf(key);
    for (size_t d = 0; d < 3; ++d) {
      piece.first[d] = box.first[d];
      box.first[d] -= margin.first[d];
    }
    piece.cutMesh = restrictedTo(box, cutBox(excerpt, key, piece.mesh, options));
    sign(piece.cutMesh, fingerprintOf(piece.mesh), cutOptions_);
    return piece;
  }

 private:
  uint64_t keyOf(uint64_t brick) const { return untouched_ ? brick : triangles_.near.keys[brick]; }

  /// The brick with its margin.
  CutMesh cutBox(const Excerpt& excerpt, uint64_t key, const MeshView& mesh, const RunOptions& options) const {
    const BrickBox box = withMargin(bricks_, key);
    std::array<std::vector<double>, 3> planes;
    for (size_t d = 0; d < 3; ++d) planes[d] = planesOf(grid_.planes[d], box, d);
    Monitor monitor(options, kInputStages);
    CutStats stats;
    Clock clock(stats, monitor);
    Run run{stats, monitor};
    CutState state;
    setInput(excerpt, key, state.surface.input);
    try {
      return cutInput(state, mesh, Grid::rectilinear(std::move(planes)), clock, run);
    } catch (Failure& failure) {
      throw Failure{ofWhole(failure.error, excerpt, run)};
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
  Error ofWhole(Error error, const Excerpt& excerpt, Run& run) const {
    excerpt.nameByWhole(error);
    if (error.status != Status::selfIntersection) return error;
    return explainContradiction(input_, error.element, error.element2, run);
  }

  const Prepared& prepared_;
  const MeshView mesh_;
  const Grid& grid_;
  const CutOptions cutOptions_;
  const bool untouched_;
  Input input_;
  BrickGrid bricks_;
  BrickTriangles triangles_;
};

}  // namespace detail

using namespace detail;

struct BrickCutter::Data {
  Data(PreparedMesh mesh_, Grid grid_, const ForEachBrickOptions& options)
      : mesh(std::move(mesh_), grid_, options),
        grid(std::move(grid_)),
        source(mesh.prepared(), mesh.view(), grid, mesh.options(), options) {}

  PreparedForGrid mesh;
  Grid grid;
  BrickSource source;
};

BrickCutter::BrickCutter(PreparedMesh mesh, Grid grid, const ForEachBrickOptions& options) {
  runCall("cut", [&] { data_ = std::make_shared<Data>(std::move(mesh), std::move(grid), options); });
}

uint64_t BrickCutter::count() const { return data_->source.count(); }

std::array<int64_t, 3> BrickCutter::first(uint64_t brick) const {
  requireBrick(brick, count());
  const auto [x, y, z] = data_->source.boxOf(brick).first;
  return {x, y, z};
}

CutPiece BrickCutter::cut(uint64_t brick, const RunOptions& options) const {
  requireBrick(brick, count());
  return runCall("cut", [&] { return data_->source.cut(brick, options); });
}

void forEachBrick(const PreparedMesh& mesh, const Grid& grid, const std::function<void(CutPiece)>& f, const ForEachBrickOptions& options) {
  constexpr int kStages = 2;
  const auto told = [&](Progress progress, int stage) {
    progress.stageIndex = stage;
    progress.stageCount = kStages;
    return options.progress(progress);
  };
  ForEachBrickOptions atFirst = options;
  if (options.progress) atFirst.progress = [&](const Progress& progress) { return told(progress, 0); };
  const BrickCutter cutter(mesh, grid, atFirst);
  const uint64_t total = cutter.count();
  for (uint64_t done = 0; done < total; ++done) {
    RunOptions part{options.threads, {}};
    if (options.progress) part.progress = [&](const Progress&) { return told({"bricks", 0, 0, size_t(done), size_t(total)}, 1); };
    CutPiece piece = cutter.cut(done, part);
    if (options.untouched || piece.cutMesh.cellCount() > 0) f(std::move(piece));
  }
}

}  // namespace mandoline
