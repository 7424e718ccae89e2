// What kind of mesh one is: closed, oriented, manifold; and where it is not.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mandoline/mesh.h"

namespace MANDOLINE_API mandoline {

/// What is wrong with an edge.
enum class EdgeDefect : uint8_t {
  open,         ///< it has one triangle
  nonManifold,  ///< it has more than two
  inconsistent  ///< it has two that run the same way along it
};
constexpr size_t kEdgeDefects = 3;

/// The defect as the word above.
inline const char* name(EdgeDefect defect) {
  constexpr const char* kNames[kEdgeDefects] = {"open", "nonManifold", "inconsistent"};
  return kNames[size_t(defect)];
}

/// A mesh's bounding box, as MeshInfo has it.
struct MeshBox {
  std::array<double, 3> min{}, max{};
};

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
  size_t components = 0;               ///< triangles that hang together through edges
  size_t zeroAreaTriangles = 0;        ///< exactly
  size_t duplicateTriangles = 0;       ///< same three vertices as another one before them
  size_t weldedVertices = 0;           ///< share their position with another one
  size_t unreferencedVertices = 0;
  size_t nonFiniteVertices = 0;

  // The components: triangles that hang together through edges. In the order of their first triangles.
  std::vector<int32_t> triangleComponent;  ///< per triangle; -1 without three different vertices
  std::vector<uint8_t> componentClosed;    ///< per component: 1 if it is closed as above, else 0
  std::vector<uint8_t> componentOriented;  ///< the same of oriented

  // The defects: edges that are open, non-manifold or inconsistent, ascending by their vertices.
  std::vector<uint32_t> defectVertices;  ///< 2 per defect: the edge's ends, the lower one first; the lowest ids at their positions
  std::vector<EdgeDefect> defectKind;    ///< per defect
  std::vector<uint32_t> defectTriangleOffsets{0};  ///< per defect, into defectTriangles
  std::vector<uint32_t> defectTriangles;           ///< those at the edge, ascending
  std::vector<uint32_t> defectPlace;               ///< per defect

  // The places: defects of one component that hang together through vertices, such as the edges around a hole. In the order of their first
  // defects.
  std::vector<uint32_t> placeComponent;  ///< per place
  std::vector<double> placeBox;          ///< 6 per place: the lowest corner of the box around its edges, then the highest

  size_t defectCount() const { return defectKind.size(); }
  size_t placeCount() const { return placeComponent.size(); }

  static void fields(auto& self, const auto& f) {
    f("vertices", self.vertices);
    f("triangles", self.triangles);
    f("min", self.min);
    f("max", self.max);
    f("closed", self.closed);
    f("oriented", self.oriented);
    f("openEdges", self.openEdges);
    f("nonManifoldEdges", self.nonManifoldEdges);
    f("inconsistentEdges", self.inconsistentEdges);
    f("components", self.components);
    f("zeroAreaTriangles", self.zeroAreaTriangles);
    f("duplicateTriangles", self.duplicateTriangles);
    f("weldedVertices", self.weldedVertices);
    f("unreferencedVertices", self.unreferencedVertices);
    f("nonFiniteVertices", self.nonFiniteVertices);
    f("triangleComponent", self.triangleComponent);
    f("componentClosed", self.componentClosed);
    f("componentOriented", self.componentOriented);
    f("defectVertices", self.defectVertices);
    f("defectKind", self.defectKind);
    f("defectTriangleOffsets", self.defectTriangleOffsets);
    f("defectTriangles", self.defectTriangles);
    f("defectPlace", self.defectPlace);
    f("placeComponent", self.placeComponent);
    f("placeBox", self.placeBox);
  }
};

/// Throws CallError as inspect() does.
MeshBox boxOf(const MeshView& mesh);
/// Throws CallError if the length of an array is not a multiple of 3 (badArrays), or for a triangle that names a vertex that does not exist
/// (badIndex; element: the triangle).
MeshInfo inspect(const MeshView& mesh);

}  // namespace mandoline
