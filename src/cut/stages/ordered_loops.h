// The loops of tri-cut-faces, written in another order.
#pragma once

#include <span>

#include "cut/stages/tri_faces.h"

namespace mandoline::detail {

/// Writes the numbers of the vertices of all loops, face by face in that order, and where each loop begins.
void writeOrderedLoops(const TriFaces& faces, std::span<const FaceId> order, std::span<uint32_t> vertices, uint32_t* offsets);

}  // namespace mandoline::detail
