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
  const auto isWritten = [&](uint32_t region) { return options.regions.empty() || options.regions[region] != 0; };
  const auto any = [&](const std::vector<uint32_t>& regions) { return std::any_of(regions.begin(), regions.end(), isWritten); };
  return any(cutMesh.cellRegion) || (options.untouched && any(cutMesh.runRegion));
}

}  // namespace

bool isPvtu(const std::string& path) { return path.ends_with(kExtension); }

void writePvtu(Ranks& ranks, const std::string& path, const DistributedCut& cut, const RankPiece& piece, const WriteOptions& options) {
  const auto nameOf = [stem = path.substr(0, path.size() - kExtension.size())](int rank) {
    return stem + '_' + std::to_string(rank) + ".vtu";
  };
  const bool isWritten = hasCells(piece.cutMesh, options);
  std::vector<double> cellVolume;
  ranks.together([&] {
    if (isWritten) cellVolume = cut.measures(piece, options).cellVolume;
  });
  RankFiles pieces(ranks, nameOf);
  pieces.write(isWritten, [&](const Sink& sink) { detail::writeVtuPiece(sink, piece.cutMesh, std::move(cellVolume), options); });
  const std::vector<uint64_t> written = ranks.comm().gatherAll(isWritten);
  ranks.inFirst([&] {
    std::vector<std::string> files;
    for (size_t rank = 0; rank < written.size(); ++rank) {
      if (written[rank]) files.push_back(fs::path(nameOf(int(rank))).filename().string());
    }
    if (files.empty()) throw UsageError("--only selects nothing");
    writeOutput(path, [&](const Sink& sink) { sink(detail::pvtuText(detail::pvtuArrays(piece.cutMesh, true), files)); });
  });
  pieces.complete();
}

}  // namespace mandoline::cli
