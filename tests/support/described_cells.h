// What a cut-mesh says of each grid cell, in words that do not depend on its numbers: to compare one with the pieces of another.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "mandoline/for_each_brick.h"

using CellDescriptions = std::map<std::array<int64_t, 3>, std::vector<std::string>>;

/// Describes a cut-mesh. Of a piece, ids become those of the whole mesh, and grid cells and planes those of the whole grid.
class CellDescriber {
 public:
  explicit CellDescriber(const mandoline::CutMesh& cutMesh) : cut_(cutMesh), first_{} {}
  explicit CellDescriber(const mandoline::CutPiece& piece) : cut_(piece.cutMesh), first_(piece.first), piece_(&piece) {}

  /// Adds the cells of each grid cell: cut-cells by all that is known of them, to the bit, or one that is untouched.
  void describe(CellDescriptions& all) {
    describeVertices();
    std::vector<std::string> faces;
    for (size_t f = 0; f < cut_.faceCount(); ++f) faces.push_back(faceText(f));
    for (size_t c = 0; c < cut_.cellCount(); ++c) {
      std::vector<std::string> sides;
      for (const uint32_t h : cut_.halfFaces(c)) sides.push_back((h % 2 != 0 ? "+" : "-") + faces[h / 2]);
      const int32_t* g = &cut_.cellGridCell[3 * c];
      all[{first_[0] + g[0], first_[1] + g[1], first_[2] + g[2]}].push_back(joined(sides) + regionText(cut_.cellRegion[c]));
    }
    mandoline::UntouchedCells(cut_).forEach([&](const mandoline::UntouchedCells::Run& run) {
      for (int32_t i = run.begin; i < run.end; ++i)
        all[{first_[0] + i, first_[1] + run.j, first_[2] + run.k}].push_back("untouched" + regionText(run.region));
    });
  }

 private:
  template <class Number>
  static std::string bytes(const Number* numbers, size_t count) {
    return std::string(reinterpret_cast<const char*>(numbers), count * sizeof(Number));
  }
  static std::string text(int64_t number) { return std::to_string(number) + ' '; }
  static std::string joined(std::vector<std::string>& texts) {
    std::sort(texts.begin(), texts.end());
    std::string all;
    for (const std::string& one : texts) all += one + '\n';
    return all;
  }

  int64_t triangle(int64_t t) const { return t < 0 || !piece_ ? t : int64_t(piece_->triangles[size_t(t)]); }
  int64_t triVertex(int64_t v) const { return v < 0 || !piece_ ? v : int64_t(piece_->triVertices[size_t(v)]); }

  void describeVertices() {
    std::vector<std::string> made(cut_.vertexCount());
    for (size_t i = 0; i < cut_.madeVertices.size(); ++i) made[cut_.madeVertices[i]] = madeText(i);
    for (size_t v = 0; v < cut_.vertexCount(); ++v) {
      std::string vertex = bytes(&cut_.positions[3 * v], 3) + text(cut_.vertexMask[v]) + text(triVertex(cut_.vertexTriVertex[v]));
      for (size_t d = 0; d < 3; ++d) vertex += text(first_[d] + cut_.vertexCell[3 * v + d]);
      const int32_t a = cut_.vertexParents[2 * v], b = cut_.vertexParents[2 * v + 1];
      vertices_.push_back(vertex + (b < 0 ? text(triangle(a)) : text(triVertex(a)) + text(triVertex(b))) + made[v]);
    }
  }

  std::string madeText(size_t i) const {
    using mandoline::MadeVertex;
    const auto kind = MadeVertex(cut_.madeVertexKinds[i]);
    const int ofVertices = kind == MadeVertex::edgeTriangle ? 2 : kind == MadeVertex::edgeEdge ? 4 : 0;
    std::string made = text(int64_t(kind));
    for (int k = 0; k < 4; ++k) {
      const int32_t parent = cut_.madeVertexParents[4 * i + size_t(k)];
      made += text(k < ofVertices ? triVertex(parent) : triangle(parent));
    }
    return made;
  }

  std::string loopText(std::span<const uint32_t> loop) const {
    std::string least;
    for (size_t from = 0; from < loop.size(); ++from) {
      std::string turned;
      for (size_t i = 0; i < loop.size(); ++i) turned += vertices_[loop[(from + i) % loop.size()]] + ',';
      if (from == 0 || turned < least) least = turned;
    }
    return least;
  }

  std::string faceText(size_t f) const {
    const int32_t axis = cut_.faceAxis[f];
    std::string face = text(triangle(cut_.faceTriangle[f])) + text(axis);
    if (axis >= 0) face += text(first_[size_t(axis)] + cut_.facePlane[f]);
    for (uint32_t i = cut_.faceParentOffsets[f]; i < cut_.faceParentOffsets[f + 1]; ++i)
      face += text(triangle(cut_.faceParents[i])) + text(cut_.faceParentSigns[i]);
    const mandoline::Loops loops = cut_.loops(f);
    std::vector<std::string> holes;
    for (size_t l = 1; l < loops.size(); ++l) holes.push_back(loopText(loops[l]));
    return face + loopText(loops[0]) + joined(holes);
  }

  std::string regionText(uint32_t r) const {
    std::string region;
    if (cut_.hasWinding) region += "winding " + text(cut_.regionWinding[r]);
    if (!cut_.regionPartWinding.empty()) region += "of parts " + text(cut_.regionPartWinding[r]);
    if (!cut_.regionParity.empty()) region += "parity " + text(cut_.regionParity[r]);
    return region;
  }

  const mandoline::CutMesh& cut_;
  const std::array<int64_t, 3> first_;
  const mandoline::CutPiece* piece_ = nullptr;
  std::vector<std::string> vertices_;
};

inline CellDescriptions describedCells(const mandoline::CutMesh& cutMesh) {
  CellDescriptions cells;
  CellDescriber(cutMesh).describe(cells);
  for (auto& [gridCell, texts] : cells) std::sort(texts.begin(), texts.end());
  return cells;
}

/// Of all pieces together.
inline CellDescriptions describedCells(const mandoline::PreparedMesh& mesh, const mandoline::Grid& grid,
                                       const mandoline::ForEachBrickOptions& options) {
  CellDescriptions cells;
  mandoline::forEachBrick(
      mesh, grid, [&](const mandoline::CutPiece& piece) { CellDescriber(piece).describe(cells); }, options);
  for (auto& [gridCell, texts] : cells) std::sort(texts.begin(), texts.end());
  return cells;
}
