// The parts of a mesh that is not closed as a whole, and which of them have an inside: one bad part blinds no other.
//
// Triangles are joined by the tri-edges that they need each other at. An edge that parts of the mesh share joins only those whose own
// triangles there don't cancel: two closed boxes that touch along an edge are two parts, and a sheet that ends at a box is its own.
#pragma once

#include "mandoline/cut.h"
#include "mesh/mesh_edges.h"

namespace mandoline::detail {

struct Prepared;

/// What kind of part a triangle belongs to.
enum class PartKind : uint8_t {
  winding,  ///< closed and consistently oriented: has winding numbers
  parity,   ///< every tri-edge has an even number of its triangles, but it is not consistently oriented
  open,
  none  ///< the triangle has no area
};

struct Parts {
  std::vector<PartKind> kinds;  ///< per input triangle, duplicates too; empty if the whole mesh has winding numbers
  PartCounts counts;
};

/// Of the mesh as it was resolved, whose tri-edges have those uses.
Parts findParts(const Prepared& prepared, const EdgeUses& uses);

}  // namespace mandoline::detail
