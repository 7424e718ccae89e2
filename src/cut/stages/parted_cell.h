// A grid cell that one sheet of the surface parts in two, as nearly all are: one cut-cell lies behind it, one in front. There nothing has
// to be joined edge by edge. Tri-cut-faces are one sheet if their tri-edges connect them; a hybrid edge has the piece of its grid-face that
// lies in front of the sheet on its left, since so it leaves the dicer; and a grid-face without any lies where its corners do.
//
// Hybrid edges are closed curves around the cell, each of one sheet: two of them that follow each other have a tri-cut-face in common, or
// two that meet at a tri-edge. Nearly always there is one curve. Then all tri-cut-faces at it are one sheet, and so are triangles inside of
// the cell that are connected to these: see InnerTriangles.
#pragma once

#include <array>
#include <vector>

#include "base/stamped_table.h"
#include "cut/stages/cut_faces.h"

namespace mandoline::detail {

class PartedCell {
 public:
  enum Side : uint8_t { unknown = 0, behind = 1, inFront = 2 };

  /// Begins with the cells of a brick.
  void begin(const BrickSurface& surface, const Stencil& stencil);

  /// Finds the side of each piece of the cell's grid-faces. False, without sides to use, unless it is one sheet of few faces that parts the
  /// cell, none of them special, and no tri-edge lies in its grid-faces. Special are faces of divided triangles and of those with stitched
  /// sides; faces that have a whole tri-edge, of triangles one of whose tri-edges is not of two; triangles inside of the cell that are not
  /// connected to others; and faces with a vertex on more planes than its kind needs: none for those of the mesh, one on tri-edges, two in
  /// triangles.
  bool find(const BrickSurface& surface, const Stencil& stencil, const GridFaces& grid, GridCellId cell);

  /// By the cell's grid-faces, then as GridFaces has their half-faces.
  std::span<const uint8_t> sides() const { return {sides_.data(), pieceCount_}; }
  /// Of a piece: among all half-faces of GridFaces, and on which side of the cell its grid-face is.
  struct Place {
    uint32_t halfFace;
    int side;
  };
  std::span<const Place> places() const { return {places_.data(), pieceCount_}; }

 private:
  static constexpr uint32_t kBoth = ~0u;
  static constexpr size_t kMostFaces = size_t(1) << 16, kMostPieces = 64;
  /// That have been found so far.
  struct Sides {
    std::array<uint8_t, kMostPieces> ofPieces;
    std::array<uint8_t, 8> atCorners;
  };

  bool isOneSheet(const BrickSurface& surface, std::span<const FaceId> faces);
  bool findSides(const Stencil& stencil, const GridFaces& grid, GridCellId cell);
  static bool findSidesOfWhole(std::span<const std::array<uint8_t, 2>> wholeFaces, Sides& found);

  bool canTell_ = false;
  IdVector<GridCellId, uint8_t> isSpecial_;
  /// Where two tri-cut-faces are connected: an end of a piece of a tri-edge on a grid-face, or a whole tri-edge inside of the cell. Each
  /// with the face that has come so far, or kBoth.
  StampedTable joints_;
  std::vector<uint32_t> sheets_;  // per tri-cut-face of the cell: one before it in its sheet, or itself
  bool isOneCurve_ = false;       // whether it is known that there is one curve
  std::array<uint8_t, kMostPieces> sides_;
  std::array<Place, kMostPieces> places_;
  uint32_t pieceCount_ = 0;
};

}  // namespace mandoline::detail
