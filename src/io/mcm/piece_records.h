// What a .mcm file of a piece has after its cut-mesh: a record of what is not an array, one of each array of ids and ranks, and one of the
// seams.
#pragma once

#include "io/mcm/arrays.h"
#include "mandoline/rank_piece.h"

namespace mandoline::detail {

inline constexpr std::string_view kPieceName = "piece";

/// Calls visit(name, array) for each.
template <class AnyPiece, class Visit>
void forEachIdArray(AnyPiece& piece, const Visit& visit) {
  visit("vertexIds", piece.vertexIds);
  visit("faceIds", piece.faceIds);
  visit("cellIds", piece.cellIds);
  visit("vertexRanks", piece.vertexRanks);
  visit("faceRanks", piece.faceRanks);
}

/// The layers and the fingerprint of the whole.
template <class Stream, class AnyPiece>
void codePieceHead(typename Stream::Bytes& bytes, AnyPiece& piece) {
  Stream stream(bytes);
  for (auto& layer : piece.layers) codeEntry(stream, layer, 0);
  codeEntry(stream, piece.whole.value, 0);
  stream.finish();
}

/// `length`: how many there are.
template <class Stream, class AnyPiece>
void codeSeams(typename Stream::Bytes& bytes, AnyPiece& piece, uint64_t length) {
  Stream stream(bytes);
  stream.expect(length);
  setLength(piece.seams, length);
  for (auto& seam : piece.seams) {
    codeEntry(stream, seam.rank, 0);
    const auto code = [&](auto& array) {
      const uint64_t count = uint64_t(stream.code(int64_t(array.size())));
      stream.expect(count);
      setLength(array, count);
      for (size_t i = 0; i < array.size(); ++i) codeEntry(stream, array[i], i == 0 ? 0 : toInteger(array[i - 1]));
    };
    code(seam.faces);
    code(seam.cells);
  }
  stream.finish();
}
inline constexpr std::string_view kSeamsName = "seams";

}  // namespace mandoline::detail
