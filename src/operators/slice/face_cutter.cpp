#include "operators/slice/face_cutter.h"

#include <algorithm>

namespace mandoline::operators {

FaceCutter::FaceCutter(const CutMesh& cutMesh, const PlanarCuts& cuts)
    : cutMesh_(cutMesh),
      cuts_(cuts),
      triangulator_(cutMesh.positions),
      planesBelow_(cutMesh.vertexCount(), kUnknown),
      cutsOf_(cutMesh.faceCount()) {
  // If most are asked for, it costs least to go through all of them in the order of their arrays.
  if (cuts.cells.items.size() > cutMesh.cellCount() / 2) {
    for (uint32_t v = 0; v < planesBelow_.size(); ++v) findPlanesBelow(v);
    for (size_t f = 0; f < cutsOf_.size(); ++f) findCuts(f);
  }
}

void FaceCutter::findPlanesBelow(uint32_t vertex) {
  planesBelow_[vertex] = cuts_.planes.countBelow(cuts_.space.scaled(&cutMesh_.positions[3 * size_t(vertex)]));
}

void FaceCutter::findCuts(size_t face) {
  PlaneRange cuts = {~0u, 0};
  for (const uint32_t v : cutMesh_.loop(cutMesh_.faceLoopOffsets[face])) {
    const uint32_t below = planesBelow(v);
    cuts = {std::min(cuts.first, below), std::max(cuts.end, below)};
  }
  cutsOf_[face] = cuts;
}

CutFaces& FaceCutter::run(uint32_t plane) {
  plane_ = plane;
  const std::span<const uint32_t> cells = cuts_.cells[plane];
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

void FaceCutter::cut(CutFace& face) {
  face.firstSegment = uint32_t(result_.segments.size());
  const Loops loops = cutMesh_.loops(face.face);
  if (loops.size() == 1 && loops[0].size() == 3) {
    addTriangle(loops[0].data());
  } else {
    triangles_.clear();
    triangulator_.run(cutMesh_.face(face.face), triangles_);
    for (size_t t = 0; t < triangles_.size(); t += 3) addTriangle(&triangles_[t]);
  }
  face.endSegment = uint32_t(result_.segments.size());
}

void FaceCutter::addTriangle(const uint32_t* vertices) {
  const std::array<bool, 3> above = {isAbove(vertices[0]), isAbove(vertices[1]), isAbove(vertices[2])};
  if (above[0] == above[1] && above[1] == above[2]) return;
  const uint32_t id = uint32_t(result_.segments.size());
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t a = vertices[i], b = vertices[(i + 1) % 3];
    if (above[i] == above[(i + 1) % 3]) continue;
    ends_.push_back({uint64_t(std::min(a, b)) * planesBelow_.size() + std::max(a, b), 2 * id + (above[i] ? 0 : 1)});
  }
  result_.segments.emplace_back();
}

/// One point per edge, in the order of the edges' vertices.
void FaceCutter::numberPoints() {
  const uint64_t vertices = planesBelow_.size();
  detail::sortByKey(ends_, vertices * vertices);
  result_.pointEdges.clear();
  for (size_t i = 0; i < ends_.size(); ++i) {
    if (i == 0 || ends_[i].key != ends_[i - 1].key)
      result_.pointEdges.push_back({uint32_t(ends_[i].key / vertices), uint32_t(ends_[i].key % vertices)});
    result_.segments[ends_[i].item / 2][ends_[i].item % 2] = uint32_t(result_.pointEdges.size() - 1);
  }
}

}  // namespace mandoline::operators
