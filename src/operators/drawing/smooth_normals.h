// Smooth normals of a mesh: at each corner of a triangle, the mean over the triangles around it that bend away from it only a little, so
// that creases stay; in between, interpolated.
#pragma once

#include "mandoline/cut_mesh.h"

namespace mandoline::drawing {

/// Bytes x, y, z and 1 in one number, x lowest; 0 for none.
using PackedNormal = uint32_t;

/// Whether two normals are nearly the same: the sum of their bytes' differences is small.
bool areAlike(PackedNormal a, PackedNormal b);

/// Per entry of loopVertices: the normal there of the triangle that the face is a piece of; none for pieces of grid-faces.
std::vector<PackedNormal> faceNormals(const MeshView& mesh, const CutMesh& cutMesh);

}  // namespace mandoline::drawing
