// The arrays of a cell complex: lengths, offsets, id ranges, and that faces and cells name each other.
#include <algorithm>
#include <cmath>

#include "operators/validate/tally.h"

namespace mandoline::validation {
namespace {

constexpr int kMostLevel = 24;

class ComplexArrayCheck {
 public:
  explicit ComplexArrayCheck(const CellComplex& cells) : cells_(cells) {}

  Check run() {
    // Later steps index with what earlier ones have checked.
    checkLengths() && checkOffsets() && checkLoops() && checkFaces() && checkCells() && checkMembers() && checkNumbers();
    return tally_.finish();
  }

 private:
  bool expect(bool holds, const char* kind, size_t element, const char* text) {
    if (!holds) tally_.violate(kind, int64_t(element), text);
    return holds;
  }

  bool checkLengths() {
    const size_t vertices = cells_.vertexCount(), faces = cells_.faceCount(), cells = cells_.cellCount();
    const size_t most = size_t(1) << 30;
    const bool vertexArrays = cells_.positions.size() == 3 * vertices && vertices < most;
    const bool faceArrays = cells_.faceCells.size() == 2 * faces && cells_.faceArea.size() == faces &&
                            cells_.faceNormal.size() == 3 * faces && cells_.faceCentroid.size() == 3 * faces && faces < most;
    const bool cellArrays = cells_.cellCorner.size() == 3 * cells && cells_.cellLevel.size() == cells &&
                            cells_.cellCentre.size() == 3 * cells && cells_.cellVolume.size() == cells &&
                            cells_.cellCentroid.size() == 3 * cells && cells < most;
    const bool counts = cells_.cutVertices <= vertices && cells_.cutFaces <= faces && cells_.cutCells <= cells;
    return expect(vertexArrays, "array", 0, "of the vertices has a wrong length") &&
           expect(faceArrays, "array", 0, "of the faces has a wrong length") &&
           expect(cellArrays, "array", 0, "of the cells has a wrong length") &&
           expect(counts, "array", 0, "has fewer items than are said to be the cut-mesh's");
  }

  bool expectOffsets(const std::vector<uint32_t>& offsets, size_t items, size_t end, const char* kind) {
    const char* text = "has wrong offsets";
    if (offsets.size() != items + 1 || offsets.front() != 0 || offsets.back() != end) return expect(false, kind, offsets.size(), text);
    for (size_t i = 0; i < items; ++i) {
      if (offsets[i] > offsets[i + 1]) return expect(false, kind, i, text);
    }
    return true;
  }
  bool checkOffsets() {
    const size_t loops = cells_.loopOffsets.empty() ? 0 : cells_.loopOffsets.size() - 1;
    return expectOffsets(cells_.loopOffsets, loops, cells_.loopVertices.size(), "loop") &&
           expectOffsets(cells_.faceLoopOffsets, cells_.faceCount(), loops, "face") &&
           expectOffsets(cells_.cellHalfFaceOffsets, cells_.cellCount(), cells_.cellHalfFaces.size(), "cell");
  }

  bool checkLoops() {
    for (size_t i = 0; i < cells_.loopVertices.size(); ++i) {
      if (!expect(cells_.loopVertices[i] < cells_.vertexCount(), "entry", i, "of loopVertices names a vertex that does not exist"))
        return false;
    }
    for (size_t f = 0; f < cells_.faceCount(); ++f) {
      const Loops loops = cells_.loops(f);
      if (!expect(loops.size() > 0 && loops[0].size() >= 3, "face", f, "has no outer loop of three vertices")) return false;
      for (const auto loop : loops) {
        if (!expect(isLoop(loop), "face", f, "has a loop of one vertex, or one where a vertex follows itself")) return false;
      }
    }
    return true;
  }
  static bool isLoop(std::span<const uint32_t> loop) {
    for (size_t i = 0; i < loop.size(); ++i) {
      if (loop[i] == loop[i + 1 < loop.size() ? i + 1 : 0]) return false;
    }
    return !loop.empty();
  }

  bool checkFaces() {
    for (size_t f = 0; f < cells_.faceCount(); ++f) {
      const int32_t front = cells_.faceCells[2 * f], back = cells_.faceCells[2 * f + 1];
      const auto exists = [&](int32_t cell) { return cell >= -1 && cell < int64_t(cells_.cellCount()); };
      if (!expect(exists(front) && exists(back), "face", f, "names a cell that does not exist")) return false;
      if (!expect(cells_.faceTag[f] <= FaceTag::surface, "face", f, "has a tag that there is not")) return false;
      if (!expect(front != back || cells_.faceTag[f] != FaceTag::inner, "face", f, "is inner, and has nothing or one cell on both sides"))
        return false;
    }
    return true;
  }

  /// Every half-face of a cell is in its list, and no other is.
  bool checkCells() {
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      const auto halfFaces = cells_.halfFaces(c);
      if (!expect(!halfFaces.empty(), "cell", c, "has no faces")) return false;
      for (size_t i = 0; i < halfFaces.size(); ++i) {
        const uint32_t h = halfFaces[i];
        const bool fits = h < cells_.faceCells.size() && cells_.faceCells[h] == int64_t(c) && (i == 0 || halfFaces[i - 1] < h);
        if (!expect(fits, "cell", c, "has a half-face that is not its own, or is out of order")) return false;
      }
      if (!expect(cells_.cellLevel[c] <= kMostLevel, "cell", c, "has a level that is too high")) return false;
      for (size_t i = 3 * c; i < 3 * c + 3; ++i) {
        if (!expect(cells_.cellCorner[i] >= 0 && cells_.cellCorner[i] <= 1 << kMostLevel, "cell", c, "lies in no grid cell")) return false;
      }
    }
    const auto listed = std::count_if(cells_.faceCells.begin(), cells_.faceCells.end(), [](int32_t cell) { return cell >= 0; });
    return expect(size_t(listed) == cells_.cellHalfFaces.size(), "array", 0, "of the cells' half-faces lacks some");
  }

  /// Each member of cells belongs to one cell, and no member of faces to two.
  bool checkMembers() {
    return checkMembers(cells_.cellMemberOffsets, cells_.cellMembers, cells_.cellCount(), "cell") &&
           checkMembers(cells_.faceMemberOffsets, cells_.faceMembers, cells_.faceCount(), "face");
  }
  bool checkMembers(const std::vector<uint32_t>& offsets, const std::vector<uint32_t>& members, size_t count, const char* kind) {
    if (offsets.empty() && members.empty()) return true;
    if (!expectOffsets(offsets, count, members.size(), kind)) return false;
    constexpr uint32_t kMost = 1u << 30;
    for (size_t i = 0; i < count; ++i) {
      if (!expect(offsets[i] < offsets[i + 1], kind, i, "has no members")) return false;
      for (size_t k = offsets[i]; k < offsets[i + 1]; ++k) {
        const bool isNext = k == offsets[i] || members[k - 1] < members[k];
        if (!expect(members[k] < kMost && isNext, kind, i, "has members that are too high or out of order")) return false;
      }
    }
    std::vector<uint32_t> sorted = members;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    return expect(twice == sorted.end(), "member", twice == sorted.end() ? 0 : *twice, "belongs to two elements");
  }

  bool expectFinite(const std::vector<double>& numbers, size_t perElement, const char* kind) {
    const auto bad = std::find_if(numbers.begin(), numbers.end(), [](double number) { return !std::isfinite(number); });
    return expect(bad == numbers.end(), kind, size_t(bad - numbers.begin()) / perElement, "has a number that is not finite");
  }
  bool checkNumbers() {
    return expectFinite(cells_.positions, 3, "vertex") && expectFinite(cells_.faceArea, 1, "face") &&
           expectFinite(cells_.faceNormal, 3, "face") && expectFinite(cells_.faceCentroid, 3, "face") &&
           expectFinite(cells_.cellCentre, 3, "cell") && expectFinite(cells_.cellVolume, 1, "cell") &&
           expectFinite(cells_.cellCentroid, 3, "cell");
  }

  const CellComplex& cells_;
  Tally tally_{"arrays"};
};

}  // namespace
}  // namespace mandoline::validation

namespace mandoline {

Check checkArrays(const CellComplex& cells) { return validation::ComplexArrayCheck(cells).run(); }

}  // namespace mandoline
