// A cut that the processes of an MPI communicator make together, which leaves to each of them a piece. Each process begins with the whole
// mesh or a slice of it; what is made of it is held in pieces. In mandoline::mpi, which exists where MPI is found.
//
//   DistributedCut cut(MPI_COMM_WORLD, mesh, grid);  // in all processes, of the same mesh and grid
//   RankPiece piece = cut.piece();
//
// All calls are collective: all processes of the communicator make them, in the same order. The result does not depend on how many there
// are: sorted by their global ids, the pieces are the cut-mesh of cut(), to the bit.
#pragma once

#include <mpi.h>

#include <memory>

#include "mandoline/coarsen.h"
#include "mandoline/cut_share.h"
#include "mandoline/inspect.h"
#include "mandoline/measure.h"
#include "mandoline/rank_complex.h"
#include "mandoline/rank_piece.h"

namespace MANDOLINE_API mandoline {

namespace detail {
struct MeshSource;
struct SlicedMeshData;
}  // namespace detail

/// Thrown by all processes where one of them failed.
struct RankError : CallError {
  RankError(Error error_, int rank_) : CallError(std::move(error_)), rank(rank_) {}

  int rank;  ///< the lowest that failed; the error is its own
};

struct PreparedTogether {
  PreparedMesh mesh;
  CutStats stats;          ///< of the stages so far
  uint64_t bytesSent = 0;  ///< by this process to others
};

/// What prepare() gives, to the bit: the processes divide the search for triangles that meet. Throws RankError, alike in all processes, as
/// prepare() has errors, or for different meshes (badArgument, element: the first rank with another). `inFirst`: what the process of rank
/// 0 does meanwhile; it then searches only if it is alone.
PreparedTogether prepareTogether(MPI_Comm comm, const MeshView& mesh, const PrepareOptions& options = {},
                                 const std::function<void()>& inFirst = {});
/// The same, of a mesh that is kept in the place of a copy.
PreparedTogether prepareTogether(MPI_Comm comm, std::shared_ptr<const Mesh> mesh, const PrepareOptions& options = {},
                                 const std::function<void()>& inFirst = {});

/// A mesh of which each process has only a slice. To make it is collective, and can't be cancelled.
class SlicedMesh {
 public:
  /// `slice`: vertices that follow those of the processes of lower ranks, and likewise triangles, which name vertices by their ids in the
  /// whole, from 0. Any of these may be few or none. Throws RankError, alike in all processes, where one of them fails. `whole`: where
  /// each process can read all of the mesh in pieces, of which then little has to be sent; in all processes or in none.
  SlicedMesh(MPI_Comm comm, Mesh slice, std::shared_ptr<const detail::MeshSource> whole = nullptr);

  uint64_t vertexCount() const;    ///< of the whole
  uint64_t triangleCount() const;  ///< likewise
  /// As boxOf() the whole, unless arrays are wrong, as DistributedCut will say.
  MeshBox box() const;

  const std::shared_ptr<const detail::SlicedMeshData>& data() const { return data_; }

 private:
  std::shared_ptr<const detail::SlicedMeshData> data_;
};

class DistributedCut {
 public:
  /// Cuts. Throws RankError, alike in all processes, as CutShare does, or for different meshes or grids (badArgument, element: the first
  /// rank with another). A process that is cancelled while it waits for others throws CallError (cancelled), and the others wait for it:
  /// cancel all of them, or end the program. The mesh, prepared and as it was, is freed on the way, if the caller has no copy.
  DistributedCut(MPI_Comm comm, PreparedMesh mesh, Grid grid, const RunOptions& options = {});
  /// Prepares the mesh and cuts. Each process prepares only what it cuts, where all triangles have area and differ, none meet, and the mesh
  /// is closed or no edge has more than two triangles; other meshes each process prepares as a whole, as prepareTogether() does, with the
  /// same errors. `mesh` is not null; it is freed as soon as it is not needed whole, if the caller has no copy. `info`, which is null in
  /// all processes or in none, becomes what inspect() gives in the process of rank 0; of its arrays there may be none.
  DistributedCut(MPI_Comm comm, std::shared_ptr<const Mesh> mesh, Grid grid, const PrepareOptions& options = {}, MeshInfo* info = nullptr);

  /// The same of a mesh in slices, which are freed on the way if the caller has no copy. Only if a mesh has to be prepared as a whole, or
  /// to be inspected for edges with more than two triangles, do all processes gather it, or the first.
  DistributedCut(MPI_Comm comm, SlicedMesh mesh, Grid grid, const PrepareOptions& options = {}, MeshInfo* info = nullptr);

  /// This process's piece.
  RankPiece piece() const;
  /// The same, and frees what it was made of: after that there is no piece() and no gather().
  RankPiece takePiece();
  /// This process's cells, the untouched grid cells among them, and as many layers of ghosts on each side, as far as the grid goes. `piece`
  /// is that of piece(). Without layers of its own it has no ghosts. Throws CallError for fewer than one layer of ghosts (badOption).
  RankComplex cellComplex(const RankPiece& piece, int ghostLayers = 1) const;
  /// The same with octree cells in the place of untouched grid cells, and so many rings of ghosts: cells that touch own cells, those that
  /// touch these, and so on. Each process makes the octree of the whole, from the runs that all have. Throws RankError, as coarsen() has
  /// errors.
  RankComplex cellComplex(const RankPiece& piece, int ghostRings, const CoarsenOptions& coarsening) const;
  /// Those of the whole.
  CutCounts counts() const;
  /// How many cut-cells this process has.
  uint64_t ownCells() const;
  /// Of this process's piece, as of measure(), to the bit, for which there is no need of the mesh. `piece` is that of piece(). Not
  /// collective.
  Measures measures(const RankPiece& piece, const RunOptions& options = {}) const;
  /// Volume of each region, as of regionVolumes(), to the bit. `piece` is that of piece().
  std::vector<double> regionVolumes(const RankPiece& piece) const;
  /// What all processes know alike: the cut-mesh without vertices, faces and cut-cells, and how the cut went in this one.
  /// stats.exactFallbacks is that of all.
  const CutResult& common() const;
  /// The whole cut in the process of rank 0, to the bit, and nothing in the others. To be called last.
  CutResult gather();
  /// Of the stages that the mesh was prepared in, if the cut has done that.
  const CutStats& preparation() const;
  /// Whether each process has prepared only what it cuts.
  bool isPreparedInShares() const;
  /// What this process has sent to others so far.
  uint64_t bytesSent() const;

 private:
  struct Data;
  std::shared_ptr<Data> data_;
};

}  // namespace mandoline
