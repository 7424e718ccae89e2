// .pvtu files, which join .vtu files of pieces of a cut.
#pragma once

#include <string>
#include <vector>

#include "base/function_ref.h"
#include "base/shared.h"
#include "mandoline/io.h"

namespace mandoline::detail {

enum class PieceCells : uint8_t {
  brick,    ///< one of writePieces()
  cut,      ///< of a cut-mesh
  complex,  ///< of a cell complex
};

/// The arrays of the pieces, which are those of this one.
MANDOLINE_SHARED std::string pvtuArrays(const CutMesh& piece, PieceCells kind);
/// The file. `pieces`: relative to its folder.
MANDOLINE_SHARED std::string pvtuText(const std::string& arrays, const std::vector<std::string>& pieces);

/// One of the pieces, as writeVtu() writes it. `cellVolume`: per cut-cell.
MANDOLINE_SHARED void writeVtuPiece(const Sink& sink, const CutMesh& cutMesh, std::vector<double> cellVolume, const WriteOptions& options);
/// The same of a cell complex: those of the cells written for which isOwn(cell).
MANDOLINE_SHARED void writeVtuPiece(const Sink& sink, const CutMesh& cutMesh, const CellComplex& cells,
                                    FunctionRef<bool(size_t cell)> isOwn, const WriteOptions& options);

}  // namespace mandoline::detail
