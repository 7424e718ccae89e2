// Whether a cut is the same to the bit for other sizes of bricks, and in shares.
#pragma once

#include "described_cells.h"
#include "same_bits.h"
#include "shared_cut.h"
#include "staged_cut.h"

/// Compares a cut, of one brick for the whole grid, with those of bricks of 2^shift grid cells along each side: put together, and handed on
/// one by one; and in shares. Empty if all say the same, or if the mesh can't be cut.
inline std::string brokenBricks(const mandoline::Mesh& mesh, const mandoline::Grid& grid, int shift, unsigned threads) {
  using namespace mandoline;
  const PreparedMesh prepared = prepare(mesh).mesh;
  const CutResult whole = cut(prepared, grid);
  if (!whole) return "";
  const std::string size = " with bricks of 2^" + std::to_string(shift) + " grid cells";
  const CutMesh oneBrick = stages::cutMeshOf(mesh, grid);
  stages::Way way;
  way.brickShift = shift;
  way.options.threads = threads;
  for (const std::string& array : differences(stages::cutMeshOf(mesh, grid, way), oneBrick)) return array + " differs" + size;
  const uint32_t shares = 2 + uint32_t(shift) % 3;
  const CutResult joined = cutInShares(prepared, grid, shares, way.options);
  for (const std::string& array : differences(joined.mesh, whole.mesh)) return array + " differs in " + std::to_string(shares) + " shares";
  ForEachBrickOptions options;
  options.threads = threads;
  options.cells = int64_t(1) << shift;
  options.untouched = true;
  return describedCells(prepared, grid, options) == describedCells(whole.mesh) ? "" : "the cells of pieces differ" + size;
}
