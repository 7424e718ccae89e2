// A mesh of which each process of a communicator has a slice.
#pragma once

#include <memory>

#include "mandoline/distributed.h"
#include "mesh/checked_source.h"
#include "mesh/inspect_plain.h"
#include "mesh/mesh_part.h"
#include "mesh/mesh_source.h"
#include "mpi/communicator.h"

namespace mandoline::detail {

/// What is at work, as for runCall().
constexpr const char* kSlicing = "distribution of the mesh";

/// What all processes know of it, and this one's slice.
struct SlicedMeshData {
  std::shared_ptr<const Mesh> slice;                 ///< triangles by the ids of the whole
  std::shared_ptr<const MeshSource> whole;           ///< if each process can read all; else they tell each other
  std::vector<uint64_t> firstVertex, firstTriangle;  ///< per process, and how many there are
  MeshPart part;                                     ///< this one's triangles with their vertices, if it isFit
  std::vector<uint8_t> isReferenced;                 ///< per vertex of the slice whether a triangle of the whole has it
  bool isFit = false;                                ///< whether all arrays can be followed
  MeshBox box;                                       ///< as boxOf()
  uint64_t bytesSent = 0;                            ///< by this process, to make this

  uint64_t vertices() const { return firstVertex.back(); }
  uint64_t triangles() const { return firstTriangle.back(); }
};

// All but sliceOf() are collective.
std::shared_ptr<const SlicedMeshData> sliced(Communicator& comm, std::shared_ptr<const Mesh> slice,
                                             std::shared_ptr<const MeshSource> whole = nullptr);
/// A slice of a mesh that all processes have, as one of those of all.
MANDOLINE_SHARED Mesh sliceOf(const MeshView& mesh, const ShareOf& shareOf);
/// With the whole's fingerprintOf().
MeshSums sumsOf(Communicator& comm, const SlicedMeshData& mesh);
/// The largest coordinate of a vertex that a triangle has; infinite if one of them is not finite.
double largestCoordinate(Communicator& comm, const SlicedMeshData& mesh);
/// The box, counts, and what inspect() tells of vertices that no triangle has. `surfaces`, one in each process, have the others.
void inspectArrays(Communicator& comm, const SlicedMeshData& mesh, const MeshPart& surface, MeshInfo& info);
/// The whole in each process, or in the first alone.
MANDOLINE_SHARED std::shared_ptr<const Mesh> gathered(Communicator& comm, const SlicedMeshData& mesh, bool inAll);

}  // namespace mandoline::detail
