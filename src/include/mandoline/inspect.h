// What kind of mesh one is: closed, oriented, manifold.
#pragma once

#include <array>

#include "mandoline/mesh.h"

namespace MANDOLINE_API mandoline {

/// What a mesh has. Vertices at one position count as one, except in the number of vertices. Edges are those of triangles with three
/// different vertices.
struct MeshInfo {
  size_t vertices = 0, triangles = 0;  ///< as they were given
  std::array<double, 3> min{}, max{};  ///< bounding box of the finite coordinates in use; all zero if there are none
  bool closed = false;                 ///< every edge has an even number of triangles
  bool oriented = false;               ///< every edge is traversed equally often both ways, so that there are winding numbers
  size_t openEdges = 0;                ///< with one triangle
  size_t nonManifoldEdges = 0;         ///< with more than two
  size_t inconsistentEdges = 0;        ///< with two that run the same way along it
  size_t components = 0;               ///< joined through vertices
  size_t zeroAreaTriangles = 0;        ///< exactly
  size_t duplicateTriangles = 0;       ///< same three vertices as another one before them
  size_t weldedVertices = 0;           ///< share their position with another one
  size_t unreferencedVertices = 0;
  size_t nonFiniteVertices = 0;
};

/// Throws CallError if the length of an array is not a multiple of 3 (badArrays), or for a triangle that names a vertex that does not exist
/// (badIndex; element: the triangle).
MeshInfo inspect(const MeshView& mesh);

}  // namespace mandoline
