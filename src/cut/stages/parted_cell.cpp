#include "cut/stages/parted_cell.h"

#include <algorithm>
#include <utility>

#include "base/prefetch.h"

namespace mandoline::detail {

void PartedCell::begin(const BrickSurface& surface, const Stencil& stencil) {
  const Prepared& mesh = *surface.input.mesh;
  canTell_ = mesh.oriented && mesh.duplicates.empty();
  if (!canTell_) return;
  isSpecial_.assign(stencil.cells.size(), 0);
  const auto add = [&](const Slab& gridCell) {
    const auto cell = stencil.find(gridCell);
    if (cell) isSpecial_[*cell] = 1;
    return false;
  };
  for (const FaceId f : surface.specialFaces)
    add(surface.triFaces.elements[f]);  // beside a face in an axial plane, grid-faces have a graph
  for (size_t i = surface.firstTriEdge; i < surface.faceEdges.size(); ++i) findCellAround(surface.faceEdges[i].element, add);
}

bool PartedCell::find(const BrickSurface& surface, const Stencil& stencil, const GridFaces& grid, GridCellId cell) {
  const auto faces = stencil.triFacesInCell[cell];
  return canTell_ && !isSpecial_[cell] && faces.size() <= kMostFaces && findSides(stencil, grid, cell) &&
         (isOneCurve_ || isOneSheet(surface, faces));
}

/// Whether two faces meet at each tri-edge, and all are connected so. As none is special, each has one loop, of its own number, that begins
/// with its lowest vertex or is a whole triangle.
bool PartedCell::isOneSheet(const BrickSurface& surface, std::span<const FaceId> faces) {
  const VertexId firstOnEdge = surface.vertices.firstOnEdge, firstInTriangle = surface.vertices.firstInTriangle;
  const StampedTable::View joints = joints_.clear(8 * faces.size());  // a face has six ends of tri-edges at most
  if (sheets_.size() < faces.size()) sheets_.resize(faces.size());
  const Csr<VertexId>& loops = surface.triFaces.loops;
  for (const FaceId f : faces) prefetch(&loops.offsets[f.number]);
  for (const FaceId f : faces) prefetch(loops[f.number].data());
  uint32_t* const sheets = sheets_.data();
  size_t apart = faces.size(), open = 0;
  const auto sheetOf = [=](uint32_t face) {
    while (sheets[face] != face) face = sheets[face] = sheets[sheets[face]];
    return face;
  };
  for (uint32_t f = 0; f < faces.size(); ++f) {
    sheets[f] = f;
    const auto loop = loops[faces[f].number];
    VertexId u = loop.back();
    for (const VertexId v : loop) {
      const VertexId before = std::exchange(u, v);
      if (v >= firstInTriangle) continue;
      uint64_t key = v.number;
      if (v < firstOnEdge) {
        if (before >= firstOnEdge) continue;
        key = keyOf(before, v);
      }
      StampedTable::Slot& slot = joints.at(key);
      if (joints.isFree(slot)) {
        joints.put(slot, key, f);
        ++open;
        continue;
      }
      if (slot.number == kBoth) return false;
      const uint32_t a = sheetOf(slot.number), b = sheetOf(f);
      sheets[std::max(a, b)] = std::min(a, b);
      apart -= a != b;
      slot.number = kBoth;
      --open;
    }
  }
  return open == 0 && apart == 1;
}

/// Finds also whether there is one curve: if there are two, and none crosses a grid-edge twice, then each is in three grid-faces or more.
/// If these are all six, each curve parts one corner from the others, and both corners lie on the same side.
bool PartedCell::findSides(const Stencil& stencil, const GridFaces& grid, GridCellId cell) {
  const std::array<GridFaceId, 6> gridFaces = stencil.cells[cell].faces;
  Sides found{};
  std::array<std::array<uint8_t, 2>, 6> wholeFaces;
  size_t wholeCount = 0;
  uint32_t count = 0;
  bool partsCorners = true;
  for (size_t i = 0; i < 6; ++i) {
    const GridFaceId g = gridFaces[i];
    const GridFaceKind kind = grid.kinds[g];
    const uint32_t firstHalf = grid.halfFaces.offsets[g.number];
    if (kind == GridFaceKind::whole && count < kMostPieces) {
      places_[count] = {firstHalf, int(i & 1)};
      wholeFaces[wholeCount++] = {uint8_t(i), uint8_t(count++)};
      continue;
    }
    const uint32_t first = count;
    const auto edges = stencil.edgesOnFace[g];
    count += uint32_t(grid.halfFaces[g].size());
    if (kind != GridFaceKind::chains || count > kMostPieces) return false;
    for (uint32_t piece = first; piece < count; ++piece) places_[piece] = {firstHalf + piece - first, int(i & 1)};
    const uint32_t* const outline = grid.beside[g].data();
    const uint32_t* beside = outline + 5 + outline[4];
    for (const uint32_t* const past = beside + 2 * edges.size(); beside != past; beside += 2) {
      found.ofPieces[first + beside[0]] |= inFront;
      found.ofPieces[first + beside[1]] |= behind;
    }
    uint32_t piecesAtCorners = 0;  // a bit for each
    for (size_t c = 0; c < 4; ++c) {
      const uint32_t piece = outline[5 + outline[c]];
      piecesAtCorners |= 1u << (piece % 32);
      found.atCorners[kOutlines[i].corners[c]] |= found.ofPieces[first + piece];
    }
    partsCorners &= count == first + 2 && piecesAtCorners == 3;
  }
  if (!findSidesOfWhole({wholeFaces.data(), wholeCount}, found)) return false;
  const auto isFound = [](uint8_t side) { return side == behind || side == inFront; };
  sides_ = found.ofPieces;
  pieceCount_ = count;
  const auto cornersInFront = std::count(found.atCorners.begin(), found.atCorners.end(), uint8_t(inFront));
  isOneCurve_ = partsCorners && (wholeCount > 0 || cornersInFront == 4);
  return std::all_of(sides_.begin(), sides_.begin() + count, isFound) &&
         std::all_of(found.atCorners.begin(), found.atCorners.end(), isFound);
}

/// `wholeFaces`: the place of each in the cell, and that of its piece. They lie where grid-faces beside them do.
bool PartedCell::findSidesOfWhole(std::span<const std::array<uint8_t, 2>> wholeFaces, Sides& found) {
  for (size_t count = 0, before = 0; count < wholeFaces.size(); before = count) {
    count = 0;
    for (const auto& [face, piece] : wholeFaces) {
      const auto& [a, b, c, d] = kOutlines[face].corners;
      auto& corners = found.atCorners;
      const uint8_t side = corners[a] | corners[b] | corners[c] | corners[d];
      corners[a] = corners[b] = corners[c] = corners[d] = found.ofPieces[piece] = side;
      count += side != unknown;
    }
    if (count == before) return false;
  }
  return true;
}

}  // namespace mandoline::detail
