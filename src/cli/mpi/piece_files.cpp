#include "cli/mpi/piece_files.h"

#include <algorithm>
#include <filesystem>

#include "cli/arguments.h"
#include "cli/files.h"
#include "cli/mpi/rank_files.h"
#include "io/pvtu.h"

namespace mandoline::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExtension = ".pvtu";

bool hasCells(const CutMesh& cutMesh, const WriteOptions& options) {
  const auto isWritten = [&](uint32_t region) { return options.hasRegion(region); };
  const auto any = [&](const std::vector<uint32_t>& regions) { return std::any_of(regions.begin(), regions.end(), isWritten); };
  return any(cutMesh.cellRegion) || (options.untouched && any(cutMesh.runRegion));
}

/// The file of this process, if it is written, and in the first one that which joins those of all.
void writeJoined(Ranks& ranks, const std::string& path, const std::string& arrays, bool isWritten,
                 const std::function<void(const Sink&)>& write) {
  const auto nameOf = [stem = path.substr(0, path.size() - kExtension.size())](int rank) {
    return stem + '_' + std::to_string(rank) + ".vtu";
  };
  RankFiles pieces(ranks, nameOf);
  pieces.write(isWritten, write);
  const std::vector<uint64_t> written = ranks.comm().gatherAll(isWritten);
  ranks.inFirst([&] {
    std::vector<std::string> files;
    for (size_t rank = 0; rank < written.size(); ++rank) {
      if (written[rank]) files.push_back(fs::path(nameOf(int(rank))).filename().string());
    }
    if (files.empty()) throw UsageError("--only selects nothing");
    writeOutput(path, [&](const Sink& sink) { sink(detail::pvtuText(arrays, files)); });
  });
  pieces.complete();
}

}  // namespace

bool isPvtu(const std::string& path) { return path.ends_with(kExtension); }

void writePvtu(Ranks& ranks, const std::string& path, const DistributedCut& cut, const RankPiece& piece, const WriteOptions& options) {
  const bool isWritten = hasCells(piece.cutMesh, options);
  std::vector<double> cellVolume;
  ranks.together([&] {
    if (isWritten) cellVolume = cut.measures(piece, options).cellVolume;
  });
  writeJoined(ranks, path, detail::pvtuArrays(piece.cutMesh, detail::PieceCells::cut), isWritten,
              [&](const Sink& sink) { detail::writeVtuPiece(sink, piece.cutMesh, std::move(cellVolume), options); });
}

void writePvtu(Ranks& ranks, const std::string& path, const RankComplex& complex, const WriteOptions& options) {
  const CellComplex& cells = complex.cells;
  const auto isOwn = [&](size_t c) { return complex.cellRanks[c] == ranks.rank(); };
  bool isWritten = false;
  for (size_t c = 0; c < cells.cellCount(); ++c)
    isWritten |= isOwn(c) && options.hasRegion(cells.cellRegion[c]) && (options.untouched || c < cells.cutCells);
  writeJoined(ranks, path, detail::pvtuArrays(complex.cutMesh, detail::PieceCells::complex), isWritten,
              [&](const Sink& sink) { detail::writeVtuPiece(sink, complex.cutMesh, cells, isOwn, options); });
}

}  // namespace mandoline::cli
