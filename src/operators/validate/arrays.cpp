// The arrays of a cut-mesh: lengths, offsets and id ranges. Everything else in validate() relies on these.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "operators/validate/context.h"
#include "operators/validate/tally.h"

namespace mandoline::validation {
namespace {

class ArrayCheck {
 public:
  ArrayCheck(const CutMesh& cut, const MeshView* mesh) : cut_(cut), mesh_(mesh) {}

  Check run() {
    // Later steps index with what earlier ones have checked.
    checkInput() && checkGrid() && checkVertices() && checkMade() && checkFaces() && checkFaceParents() && checkCells() && checkRuns() &&
        checkRest();
    return tally_.finish();
  }

 private:
  bool expect(bool holds, const char* kind, int64_t element, const char* text) {
    if (!holds) tally_.violate(kind, element, text);
    return holds;
  }
  bool expectOffsets(const std::vector<uint32_t>& offsets, size_t items, size_t end, const char* kind, const char* text) {
    if (offsets.size() != items + 1 || offsets.front() != 0 || offsets.back() != end)
      return expect(false, kind, int64_t(offsets.size()), text);
    for (size_t i = 0; i < items; ++i) {
      if (offsets[i] > offsets[i + 1]) return expect(false, kind, int64_t(i), text);
    }
    return true;
  }
  struct Range {
    int64_t low, high;
  };
  template <class Container>
  bool expectRange(const Container& values, const Range& range, const char* kind, const char* text, size_t perElement = 1) {
    for (size_t i = 0; i < values.size(); ++i) {
      if (int64_t(values[i]) < range.low || int64_t(values[i]) > range.high) return expect(false, kind, int64_t(i / perElement), text);
    }
    return true;
  }

  int64_t lastTriVertex() const { return mesh_ ? int64_t(mesh_->vertexCount()) - 1 : INT32_MAX; }

  bool checkInput() {
    if (!mesh_) return true;
    if (!expect(cut_.triangleCount == mesh_->triangleCount(), "array", 0,
                "of the input's triangles has another length than triangleCount says"))
      return false;
    if (!expect(mesh_->positions.size() % 3 == 0 && mesh_->triangles.size() % 3 == 0, "array", 0,
                "of the input has a length that is not a multiple of 3"))
      return false;
    if (!expectRange(mesh_->triangles, {0, int64_t(mesh_->vertexCount()) - 1}, "triangle",
                     "of the input names a tri-vertex that does not exist", 3))
      return false;
    for (size_t i = 0; i < mesh_->triangles.size(); ++i) {
      for (int d = 0; d < 3; ++d) {
        if (!std::isfinite(mesh_->positions[3 * size_t(mesh_->triangles[i]) + d]))
          return expect(false, "triangle", int64_t(i / 3), "of the input is not finite");
      }
    }
    return true;
  }

  bool checkGrid() {
    for (int d = 0; d < 3; ++d) {
      const std::vector<double>& planes = cut_.grid.planes[d];
      if (!expect(planes.size() >= 2 && planes.size() <= (size_t(1) << 24) + 1, "axis", d, "has no cells or too many")) return false;
      for (size_t i = 0; i < planes.size(); ++i) {
        const bool fine = std::isfinite(planes[i]) && (i == 0 || planes[i - 1] < planes[i]);
        if (!expect(fine, "axis", d, "has planes that are not finite or do not ascend")) return false;
      }
    }
    const double negligible = std::ldexp(1.0, kNegligibleExponent - scaleOf(mesh_ ? *mesh_ : MeshView({}, {}), cut_.grid));
    for (int d = 0; d < 3; ++d) {
      for (size_t i = 1; i < cut_.grid.planes[d].size(); ++i) {
        const bool fine = std::max(std::fabs(cut_.grid.planes[d][i - 1]), std::fabs(cut_.grid.planes[d][i])) >= negligible;
        if (!expect(fine, "axis", d, "has planes too close for the size of the whole")) return false;
      }
    }
    return expect(cut_.grid.cells(1) * cut_.grid.cells(2) <= int64_t(1) << 28, "grid", 0, "has too many rows") &&
           expect(cut_.snapTolerance >= 0 && cut_.snapTolerance < 0.5, "grid", 0,
                  "has a snap tolerance below 0, or of half a cell or more");
  }

  bool checkVertices() {
    const size_t n = cut_.vertexCount();
    const bool lengths = cut_.positions.size() == 3 * n && cut_.vertexCell.size() == 3 * n && cut_.vertexTriVertex.size() == n &&
                         cut_.vertexParents.size() == 2 * n;
    if (!expect(lengths && n < UINT32_MAX, "array", 0, "of the vertices has a wrong length")) return false;
    for (size_t v = 0; v < n; ++v) {
      if (!expect(cut_.vertexMask[v] < 8, "vertex", int64_t(v), "has a mask of more than three bits")) return false;
      for (int d = 0; d < 3; ++d) {
        const int32_t c = cut_.vertexCell[3 * v + d];
        if (!expect(std::isfinite(cut_.positions[3 * v + d]), "vertex", int64_t(v), "has a position that is not finite")) return false;
        if (!expect(c >= 0 && c < cut_.grid.cells(d) + (cut_.vertexMask[v] >> d & 1), "vertex", int64_t(v), "lies in no grid cell"))
          return false;
      }
    }
    return expectRange(cut_.vertexTriVertex, {-1, lastTriVertex()}, "vertex", "names a tri-vertex that does not exist") && checkParents();
  }

  bool checkParents() {
    const int64_t last = lastTriVertex(), triangles = cut_.triangleCount;
    for (size_t v = 0; v < cut_.vertexCount(); ++v) {
      const int64_t a = cut_.vertexParents[2 * v], b = cut_.vertexParents[2 * v + 1];
      const bool fine = b >= 0 ? a >= 0 && a <= last && b <= last : b == -1 && a >= -1 && a < triangles;
      if (!expect(fine, "vertex", int64_t(v), "has parents that do not exist")) return false;
    }
    return true;
  }

  bool checkMade() {
    const size_t n = cut_.madeVertices.size();
    if (!expect(cut_.madeVertexKinds.size() == n && cut_.madeVertexParents.size() == 4 * n, "array", 0,
                "of the made vertices has a wrong length"))
      return false;
    for (size_t i = 0; i < n; ++i) {
      const uint32_t v = cut_.madeVertices[i];
      const bool inOrder = v < cut_.vertexCount() && (i == 0 || cut_.madeVertices[i - 1] < v);
      if (!expect(inOrder, "vertex", v, "is listed as made but does not exist or is out of order")) return false;
      if (!expect(cut_.vertexParents[2 * size_t(v)] == -1 && cut_.vertexTriVertex[v] == -1, "vertex", v,
                  "is listed as made but has other parents"))
        return false;
      if (!expect(cut_.madeVertexKinds[i] <= uint8_t(MadeVertex::trianglesPlane), "vertex", v, "is made in no known way")) return false;
      if (!expect(hasMadeParents(i), "vertex", v, "is made by parents that do not exist")) return false;
    }
    return true;
  }
  bool hasMadeParents(size_t made) const {
    const MadeVertex kind = MadeVertex(cut_.madeVertexKinds[made]);
    const int triVertices = kind == MadeVertex::edgeTriangle ? 2 : kind == MadeVertex::edgeEdge ? 4 : 0;
    const int all = kind == MadeVertex::edgeEdge ? 4 : kind == MadeVertex::trianglesPlane ? 2 : 3;
    for (int i = 0; i < 4; ++i) {
      const int64_t parent = cut_.madeVertexParents[4 * made + size_t(i)];
      const int64_t last = i < triVertices ? lastTriVertex() : int64_t(cut_.triangleCount) - 1;
      if (i < all ? parent < 0 || parent > last : parent != -1) return false;
    }
    return true;
  }

  bool checkFaces() {
    const size_t faces = cut_.faceCount(), loops = cut_.loopOffsets.empty() ? 0 : cut_.loopOffsets.size() - 1;
    if (!expect(cut_.faceAxis.size() == faces && cut_.facePlane.size() == faces && faces < size_t(1) << 31, "array", 0,
                "of the faces has a wrong length"))
      return false;
    if (!expectOffsets(cut_.loopOffsets, loops, cut_.loopVertices.size(), "loop", "has wrong offsets")) return false;
    if (!expectOffsets(cut_.faceLoopOffsets, faces, loops, "face", "has wrong offsets")) return false;
    if (!expectRange(cut_.loopVertices, {0, int64_t(cut_.vertexCount()) - 1}, "entry",
                     "of loopVertices names a vertex that does not exist"))
      return false;
    if (!expectRange(cut_.faceTriangle, {-1, int64_t(cut_.triangleCount) - 1}, "face", "names a triangle that does not exist"))
      return false;
    if (!expectRange(cut_.faceAxis, {-1, 2}, "face", "has a wrong axis")) return false;
    for (size_t f = 0; f < faces; ++f) {
      const int axis = cut_.faceAxis[f];
      const bool plane = axis < 0 ? cut_.facePlane[f] == 0 : cut_.facePlane[f] >= 0 && cut_.facePlane[f] <= cut_.grid.cells(axis);
      if (!expect(plane, "face", int64_t(f), "has a wrong plane")) return false;
      if (!expect(axis >= 0 || cut_.faceTriangle[f] >= 0, "face", int64_t(f), "is no part of a triangle and lies in no axial plane"))
        return false;
      const uint32_t first = cut_.faceLoopOffsets[f], last = cut_.faceLoopOffsets[f + 1];
      if (!expect(first < last && cut_.loop(first).size() >= 3, "face", int64_t(f), "has no outer loop of three vertices")) return false;
      for (uint32_t l = first; l < last; ++l) {
        if (!expect(isLoop(cut_.loop(l)), "face", int64_t(f), "has a loop of one vertex, or one where a vertex follows itself"))
          return false;
      }
    }
    return true;
  }
  static bool isLoop(std::span<const uint32_t> loop) {
    for (size_t i = 0; i < loop.size(); ++i) {
      if (loop[i] == loop[(i + 1) % loop.size()]) return false;
    }
    return !loop.empty();
  }

  bool checkFaceParents() {
    const size_t parents = cut_.faceParents.size();
    if (!expect(cut_.faceParentSigns.size() == parents, "array", 0, "of the faces' parents has a wrong length")) return false;
    if (!expectOffsets(cut_.faceParentOffsets, cut_.faceCount(), parents, "face", "has wrong offsets of its parents")) return false;
    if (!expectRange(cut_.faceParents, {0, int64_t(cut_.triangleCount) - 1}, "entry",
                     "of faceParents names a triangle that does not exist"))
      return false;
    for (size_t f = 0; f < cut_.faceCount(); ++f) {
      const uint32_t first = cut_.faceParentOffsets[f], last = cut_.faceParentOffsets[f + 1];
      bool ascending = true, signs = true;
      for (uint32_t i = first; i < last; ++i) {
        ascending &= i == first || cut_.faceParents[i - 1] < cut_.faceParents[i];
        signs &= cut_.faceParentSigns[i] == 1 || cut_.faceParentSigns[i] == -1;
      }
      if (!expect(ascending, "face", int64_t(f), "has parents that do not ascend")) return false;
      if (!expect(signs, "face", int64_t(f), "has a parent whose sign is neither 1 nor -1")) return false;
      const bool lowest = first == last ? cut_.faceTriangle[f] == -1
                                        : cut_.faceTriangle[f] == int64_t(cut_.faceParents[first]) && cut_.faceParentSigns[first] == 1;
      if (!expect(lowest, "face", int64_t(f), "does not name its lowest parent, with the sign 1, as its triangle")) return false;
    }
    return true;
  }

  bool checkCells() {
    const size_t cells = cut_.cellCount();
    if (!expect(cut_.cellGridCell.size() == 3 * cells && cells < size_t(1) << 31, "array", 0, "of the cells has a wrong length"))
      return false;
    if (!expectOffsets(cut_.cellHalfFaceOffsets, cells, cut_.cellHalfFaces.size(), "cell", "has wrong offsets")) return false;
    if (!expectRange(cut_.cellHalfFaces, {0, 2 * int64_t(cut_.faceCount()) - 1}, "entry",
                     "of cellHalfFaces names a half-face that does not exist"))
      return false;
    if (!expectRange(cut_.cellRegion, {0, int64_t(cut_.regionCount) - 1}, "cell", "names a region that does not exist")) return false;
    for (size_t c = 0; c < cells; ++c) {
      if (!expect(!cut_.halfFaces(c).empty(), "cell", int64_t(c), "has no faces")) return false;
    }
    for (size_t i = 0; i < 3 * cells; ++i) {
      const int32_t c = cut_.cellGridCell[i];
      if (!expect(c >= 0 && c < cut_.grid.cells(int(i % 3)), "cell", int64_t(i / 3), "lies in no grid cell")) return false;
    }
    return true;
  }

  bool checkRuns() {
    const size_t runs = cut_.runBegin.size(), rows = size_t(cut_.grid.cells(1) * cut_.grid.cells(2));
    if (!expect(cut_.runEnd.size() == runs && cut_.runRegion.size() == runs, "array", 0, "of the runs has a wrong length")) return false;
    if (!expectOffsets(cut_.rowRunOffsets, rows, runs, "row", "has wrong offsets")) return false;
    if (!expectRange(cut_.runRegion, {0, int64_t(cut_.regionCount) - 1}, "run", "names a region that does not exist")) return false;
    for (size_t row = 0; row < rows; ++row) {
      int32_t end = 0;
      for (uint32_t r = cut_.rowRunOffsets[row]; r < cut_.rowRunOffsets[row + 1]; ++r) {
        const bool fine = cut_.runBegin[r] >= end && cut_.runEnd[r] > cut_.runBegin[r] && cut_.runEnd[r] <= cut_.grid.cells(0);
        if (!expect(fine, "run", r, "is empty, out of order or leaves the grid")) return false;
        end = cut_.runEnd[r];
      }
    }
    return true;
  }

  bool checkRest() {
    if (!expect(cut_.regionWinding.size() == (cut_.hasWinding ? cut_.regionCount : 0), "array", 0,
                "of the regions' winding numbers has a wrong length"))
      return false;
    return checkParts() && checkTriangles(cut_.droppedTriangles, "is dropped but does not exist or is out of order") &&
           checkTriangles(cut_.parityTriangles, "is among those with parity but does not exist or is out of order") &&
           checkTriangles(cut_.openTriangles, "is among the open ones but does not exist or is out of order");
  }

  /// What there is instead of winding numbers.
  bool checkParts() {
    const auto expectPerRegion = [&](const auto& array, const char* message) {
      const bool mayBe = array.size() == cut_.regionCount && !cut_.hasWinding;
      return expect(array.empty() || mayBe, "array", 0, message);
    };
    if (!expectPerRegion(cut_.regionPartWinding, "of the parts' winding numbers has a wrong length")) return false;
    if (!expectPerRegion(cut_.regionParity, "of the regions' parity has a wrong length")) return false;
    if (!expectPerRegion(cut_.regionInsideness, "of the regions' insideness has a wrong length")) return false;
    if (!expectRange(cut_.regionParity, {0, 1}, "region", "has a parity that is neither 0 nor 1")) return false;
    for (size_t r = 0; r < cut_.regionInsideness.size(); ++r) {
      if (!expect(std::isfinite(cut_.regionInsideness[r]), "region", int64_t(r), "has an insideness that is not finite")) return false;
    }
    return true;
  }

  bool checkTriangles(const std::vector<uint32_t>& triangles, const char* message) {
    for (size_t i = 0; i < triangles.size(); ++i) {
      const bool fine = triangles[i] < cut_.triangleCount && (i == 0 || triangles[i - 1] < triangles[i]);
      if (!expect(fine, "triangle", triangles[i], message)) return false;
    }
    return true;
  }

  const CutMesh& cut_;
  const MeshView* mesh_;  // may be null
  Tally tally_{"arrays"};
};

}  // namespace
}  // namespace mandoline::validation

mandoline::Check mandoline::checkArrays(const CutMesh& cutMesh, const MeshView* mesh) {
  return validation::ArrayCheck(cutMesh, mesh).run();
}
