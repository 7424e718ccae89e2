// Faces between the same cells that become one: faces grow, one after the other, by those beside them, and keep one simple loop.
#pragma once

#include "base/csr.h"
#include "base/function_ref.h"
#include "mandoline/cell_complex.h"

namespace mandoline::merging {

/// What is to become of a face.
enum class Fate : uint8_t {
  goes,   ///< vanishes
  stays,  ///< as it is
  joins   ///< may join others
};

/// The new faces, in the order of their first members.
struct JoinedFaces {
  detail::Csr<uint32_t> members;  ///< per new face, ascending
  detail::Csr<uint32_t> loops;    ///< per new face of several members: its loop; else empty
};

/// Edges inside a new face have no other faces. `mayJoin(first, face)`: whether the new face that begins with `first` may have `face`.
JoinedFaces joinFaces(const CellComplex& cells, const std::vector<Fate>& fates, detail::FunctionRef<bool(uint32_t, uint32_t)> mayJoin);

/// Fills in the new faces. Their cells are those that the first members had.
void replaceFaces(const CellComplex& cells, const JoinedFaces& faces, CellComplex& result);

}  // namespace mandoline::merging
