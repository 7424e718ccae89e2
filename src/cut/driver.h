// What the calls that cut have in common: the clock of the stages, and all stages after "grid".
#pragma once

#include "cut/stages/output.h"
#include "grid/snap.h"
#include "mandoline/prepare.h"

namespace mandoline::detail {

/// A mesh that stays as it is, and the result of preparing it.
struct PreparedMeshData {
  std::shared_ptr<const Mesh> mesh;
  Fingerprint fingerprint;
  Intersections intersections;
  std::unique_ptr<const Prepared> prepared;
};

/// A mesh to be prepared: that of a shared pointer is kept, another one copied.
struct MeshToPrepare {
  MeshView view;
  std::shared_ptr<const Mesh> shared;

  MeshToPrepare(const MeshView& view_) : view(view_) {}
  MeshToPrepare(std::shared_ptr<const Mesh> shared_) : view(*shared_), shared(std::move(shared_)) {}
};

/// What prepare() does.
MANDOLINE_SHARED PrepareResult prepareThis(const MeshToPrepare& mesh, const PrepareOptions& options);
/// How it begins, and how it ends: with the mesh, and with what of it was prepared.
std::shared_ptr<PreparedMeshData> beginPreparing(const MeshToPrepare& mesh, const PrepareOptions& options, Monitor& monitor);
void finishPreparing(std::shared_ptr<PreparedMeshData> data, std::unique_ptr<Prepared> prepared, PrepareResult& result);
/// How many stages these have before that of prepareMesh().
int stagesBefore(const PrepareOptions& options);

/// Adds the counts of a mesh's preparation.
void addCounts(const Prepared& prepared, CutStats& stats);

/// Names the stages for progress and takes their times.
class Clock {
 public:
  /// Progress has so many stages before those of the clock. The total goes on from that of `stats`.
  Clock(CutStats& stats, Monitor& monitor, int before = 0);
  ~Clock() { end(); }  // also of a cut that failed

  void begin(const char* stage);
  /// Goes on with the last stage, which another clock began.
  void resume();

 private:
  void end();

  CutStats& stats_;
  Monitor& monitor_;
  int before_;
  double start_, last_;  // in milliseconds
  bool isInStage_ = false;
};

/// Whether a grid's planes are not so large that a mesh, scaled by 2^shift, has to be scaled for them.
bool fits(int shift, const Grid& grid);

/// A prepared mesh as a grid needs it: prepared once more where the planes are far larger.
class PreparedForGrid {
 public:
  PreparedForGrid(PreparedMesh mesh, const Grid& grid, const RunOptions& options);

  MeshView view() const { return mesh_.mesh(); }
  const Prepared& prepared() const { return again_ ? *again_ : *mesh_.data()->prepared; }
  /// Whether it has been.
  bool isPreparedAgain() const { return again_ != nullptr; }
  Fingerprint fingerprint() const;
  /// Those of a cut that has no others than the preparation.
  CutOptions options() const;

 private:
  PreparedMesh mesh_;
  std::unique_ptr<const Prepared> again_;
};

/// The mesh that is cut: the user's, or with a snap tolerance that with vertices moved onto planes.
class SnappedInput {
 public:
  SnappedInput(const MeshView& mesh, const Grid& grid, const CutOptions& options, CutStats& stats);
  SnappedInput(const SnappedInput&) = delete;

  const MeshView& view() const { return view_; }

 private:
  SnappedMesh moved_;
  MeshView view_;
};

constexpr int kMeshStages = 2;                 ///< of prepareMesh()
constexpr int kInputStages = 5;                ///< of cutInput()
constexpr int kGridStages = 1 + kInputStages;  ///< of a cut of a prepared mesh

/// The stage "grid", of a mesh that lasts.
void beginCut(const Prepared& prepared, const Grid& grid, CutState& state, Clock& clock, Run& run);

/// The stages after "grid" up to "bricks".
void cutInBricks(CutState& state, Clock& clock, Run& run);
/// Those of these after "triEdges": once more for other layers.
void cutBricksHere(CutState& state, Clock& clock, Run& run);
/// The stage "regions", once it is known what all bricks found.
void joinBricks(CutState& state, Clock& clock, Run& run);

/// Cuts: the stages after "grid", which made `state.surface.input` of `mesh` and `grid`. Of a contradiction the Failure has the triangles
/// that are blamed at first: see explainContradiction().
CutMesh cutInput(CutState& state, const MeshView& mesh, const Grid& grid, Clock& clock, Run& run);

/// The same, of `mesh` as it was prepared, and with the triangles that are to blame.
CutMesh cutPrepared(CutState& state, const MeshView& mesh, const Grid& grid, Clock& clock, Run& run);

/// Stands for what a cut was made of.
Fingerprint fingerprintOfCut(Fingerprint mesh, const Grid& grid, const CutOptions& options);
/// Notes it in a cut-mesh.
void sign(CutMesh& cutMesh, Fingerprint mesh, const CutOptions& options);

}  // namespace mandoline::detail
