// Cut-meshes on both sides: as plain data, and as those that stay here.
#pragma once

#include <memory>

#include "mandoline/resolve.h"
#include "values.h"

namespace mandoline::wasm {

/// A cut-mesh that stays until JavaScript deletes its handle, and for as long as a call works on it.
class KeptCutMesh {
 public:
  explicit KeptCutMesh(CutMesh cutMesh) : cutMesh_(std::make_shared<const CutMesh>(std::move(cutMesh))) {}
  std::shared_ptr<const CutMesh> get() const { return cutMesh_; }
  /// Size of its arrays.
  double bytes() const;

 private:
  std::shared_ptr<const CutMesh> cutMesh_;
};

/// The same for a mesh that was prepared.
class KeptMesh {
 public:
  explicit KeptMesh(PreparedMesh mesh) : mesh_(std::move(mesh)) {}
  const PreparedMesh& get() const { return mesh_; }
  /// About its size.
  double bytes() const;

 private:
  PreparedMesh mesh_;
};

/// The arrays that a cut-mesh has in JavaScript: [{ name, type, optional }].
val describeArrays();

Mesh readMeshArrays(const val& mesh);
/// As much of it as boundary() takes. Whether its arrays fit together is not asked.
ResolvedMesh readResolvedMesh(const val& object);
Grid readGrid(const val& grid, const MeshView& mesh);
/// Whether its arrays fit together is not asked.
CutMesh readCutMesh(const val& object);

/// `dense`: with gridCellRegion.
val toObject(const CutMesh& cutMesh, const CutStats& stats, bool dense);
val toObject(const ResolveResult& result);

}  // namespace mandoline::wasm
