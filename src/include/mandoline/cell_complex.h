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

/// All cells, with every face between two of them or on the boundary once. Where a large cell meets smaller ones, its side is divided
/// like theirs, and the edges of a face have all vertices that lie on them. The cut-mesh's vertices, faces and cells come first and keep
/// their ids; then come those of the octree cells: cell cutCells + c is octree cell c. Half-face = 2 * face + side; side 0: the face's
/// normal points out of the cell, side 1: into it.
struct CellComplex {
  uint32_t cutVertices = 0;  ///< how many of the vertices are the cut-mesh's
  uint32_t cutFaces = 0;     ///< how many of the faces
  uint32_t cutCells = 0;     ///< how many of the cells

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
  std::vector<int32_t> cellCorner;            ///< 3 per cell: its grid cell, the lowest one of an octree cell
  std::vector<uint8_t> cellLevel;             ///< per cell: as in OctreeCells, 0 for a cut-cell
  std::vector<double> cellCentre;             ///< 3 per cell: middle of its grid cell or octree cell, which may lie outside a cut-cell
  std::vector<uint32_t> cellRegion;           ///< per cell: region of the cut-mesh
  std::vector<double> cellVolume;             ///< per cell
  std::vector<double> cellCentroid;           ///< 3 per cell

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
    f("madeFrom", self.madeFrom);
    f("fingerprint", self.fingerprint);
  }
};

/// `mesh` is the input that `cutMesh` was made from, and `octree` comes from coarsen(cutMesh); with maxLevel = 0 its cells are the
/// untouched grid cells. Throws CallError if they don't belong together, if the faces have 2^31 corners or more (meshTooLarge), or if
/// cancelled.
CellComplex cellComplex(const MeshView& mesh, const CutMesh& cutMesh, const OctreeCells& octree, const RunOptions& options = {});

/// Some cells of a cell complex, their faces and vertices, in the whole's order. Where the other cell of a face is left out there is -1,
/// as there is outside the grid.
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
