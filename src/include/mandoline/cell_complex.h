// One conforming mesh of all cells: the cut-cells and the grid or octree cells around them.
#pragma once

#include "mandoline/coarsen.h"
#include "mandoline/mesh.h"

namespace MANDOLINE_API mandoline {

/// What a face of a cell complex is part of: a side of the grid, or another thing.
enum class FaceTag : uint8_t {
  xMin,
  xMax,
  yMin,
  yMax,
  zMin,
  zMax,
  inner,   ///< none of these: a face between two cells, or one that a sub-mesh was cut off at
  surface  ///< a triangle of the input, which separates two cells or two sides of one; also where it lies in a side of the grid
};

/// The members of a cell or a face, as a range of ids.
class Members {
 public:
  class Iterator {
   public:
    Iterator(const uint32_t* items, uint32_t id) : items_(items), id_(id) {}
    uint32_t operator*() const { return items_ ? *items_ : id_; }
    Iterator& operator++() {
      if (items_) ++items_;
      ++id_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return id_ == other.id_; }

   private:
    const uint32_t* items_;
    uint32_t id_;
  };

  /// Those of element `id`; itself, if there are no offsets.
  Members(const std::vector<uint32_t>& offsets, const std::vector<uint32_t>& items, size_t id)
      : items_(offsets.empty() ? nullptr : items.data() + offsets[id]),
        first_(uint32_t(id)),
        count_(offsets.empty() ? 1 : offsets[id + 1] - offsets[id]) {}
  size_t size() const { return count_; }
  uint32_t operator[](size_t i) const { return items_ ? items_[i] : first_; }
  Iterator begin() const { return {items_, first_}; }
  Iterator end() const { return {nullptr, first_ + count_}; }

 private:
  const uint32_t* items_;
  uint32_t first_, count_;
};

/// All cells, with every face between two of them or on the boundary once. Where a large cell meets smaller ones, its side is divided
/// like theirs, and the edges of a face have all vertices that lie on them. The cut-mesh's vertices, faces and cells come first and keep
/// their ids; then come those of the octree cells: cell cutCells + c is octree cell c. Half-face = 2 * face + side; side 0: the face's
/// normal points out of the cell, side 1: into it.
///
/// refineCells() makes those of cells of several sizes, also at the surface. mergeSmallCells() and uniteWalls() make others of any, whose
/// cells and faces have these as members.
struct CellComplex {
  uint32_t cutVertices = 0;  ///< how many of the vertices are the cut-mesh's
  uint32_t cutFaces = 0;     ///< how many of the faces are the cut-mesh's, or have one of those as their first member
  uint32_t cutCells = 0;     ///< how many of the cells, the same

  std::vector<double> positions;  ///< 3 per vertex, world units

  // As in CutMesh.
  std::vector<uint32_t> loopOffsets;      ///< into loopVertices
  std::vector<uint32_t> loopVertices;     ///< vertex ids
  std::vector<uint32_t> faceLoopOffsets;  ///< into loops

  std::vector<int32_t> faceCells;    ///< 2 per face: the cell on side 0 and that on side 1; -1 outside the grid
  std::vector<FaceTag> faceTag;      ///< per face
  std::vector<double> faceArea;      ///< per face
  std::vector<double> faceNormal;    ///< 3 per face, unit
  std::vector<double> faceCentroid;  ///< 3 per face

  std::vector<uint32_t> cellHalfFaceOffsets;  ///< into cellHalfFaces
  std::vector<uint32_t> cellHalfFaces;        ///< half-faces, ascending
  std::vector<int32_t> cellCorner;            ///< 3 per cell: its grid cell, the lowest one of larger cells
  std::vector<uint8_t> cellLevel;             ///< per cell: as in OctreeCells; 0 for a cut-cell, but see refineCells()
  std::vector<double> cellCentre;             ///< 3 per cell: middle of its grid cell or octree cell, which may lie outside a cut-cell
  std::vector<uint32_t> cellRegion;           ///< per cell: region of the cut-mesh
  std::vector<double> cellVolume;             ///< per cell
  std::vector<double> cellCentroid;           ///< 3 per cell

  // Members: of which cells and faces, before any were merged or united, each one is made. Empty where each is its own only member.
  std::vector<uint32_t> cellMemberOffsets;  ///< into cellMembers
  std::vector<uint32_t> cellMembers;        ///< cells, ascending for each cell; each belongs to one
  std::vector<uint32_t> faceMemberOffsets;  ///< into faceMembers
  std::vector<uint32_t> faceMembers;        ///< faces, ascending for each face; none belongs to two

  Fingerprint madeFrom;     ///< of the cut-mesh; of the whole, if it is a part of another cell complex
  Fingerprint fingerprint;  ///< of the cell complex

  size_t vertexCount() const { return positions.size() / 3; }
  size_t faceCount() const { return faceTag.size(); }
  size_t cellCount() const { return cellRegion.size(); }
  Loops loops(size_t f) const {
    return {loopOffsets.data() + faceLoopOffsets[f], size_t(faceLoopOffsets[f + 1] - faceLoopOffsets[f]), loopVertices.data()};
  }
  std::span<const uint32_t> halfFaces(size_t cell) const {
    return {cellHalfFaces.data() + cellHalfFaceOffsets[cell], cellHalfFaceOffsets[cell + 1] - cellHalfFaceOffsets[cell]};
  }

  Members membersOfCell(size_t cell) const { return {cellMemberOffsets, cellMembers, cell}; }
  Members membersOfFace(size_t face) const { return {faceMemberOffsets, faceMembers, face}; }

  static void fields(auto& self, const auto& f) {
    f("cutVertices", self.cutVertices);
    f("cutFaces", self.cutFaces);
    f("cutCells", self.cutCells);
    f("positions", self.positions);
    f("loopOffsets", self.loopOffsets);
    f("loopVertices", self.loopVertices);
    f("faceLoopOffsets", self.faceLoopOffsets);
    f("faceCells", self.faceCells);
    f("faceTag", self.faceTag);
    f("faceArea", self.faceArea);
    f("faceNormal", self.faceNormal);
    f("faceCentroid", self.faceCentroid);
    f("cellHalfFaceOffsets", self.cellHalfFaceOffsets);
    f("cellHalfFaces", self.cellHalfFaces);
    f("cellCorner", self.cellCorner);
    f("cellLevel", self.cellLevel);
    f("cellCentre", self.cellCentre);
    f("cellRegion", self.cellRegion);
    f("cellVolume", self.cellVolume);
    f("cellCentroid", self.cellCentroid);
    f("cellMemberOffsets", self.cellMemberOffsets);
    f("cellMembers", self.cellMembers);
    f("faceMemberOffsets", self.faceMemberOffsets);
    f("faceMembers", self.faceMembers);
    f("madeFrom", self.madeFrom);
    f("fingerprint", self.fingerprint);
  }
};

/// `mesh` is the input that `cutMesh` was made from, and `octree` comes from coarsen(cutMesh); with maxLevel = 0 its cells are the
/// untouched grid cells. Throws CallError if they don't belong together, if the faces have 2^31 corners or more (meshTooLarge), or if
/// cancelled.
CellComplex cellComplex(const MeshView& mesh, const CutMesh& cutMesh, const OctreeCells& octree, const RunOptions& options = {});

/// Some cells of a cell complex, their faces and vertices, in the whole's order. Where the other cell of a face is left out there is -1,
/// as there is outside the grid. Members keep the ids that they have in the whole.
struct SubComplex {
  CellComplex cells;
  std::vector<uint32_t> wholeVertex;  ///< per vertex: its id in the whole
  std::vector<uint32_t> wholeFace;    ///< per face, the same
  std::vector<uint32_t> wholeCell;    ///< per cell, the same

  static void fields(auto& self, const auto& f) {
    f("cells", self.cells);
    f("wholeVertex", self.wholeVertex);
    f("wholeFace", self.wholeFace);
    f("wholeCell", self.wholeCell);
  }
};

/// The cells that `cellIds` name, in any order. Throws CallError{badArgument} with the element if one does not exist or is named twice.
SubComplex subComplex(const CellComplex& whole, std::span<const uint32_t> cellIds);
/// The cells of a region of the cut-mesh.
SubComplex regionComplex(const CellComplex& whole, uint32_t region);

}  // namespace mandoline
