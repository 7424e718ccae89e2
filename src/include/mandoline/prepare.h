// Preparing a mesh once to cut it with many grids.
#pragma once

#include <memory>

#include "mandoline/cut.h"

namespace MANDOLINE_API mandoline {

namespace detail {
struct PreparedMeshData;
}

/// The part of a cut that does not depend on the grid: the checked and welded mesh, its edges, where its triangles meet. Copies share it.
class PreparedMesh {
 public:
  /// Empty: cutting it fails with emptyMesh.
  PreparedMesh() = default;
  explicit PreparedMesh(std::shared_ptr<const detail::PreparedMeshData> data) : data_(std::move(data)) {}

  /// The mesh that is cut: as it was given, or oriented; empty if there is none.
  MeshView mesh() const;
  const detail::PreparedMeshData* data() const { return data_.get(); }

 private:
  std::shared_ptr<const detail::PreparedMeshData> data_;
};

struct PrepareOptions : RunOptions {
  Intersections intersections = Intersections::resolve;
  /// Takes orient(mesh).mesh instead of the mesh: PreparedMesh::mesh() is that, and what its cuts give has its triangles' normals.
  bool orient = false;
};

struct PrepareResult {
  Error error;
  PreparedMesh mesh;  ///< empty unless ok
  CutStats stats;     ///< of the stages so far

  explicit operator bool() const { return error.status == Status::ok; }
};

/// Checks, welds and resolves a copy of the mesh. Failures come back as a status with the offending elements; it throws nothing but what
/// options.progress throws.
PrepareResult prepare(const MeshView& mesh, const PrepareOptions& options = {});

/// The same result as cut(mesh, grid, options) with the `intersections` of prepare(); options.intersections is ignored. With a snap
/// tolerance, or a grid far larger than the mesh, the mesh is prepared again.
CutResult cut(const PreparedMesh& mesh, const Grid& grid, const CutOptions& options = {});

}  // namespace mandoline
