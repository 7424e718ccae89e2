// Pieces of a cut as a folder of .vtu files, joined by a .pvtu file.
#include <algorithm>

#include "io/output_file.h"
#include "io/pvtu.h"

namespace mandoline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kJoining = "cut.pvtu", kPiece = "cut_", kExtension = ".vtu";

std::string nameOf(const CutPiece& piece) {
  const auto& [i, j, k] = piece.first;
  return std::string(kPiece) + std::to_string(i) + '_' + std::to_string(j) + '_' + std::to_string(k) + std::string(kExtension);
}

/// Whether a file has a name that is given here.
bool isOurs(std::string_view name) {
  if (name == kJoining) return true;
  if (!name.starts_with(kPiece) || !name.ends_with(kExtension)) return false;
  name = name.substr(kPiece.size(), name.size() - kPiece.size() - kExtension.size());
  return std::count(name.begin(), name.end(), '_') == 2 && name.find_first_not_of("0123456789_") == std::string_view::npos;
}

/// A folder that keeps its new files if all have been written.
class Folder {
 public:
  /// The files of an earlier cut go.
  explicit Folder(const std::string& path) : path_(path), made_(path_) {
    try {
      std::vector<fs::path> earlier;
      for (const fs::directory_entry& file : fs::directory_iterator(path_)) {
        if (isOurs(file.path().filename().string())) earlier.push_back(file.path());
      }
      for (const fs::path& file : earlier) fs::remove(file);
    } catch (const fs::filesystem_error& error) {
      throw FileError(path + ": can't be written: " + error.code().message());
    }
  }
  ~Folder() {
    if (isComplete_) return;
    std::error_code ignored;
    for (const std::string& file : files_) fs::remove(path_ / file, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  template <class Write>
  void add(const std::string& file, const Write& write) {
    detail::OutputFile output((path_ / file).string());
    write([&](std::string_view bytes) { output.write(bytes); });
    files_.push_back(file);
    output.commit();
  }
  const std::vector<std::string>& files() const { return files_; }
  void complete() { isComplete_ = !files_.empty(); }

 private:
  const fs::path path_;
  const detail::OutputFolder made_;
  bool isComplete_ = false;
  std::vector<std::string> files_;
};

}  // namespace

PieceCounts writePieces(const std::string& path, const PreparedMesh& mesh, const Grid& grid, const WritePiecesOptions& options) {
  Folder folder(path);
  Progress progress{"", 0, 1, 0, 1};  // of the cut; that of the writers would begin anew with each piece
  ForEachBrickOptions cutting = options;
  WriteOptions writing;
  writing.threads = options.threads;
  writing.untouched = options.untouched;
  writing.simpleCells = options.simpleCells;
  if (options.progress) {
    cutting.progress = [&](const Progress& now) { return options.progress(progress = now); };
    writing.progress = [&](const Progress&) { return options.progress(progress); };
  }
  PieceCounts counts;
  std::string arrays;
  const auto write = [&](const CutPiece& piece) {
    folder.add(nameOf(piece), [&](const Sink& sink) { writeVtu(sink, piece, writing); });
    if (counts.pieces++ == 0) arrays = detail::pvtuArrays(piece.cutMesh, detail::PieceCells::brick);
    counts.cutCells += piece.cutMesh.cellCount();
    if (options.untouched) counts.untouchedCells += UntouchedCells(piece.cutMesh).count();
  };
  forEachBrick(mesh, grid, write, cutting);
  if (counts.pieces > 0)
    folder.add(std::string(kJoining), [&](const Sink& sink) { sink(detail::pvtuText(arrays, std::vector(folder.files()))); });
  folder.complete();
  return counts;
}

}  // namespace mandoline
