// Cut-meshes and prepared meshes that stay here, and what calls on them take and give.
#pragma once

#include <memory>

#include "mandoline/coarsen.h"
#include "mandoline/prepare.h"
#include "mandoline/resolve.h"
#include "mandoline/validate.h"
#include "results.h"

namespace mandoline::wasm {

/// A value that stays until JavaScript deletes its handle, and for as long as a call works on it.
template <class Value>
class Kept {
 public:
  explicit Kept(Value value) : value_(std::make_shared<const Value>(std::move(value))) {}
  std::shared_ptr<const Value> get() const { return value_; }
  /// Size of its arrays.
  double bytes() const { return bytesOf(*value_); }

 private:
  std::shared_ptr<const Value> value_;
};
using KeptCutMesh = Kept<CutMesh>;

/// The same for a prepared mesh.
class KeptMesh {
 public:
  explicit KeptMesh(PreparedMesh mesh) : mesh_(std::move(mesh)) {}
  const PreparedMesh& get() const { return mesh_; }
  /// Its approximate size.
  double bytes() const;

 private:
  PreparedMesh mesh_;
};

/// A handle of plain data whose arrays fit together.
template <class Value>
val keepChecked(const val& given, const char* name) {
  Value value = fromObject<Value>(given);
  const Check check = checkArrays(value);
  if (!check.pass) return failure("badArgument", "The arrays of " + std::string(name) + " don't fit together: " + check.message);
  return success(val(Kept<Value>(std::move(value))));
}

/// The same of a cut-mesh; one that is to be validated may be damaged, and isn't checked.
val keepCutMesh(const val& cutMesh, bool isChecked);
val arraysOf(const MeshView& mesh);

/// The stage that a cut has come to.
val lastStage(const CutStats& stats);
/// What a cut gives, with its twin, as the options say: copy, gridCellRegion, keep. The mesh is taken for the twin, if there is to be one.
/// `gridCellRegion`: if it has been made.
val outcomeOf(CutResult& result, const val& options, std::vector<int32_t> gridCellRegion = {});
/// For the other modules.
val dataOf(const KeptCutMesh& kept);

/// Without progress.
CoarsenOptions readCoarsening(const val& options);

/// A grid of any kind.
Grid readGrid(const val& grid, const MeshView& mesh);

}  // namespace mandoline::wasm
