#include "cli/mpi/piece_files.h"

#include <algorithm>
#include <filesystem>

#include "cli/arguments.h"
#include "cli/files.h"
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

PieceFiles::PieceFiles(Ranks& ranks, std::string path) : ranks_(ranks), path_(std::move(path)) {}

/// Those of all processes: one that was killed has left what it was writing.
PieceFiles::~PieceFiles() {
  if (isComplete_) return;
  std::error_code ignored;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    fs::remove(pieceName(rank), ignored);
    fs::remove(pieceName(rank) + ".part", ignored);
  }
}

std::string PieceFiles::pieceName(int rank) const {
  return path_.substr(0, path_.size() - kExtension.size()) + '_' + std::to_string(rank) + ".vtu";
}

void PieceFiles::write(const MeshView& mesh, const RankPiece& piece, const WriteOptions& options) {
  const bool isWritten = hasCells(piece.cutMesh, options);
  ranks_.together([&] {
    if (isWritten) writeOutput(pieceName(ranks_.rank()), [&](const Sink& sink) { writeVtu(sink, mesh, piece.cutMesh, options); });
  });
  const std::vector<uint64_t> written = ranks_.comm().gatherAll(isWritten);
  ranks_.inFirst([&] {
    std::vector<std::string> files;
    for (size_t rank = 0; rank < written.size(); ++rank) {
      if (written[rank]) files.push_back(fs::path(pieceName(int(rank))).filename().string());
    }
    if (files.empty()) throw UsageError("--only selects nothing");
    writeOutput(path_, [&](const Sink& sink) { sink(detail::pvtuText(detail::pvtuArrays(piece.cutMesh, true), files)); });
  });
  isComplete_ = true;
}

}  // namespace mandoline::cli
