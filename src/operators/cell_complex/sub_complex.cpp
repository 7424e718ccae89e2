#include <algorithm>
#include <string>

#include "mandoline/cell_complex.h"
#include "mesh/fingerprints.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

/// Appends the `stride` items that each of the elements has.
template <class Item>
void take(const std::vector<Item>& from, const std::vector<uint32_t>& elements, size_t stride, std::vector<Item>& to) {
  to.reserve(elements.size() * stride);
  for (const size_t e : elements) {
    for (size_t i = stride * e; i < stride * (e + 1); ++i) to.push_back(from[i]);
  }
}

/// The groups of the elements, if there are any groups.
void takeGroups(const std::vector<uint32_t>& offsets, const std::vector<uint32_t>& items, const std::vector<uint32_t>& elements,
                std::vector<uint32_t>& toOffsets, std::vector<uint32_t>& toItems) {
  if (offsets.empty()) return;
  toOffsets = {0};
  for (const uint32_t e : elements) {
    toItems.insert(toItems.end(), items.begin() + offsets[e], items.begin() + offsets[e + 1]);
    toOffsets.push_back(uint32_t(toItems.size()));
  }
}

uint32_t countBelow(const std::vector<uint32_t>& ascending, uint32_t limit) {
  return uint32_t(std::lower_bound(ascending.begin(), ascending.end(), limit) - ascending.begin());
}

class Extractor {
 public:
  Extractor(const CellComplex& whole, std::vector<uint32_t> cells) : whole_(whole) { sub_.wholeCell = std::move(cells); }

  SubComplex run() {
    takeCells();
    takeFaces();
    takeVertices();
    CellComplex& result = sub_.cells;
    result.cutVertices = countBelow(sub_.wholeVertex, whole_.cutVertices);
    result.cutFaces = countBelow(sub_.wholeFace, whole_.cutFaces);
    result.cutCells = countBelow(sub_.wholeCell, whole_.cutCells);
    detail::Fingerprinter fingerprinter("part", whole_.fingerprint);
    fingerprinter.add(sub_.wholeCell);
    result.madeFrom = whole_.fingerprint;
    result.fingerprint = fingerprinter.get();
    return std::move(sub_);
  }

 private:
  void takeCells() {
    for (const uint32_t c : sub_.wholeCell) {
      for (const uint32_t h : whole_.halfFaces(c)) sub_.wholeFace.push_back(h / 2);
    }
    keepEachOnce(sub_.wholeFace);
    CellComplex& to = sub_.cells;
    take(whole_.cellCorner, sub_.wholeCell, 3, to.cellCorner);
    take(whole_.cellLevel, sub_.wholeCell, 1, to.cellLevel);
    take(whole_.cellCentre, sub_.wholeCell, 3, to.cellCentre);
    take(whole_.cellRegion, sub_.wholeCell, 1, to.cellRegion);
    take(whole_.cellVolume, sub_.wholeCell, 1, to.cellVolume);
    take(whole_.cellCentroid, sub_.wholeCell, 3, to.cellCentroid);
    takeGroups(whole_.cellMemberOffsets, whole_.cellMembers, sub_.wholeCell, to.cellMemberOffsets, to.cellMembers);
  }

  void takeFaces() {
    CellComplex& to = sub_.cells;
    take(whole_.faceTag, sub_.wholeFace, 1, to.faceTag);
    take(whole_.faceArea, sub_.wholeFace, 1, to.faceArea);
    take(whole_.faceNormal, sub_.wholeFace, 3, to.faceNormal);
    take(whole_.faceCentroid, sub_.wholeFace, 3, to.faceCentroid);
    takeGroups(whole_.faceMemberOffsets, whole_.faceMembers, sub_.wholeFace, to.faceMemberOffsets, to.faceMembers);
    to.faceCells.assign(2 * sub_.wholeFace.size(), -1);
    to.cellHalfFaceOffsets = {0};
    for (size_t c = 0; c < sub_.wholeCell.size(); ++c) {
      for (const uint32_t h : whole_.halfFaces(sub_.wholeCell[c])) {
        const uint32_t half = 2 * countBelow(sub_.wholeFace, h / 2) + h % 2;
        to.faceCells[half] = int32_t(c);
        to.cellHalfFaces.push_back(half);
      }
      to.cellHalfFaceOffsets.push_back(uint32_t(to.cellHalfFaces.size()));
    }
  }

  void takeVertices() {
    CellComplex& to = sub_.cells;
    to.loopOffsets = to.faceLoopOffsets = {0};
    for (const uint32_t f : sub_.wholeFace) {
      for (const auto loop : whole_.loops(f)) {
        to.loopVertices.insert(to.loopVertices.end(), loop.begin(), loop.end());
        to.loopOffsets.push_back(uint32_t(to.loopVertices.size()));
      }
      to.faceLoopOffsets.push_back(uint32_t(to.loopOffsets.size()) - 1);
    }
    sub_.wholeVertex = to.loopVertices;
    keepEachOnce(sub_.wholeVertex);
    std::vector<uint32_t> subVertex(whole_.vertexCount());
    for (size_t v = 0; v < sub_.wholeVertex.size(); ++v) subVertex[sub_.wholeVertex[v]] = uint32_t(v);
    for (uint32_t& v : to.loopVertices) v = subVertex[v];
    take(whole_.positions, sub_.wholeVertex, 3, to.positions);
  }

  static void keepEachOnce(std::vector<uint32_t>& ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  }

  const CellComplex& whole_;
  SubComplex sub_;
};

}  // namespace

SubComplex subComplex(const CellComplex& whole, std::span<const uint32_t> cellIds) {
  std::vector<uint32_t> cells(cellIds.begin(), cellIds.end());
  std::sort(cells.begin(), cells.end());
  const auto twice = std::adjacent_find(cells.begin(), cells.end());
  if (twice != cells.end()) operators::refuse("Cell " + std::to_string(*twice) + " is named twice.", *twice);
  if (!cells.empty() && cells.back() >= whole.cellCount())
    operators::refuse("There is no cell " + std::to_string(cells.back()) + ".", cells.back());
  return Extractor(whole, std::move(cells)).run();
}

SubComplex regionComplex(const CellComplex& whole, uint32_t region) {
  std::vector<uint32_t> cells;
  for (uint32_t c = 0; c < whole.cellCount(); ++c) {
    if (whole.cellRegion[c] == region) cells.push_back(c);
  }
  if (cells.empty()) operators::refuse("There is no region " + std::to_string(region) + ".", region);
  return Extractor(whole, std::move(cells)).run();
}

}  // namespace mandoline
