#include "operators/slice/face_cutter.h"

#include <algorithm>

namespace mandoline::operators {

FaceCutter::FaceCutter(const CutMesh& cutMesh, const ScaledSpace& space)
    : cutMesh_(cutMesh), space_(space), triangulator_(cutMesh), side_(cutMesh.vertexCount(), 0) {}

CutFaces& FaceCutter::run(const CuttingPlane& plane, std::span<const uint32_t> cells) {
  plane_ = &plane;
  ++round_;
  result_.faces.clear();
  result_.segments.clear();
  ends_.clear();
  findCutFaces(cells);
  gatherFaces(cells);
  for (CutFace& face : result_.faces) cut(face);
  numberPoints();
  return result_;
}

/// Fills in the cells' half-faces, still by the cut-mesh's ids.
void FaceCutter::findCutFaces(std::span<const uint32_t> cells) {
  detail::Csr<uint32_t>& found = result_.cellFaces;
  found.offsets.assign(1, 0);
  found.items.clear();
  for (const uint32_t c : cells) {
    for (const uint32_t h : cutMesh_.halfFaces(c)) {
      if (isCut(h / 2)) found.items.push_back(h);
    }
    found.offsets.push_back(uint32_t(found.items.size()));
  }
}

/// Makes faces of the half-faces.
void FaceCutter::gatherFaces(std::span<const uint32_t> cells) {
  std::vector<uint32_t>& found = result_.cellFaces.items;
  halfFaces_.clear();
  cells_.clear();
  for (size_t c = 0; c < cells.size(); ++c) cells_.insert(cells_.end(), result_.cellFaces[c].size(), cells[c]);
  for (uint32_t i = 0; i < found.size(); ++i) halfFaces_.push_back({found[i] / 2, i});
  detail::sortByKey(halfFaces_, cutMesh_.faceCount());
  for (const detail::KeyedItem& entry : halfFaces_) {
    if (result_.faces.empty() || result_.faces.back().face != entry.key)
      result_.faces.push_back({uint32_t(entry.key), 0, 0, {CutFace::kNone, CutFace::kNone}});
    const uint32_t side = found[entry.item] % 2;
    result_.faces.back().cells[side] = cells_[entry.item];
    found[entry.item] = 2 * (uint32_t(result_.faces.size()) - 1) + side;
  }
}

void FaceCutter::findSide(uint32_t vertex) {
  side_[vertex] = 2 * round_ + (plane_->isAbove(space_.scaled(&cutMesh_.positions[3 * size_t(vertex)])) ? 1 : 0);
}

bool FaceCutter::isCut(uint32_t face) {
  const std::span<const uint32_t> outline = cutMesh_.loop(cutMesh_.faceLoopOffsets[face]);
  const bool first = isAbove(outline[0]);
  return std::any_of(outline.begin() + 1, outline.end(), [&](uint32_t v) { return isAbove(v) != first; });
}

void FaceCutter::cut(CutFace& face) {
  triangles_.clear();
  triangulator_.run(face.face, triangles_);
  face.firstSegment = uint32_t(result_.segments.size());
  for (size_t t = 0; t < triangles_.size(); t += 3) addTriangle(&triangles_[t]);
  face.endSegment = uint32_t(result_.segments.size());
}

void FaceCutter::addTriangle(const uint32_t* vertices) {
  const std::array<bool, 3> above = {isAbove(vertices[0]), isAbove(vertices[1]), isAbove(vertices[2])};
  if (above[0] == above[1] && above[1] == above[2]) return;
  const uint32_t id = uint32_t(result_.segments.size());
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t a = vertices[i], b = vertices[(i + 1) % 3];
    if (above[i] == above[(i + 1) % 3]) continue;
    ends_.push_back({uint64_t(std::min(a, b)) * side_.size() + std::max(a, b), 2 * id + (above[i] ? 0 : 1)});
  }
  result_.segments.emplace_back();
}

/// One point per edge, in the order of the edges' vertices.
void FaceCutter::numberPoints() {
  const uint64_t vertices = side_.size();
  detail::sortByKey(ends_, vertices * vertices);
  result_.pointEdges.clear();
  for (size_t i = 0; i < ends_.size(); ++i) {
    if (i == 0 || ends_[i].key != ends_[i - 1].key)
      result_.pointEdges.push_back({uint32_t(ends_[i].key / vertices), uint32_t(ends_[i].key % vertices)});
    result_.segments[ends_[i].item / 2][ends_[i].item % 2] = uint32_t(result_.pointEdges.size() - 1);
  }
}

}  // namespace mandoline::operators
