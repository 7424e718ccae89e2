// Lengths, areas, normals, volumes and centroids of a cut-mesh, and its adjacency.
#pragma once

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace mandoline {

/// All in world units. Computed from the made vertices' provenance in coordinates local to each cell, so that the relative error of a
/// tiny cell is tiny too.
struct Measures {
  std::vector<double> faceArea;      ///< per face
  std::vector<double> faceNormal;    ///< 3 per face, unit
  std::vector<double> faceCentroid;  ///< 3 per face
  std::vector<double> cellVolume;    ///< per cut-cell
  std::vector<double> cellCentroid;  ///< 3 per cut-cell
};

/// `mesh` is the input that `cutMesh` was made from. Throws CallError if it can't be, or if cancelled.
Measures measure(const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options = {});

/// Unique undirected cut-edges (of all loops), lower vertex id first, ascending, with their lengths.
struct CutEdges {
  std::vector<uint32_t> edgeVertices;  ///< 2 per edge
  std::vector<double> edgeLength;      ///< per edge
};
/// Throws as measure() does.
CutEdges cutEdges(const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options = {});

/// Volume of each region, cut-cells and untouched grid cells together. Throws CallError if the measures are of a cut-mesh with another
/// number of cut-cells.
std::vector<double> regionVolumes(const CutMesh& cutMesh, const Measures& measures);

/// Who lies beside whom. A neighbour is a cut-cell, an untouched grid cell, or nothing (the box ends).
struct Adjacency {
  std::vector<int32_t> faceCells;         ///< 2 per face: the cut-cell of side 0 and of side 1, or -1
  std::vector<int64_t> faceGridCells;     ///< 2 per face: where faceCells is -1, the untouched grid cell (i + nx (j + ny k)), or -1
  std::vector<uint32_t> cellCellOffsets;  ///< into cellCells, per cut-cell
  std::vector<uint32_t> cellCells;        ///< neighbouring cut-cells of each cut-cell across any face, ascending, without repeats
};
Adjacency adjacency(const CutMesh& cutMesh);

}  // namespace mandoline
