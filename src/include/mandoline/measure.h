// Lengths, areas, normals, volumes and centroids of a cut-mesh, and its adjacency.
#pragma once

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace MANDOLINE_API mandoline {

/// All in world units. Computed from what each vertex comes from (vertexParents), in coordinates local to each cell, so that the relative
/// error is small for a tiny cell, too. Lengths should be from 1e-70 to 1e70: of others, products of up to four underflow, or overflow.
struct Measures {
  std::vector<double> faceArea;      ///< per face
  std::vector<double> faceNormal;    ///< 3 per face, unit
  std::vector<double> faceCentroid;  ///< 3 per face
  std::vector<double> cellVolume;    ///< per cut-cell
  std::vector<double> cellCentroid;  ///< 3 per cut-cell
  Fingerprint madeFrom;              ///< of the cut-mesh

  static void fields(auto& self, const auto& f) {
    f("faceArea", self.faceArea);
    f("faceNormal", self.faceNormal);
    f("faceCentroid", self.faceCentroid);
    f("cellVolume", self.cellVolume);
    f("cellCentroid", self.cellCentroid);
    f("madeFrom", self.madeFrom);
  }
};

/// `mesh` is the input that `cutMesh` was made from. Throws CallError if it is not (badArgument), or if cancelled.
Measures measure(const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options = {});

/// Unique undirected cut-edges (of all loops), lower vertex id first, ascending, with their lengths.
struct CutEdges {
  std::vector<uint32_t> edgeVertices;  ///< 2 per edge
  std::vector<double> edgeLength;      ///< per edge

  static void fields(auto& self, const auto& f) {
    f("edgeVertices", self.edgeVertices);
    f("edgeLength", self.edgeLength);
  }
};
/// Throws as measure() does.
CutEdges cutEdges(const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options = {});

/// Volume of each region, cut-cells and untouched grid cells together. Throws CallError if the measures are of another
/// cut-mesh.
std::vector<double> regionVolumes(const CutMesh& cutMesh, const Measures& measures);

/// What lies on the two sides of each face (a cut-cell, an untouched grid cell, or nothing where the grid ends), and beside each cut-cell.
struct Adjacency {
  std::vector<int32_t> faceCells;         ///< 2 per face: the cut-cell of side 0 and of side 1, or -1
  std::vector<int64_t> faceGridCells;     ///< 2 per face, the same: the untouched grid cell i + nx (j + ny k); else -1
  std::vector<uint32_t> cellCellOffsets;  ///< into cellCells, per cut-cell
  std::vector<uint32_t> cellCells;        ///< neighbouring cut-cells of each cut-cell across any face, ascending, without repeats

  static void fields(auto& self, const auto& f) {
    f("faceCells", self.faceCells);
    f("faceGridCells", self.faceGridCells);
    f("cellCellOffsets", self.cellCellOffsets);
    f("cellCells", self.cellCells);
  }
};
Adjacency adjacency(const CutMesh& cutMesh);

}  // namespace mandoline
