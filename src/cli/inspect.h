// What kind of mesh a file holds.
#pragma once

#include "cli/arguments.h"
#include "mandoline/mandoline.h"

namespace mandoline::cli {

/// Counts of a mesh whose vertices at one position are taken as one. Edges are those of triangles with three different vertices.
struct MeshInfo {
  size_t vertices = 0, triangles = 0;
  size_t weldedVertices = 0;  ///< share their position with another one
  size_t unreferencedVertices = 0;
  size_t nonFiniteVertices = 0;
  Box box{};                      ///< of the referenced vertices; all zero if there are none
  size_t openEdges = 0;           ///< with one triangle
  size_t nonManifoldEdges = 0;    ///< with more than two
  size_t inconsistentEdges = 0;   ///< with two that run the same way along it
  bool closed = false;            ///< every edge has an even number of triangles
  bool oriented = false;          ///< every edge is run through equally often both ways, so that there are winding numbers
  size_t components = 0;          ///< joined through vertices
  size_t zeroAreaTriangles = 0;   ///< exactly
  size_t duplicateTriangles = 0;  ///< same three vertices as another one before them
};

MeshInfo inspect(const MeshView& mesh);

/// Of the referenced vertices' finite coordinates; all zero if there are none.
Box boundingBox(const MeshView& mesh);

std::string infoJson(const std::string& path, const MeshInfo& info);
std::string infoText(const std::string& path, const MeshInfo& info);

}  // namespace mandoline::cli
