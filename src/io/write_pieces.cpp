// Pieces of a cut as a folder of .vtu files, joined by a .pvtu file.
#include "io/output_file.h"
#include "io/vtu_file.h"

namespace mandoline {
namespace {

namespace fs = std::filesystem;

/// A folder that keeps its new files if all have been written.
class Folder {
 public:
  /// `last`: the file that tells of the others. That of an earlier cut goes first, since its pieces may.
  Folder(const std::string& path, const std::string& last) : path_(path) {
    std::error_code error;
    isNew_ = fs::create_directories(path_, error);
    if (!error) fs::remove(path_ / last, error);
    if (error) throw FileError(path + ": can't be written: " + error.message());
  }
  ~Folder() {
    if (isComplete_) return;
    std::error_code ignored;
    for (const std::string& file : files_) fs::remove(path_ / file, ignored);
    if (isNew_) fs::remove(path_, ignored);
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
  bool isNew_ = false, isComplete_ = false;
  std::vector<std::string> files_;
};

std::string nameOf(const CutPiece& piece) {
  std::string name = "cut";
  for (const int64_t cell : piece.first) name += '_' + std::to_string(cell);
  return name + ".vtu";
}

std::string arrayXml(const char* type, const char* name, int components) {
  return std::string("<PDataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) + "\"/>\n";
}

/// The arrays of all pieces, which are alike.
std::string arraysXml(const CutMesh& cutMesh) {
  using detail::vtkTypeName;
  std::string xml = "<PPoints>\n" + arrayXml(vtkTypeName(double()), "Points", 3) + "</PPoints>\n<PCellData>\n" +
                    arrayXml(vtkTypeName(int32_t()), "grid_cell", 3);
  detail::forEachRegionArray(
      cutMesh, [&]<class Number>(const char* name, const std::vector<Number>&) { xml += arrayXml(vtkTypeName(Number()), name, 1); });
  return xml + arrayXml(vtkTypeName(double()), "volume", 1) + "</PCellData>\n";
}

std::string joiningXml(const std::string& arrays, const std::vector<std::string>& files) {
  std::string xml = detail::vtkHead("PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n" + arrays;
  for (const std::string& file : files) xml += "<Piece Source=\"" + file + "\"/>\n";
  return xml + "</PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

PieceCounts writePieces(const std::string& path, const PreparedMesh& mesh, const Grid& grid, const ForEachBrickOptions& options) {
  const std::string last = "cut.pvtu";
  Folder folder(path, last);
  Progress progress{"", 0, 1, 0, 1};  // of the cut; that of the writers would begin anew with each piece
  ForEachBrickOptions cutting = options;
  WriteOptions writing;
  writing.threads = options.threads;
  writing.untouched = options.untouched;
  if (options.progress) {
    cutting.progress = [&](const Progress& now) { return options.progress(progress = now); };
    writing.progress = [&](const Progress&) { return options.progress(progress); };
  }
  PieceCounts counts;
  std::string arrays;
  const auto write = [&](const CutPiece& piece) {
    folder.add(nameOf(piece), [&](const Sink& sink) { writeVtu(sink, piece, writing); });
    if (counts.pieces++ == 0) arrays = arraysXml(piece.cutMesh);
    counts.cutCells += piece.cutMesh.cellCount();
    if (options.untouched) counts.untouchedCells += UntouchedCells(piece.cutMesh).count();
  };
  forEachBrick(mesh, grid, write, cutting);
  if (counts.pieces > 0) folder.add(last, [&](const Sink& sink) { sink(joiningXml(arrays, std::vector(folder.files()))); });
  folder.complete();
  return counts;
}

}  // namespace mandoline
