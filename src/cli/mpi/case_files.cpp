#include "cli/mpi/case_files.h"

#include <algorithm>
#include <filesystem>

#include "base/sort.h"
#include "cli/arguments.h"
#include "cli/cut_command.h"
#include "cli/mpi/case_numbers.h"
#include "cli/mpi/rank_polygons.h"
#include "io/flat_polygons.h"
#include "io/groups.h"
#include "io/seen_polygons.h"

namespace mandoline::cli {
namespace {

namespace fs = std::filesystem;

using detail::PolyMesh;
using detail::PolyPatch;
using detail::PolySide;

constexpr const char* kNames[] = {"points",
                                  "faces",
                                  "owner",
                                  "neighbour",
                                  "boundary",
                                  "cellZones",
                                  "cellProcAddressing",
                                  "faceProcAddressing",
                                  "pointProcAddressing",
                                  "boundaryProcAddressing"};

/// The process's own cells, without those that others have beside them.
PolyMesh ownMesh(const RankComplex& complex, const detail::ComplexPolygons& polygons, const WriteOptions& options, int rank) {
  const TriangleGroups* const groups = detail::checkedGroups(options.groups, complex.cutMesh.triangleCount);
  PolyMesh mesh = detail::makePolyMesh(complex.cutMesh, complex.cells, groups, options.simpleCells, [&](size_t c) {
    return complex.cellRanks[c] == rank && options.hasRegion(complex.cells.cellRegion[c]) &&
           !(detail::isMerged(complex.cells) && detail::isEnclosedByWalls(complex.cells, polygons, c));
  });
  std::erase_if(mesh.patches,
                [&](const PolyPatch& patch) { return &patch - mesh.patches.data() == ptrdiff_t(FaceTag::inner) && patch.name == "inner"; });
  return mesh;
}

/// What makes the whole mesh of the pieces.
std::vector<detail::PolyList> addressing(const RankComplex& complex, const detail::PolyFiles& files, const CaseNumbers& numbers) {
  const PolyMesh& mesh = files.mesh;
  std::vector<int64_t> cells(numbers.cells.begin(), numbers.cells.end()), points(numbers.points.begin(), numbers.points.end());
  std::vector<int64_t> faces, patches;
  // Numbers count from 1, and are negative where a face's normal is the opposite of that in the whole.
  mesh.forEach([&](const PolySide& side) {
    files.polygons.forEach(side.halfFace / 2, [&](std::span<const uint32_t>) {
      const int64_t number = int64_t(numbers.faces[faces.size()]) + 1;
      faces.push_back(side.isTurned ? -number : number);
    });
  });
  for (size_t p = 0; p < mesh.patches.size(); ++p) patches.push_back(p + complex.seams.size() < mesh.patches.size() ? int64_t(p) : -1);
  return {{"cellProcAddressing", std::move(cells)},
          {"faceProcAddressing", std::move(faces)},
          {"pointProcAddressing", std::move(points)},
          {"boundaryProcAddressing", std::move(patches)}};
}

/// Without a '/' at the end.
fs::path folderAt(const std::string& path) {
  const fs::path folder = fs::path(path).lexically_normal();
  return folder.has_filename() ? folder : folder.parent_path();
}

}  // namespace

void checkCase(const std::string& path) {
  if (folderAt(path).parent_path().filename() != "constant")
    throw UsageError("-o " + path + ": several processes write CASE/constant/polyMesh, as CASE/processor0 and so on");
}

CaseFiles::CaseFiles(Ranks& ranks, const std::string& path) : ranks_(ranks), case_(folderAt(path).parent_path().parent_path().string()) {
  ranks_.inFirst([&] { refuseOthers(); });
}

/// Those of all processes: one that was killed has left what it was writing.
CaseFiles::~CaseFiles() {
  if (isComplete_) return;
  std::error_code ignored;
  for (int rank = 0; rank < ranks_.size(); ++rank) {
    const fs::path folder = folderOf(rank);
    for (const char* name : kNames) {
      fs::remove(folder / name, ignored);
      fs::remove(folder / (std::string(name) + ".part"), ignored);
    }
    for (const fs::path& made : {folder, folder.parent_path(), folder.parent_path().parent_path()}) fs::remove(made, ignored);  // if empty
  }
}

std::string CaseFiles::folderOf(int rank) const {
  return (fs::path(case_) / ("processor" + std::to_string(rank)) / "constant" / "polyMesh").string();
}

/// OpenFOAM would take a part of an earlier, finer decomposition for one of this.
void CaseFiles::refuseOthers() const {
  const fs::path next = fs::path(folderOf(ranks_.size())).parent_path().parent_path();
  if (fs::exists(next)) throw FileError(next.string() + ": is there already, of a case in more parts");
}

/// A patch for each process that has cells beside ours, with the faces between them, in the order of the whole.
void CaseFiles::addSeams(const RankComplex& complex, PolyMesh& mesh) const {
  const CellComplex& cells = complex.cells;
  const std::string here = std::to_string(ranks_.rank());
  for (const ComplexSeam& seam : complex.seams) {
    const std::string there = std::to_string(seam.rank);
    PolyPatch& patch = mesh.patches.emplace_back(PolyPatch{"procBoundary" + here + "to" + there, "processor", {}});
    patch.entries = "    inGroups 1(processor);\n    matchTolerance 0.0001;\n    transform unknown;\n    myProcNo " + here +
                    ";\n    neighbProcNo " + there + ";\n";
    struct Ordered {
      std::array<int32_t, 2> cells;
      uint32_t halfFace;
    };
    std::vector<Ordered> faces;
    for (const uint32_t f : seam.faces) {
      if (cells.faceTag[f] != FaceTag::inner) continue;
      const int32_t a = cells.faceCells[2 * size_t(f)], b = cells.faceCells[2 * size_t(f) + 1];
      const bool isOwn = complex.cellRanks[size_t(a)] == ranks_.rank();
      faces.push_back({{std::min(a, b), std::max(a, b)}, 2 * f + !isOwn});
    }
    detail::sortItems(faces, [](const Ordered& a, const Ordered& b) { return a.cells < b.cells; });
    for (const Ordered& face : faces) {
      const int32_t owner = cells.faceCells[face.halfFace];
      if (mesh.cellNumbers[size_t(owner)] == PolySide::kLeftOut) continue;  // and so is what is beyond, of the same region
      patch.sides.push_back({mesh.cellNumbers[size_t(owner)], PolySide::kLeftOut, face.halfFace, owner != face.cells[0]});
    }
  }
}

/// Each process has those that any has.
void CaseFiles::addZones(const RankComplex& complex, PolyMesh& mesh) const {
  std::vector<uint8_t> isThere;
  ranks_.together([&] {
    isThere.assign(complex.cutMesh.regionCount, 0);
    for (const detail::PolyZone& zone : mesh.zones) isThere[zone.region] = 1;
  });
  ranks_.comm().uniteFlags(isThere);
  ranks_.together([&] {
    std::vector<detail::PolyZone> zones(isThere.size());
    for (uint32_t region = 0; region < zones.size(); ++region) zones[region].region = region;
    for (detail::PolyZone& zone : mesh.zones) zones[zone.region].cells = std::move(zone.cells);
    std::erase_if(zones, [&](const detail::PolyZone& zone) { return isThere[zone.region] == 0; });
    mesh.zones = std::move(zones);
  });
}

/// As writePolyMesh() chooses them of merged cells.
void CaseFiles::chooseRegions(const RankComplex& complex, WriteOptions& options) const {
  std::vector<uint8_t> atSides;
  ranks_.together([&] { atSides = detail::regionsAtSides(complex.cutMesh.regionCount, complex.cells); });
  ranks_.comm().uniteFlags(atSides);
  if (detail::countLeftOut(atSides) == 0) return;
  ranks_.inFirst([&] { noteLeftOut(case_, atSides); });
  options.regions = std::move(atSides);
}

void CaseFiles::write(RankComplex complex, WriteOptions options) {
  const bool areMerged = ranks_.comm().reduce(int(detail::isMerged(complex.cells)), MPI_MAX) != 0;  // some may have no cells
  if (areMerged && options.regions.empty()) chooseRegions(complex, options);
  std::optional<detail::ComplexPolygons> polygons;
  PolyMesh mesh;
  std::optional<detail::PolyFiles> files;
  ranks_.together([&] { polygons.emplace(complex.cutMesh, complex.cells); });
  std::optional<RankPolygons> sharing;
  if (areMerged) {
    sharing.emplace(ranks_.comm(), complex);
    detail::collapseFlatPolygons(complex.cells, *polygons, *sharing);
  }
  ranks_.together([&] {
    if (areMerged) detail::dividePolygonsNotSeen(complex.cells, *polygons);
    mesh = ownMesh(complex, *polygons, options, ranks_.rank());
    addSeams(complex, mesh);
    if (areMerged) detail::dropEmptySides(mesh, *polygons);
    files.emplace(detail::PolyFiles{complex.cells, *polygons, mesh});
    detail::countFaces(*files);
  });
  if (areMerged) files->moved = detail::movedOffCentroids(complex.cells, *polygons, *sharing);
  addZones(complex, mesh);
  const CaseNumbers numbers = caseNumbers(ranks_.comm(), complex, *files);
  ranks_.together([&] {
    files->lists = addressing(complex, *files, numbers);
    detail::writeFolder(folderOf(ranks_.rank()), [&](const FolderSink& sink) { detail::writeFiles(sink, *files, options); });
  });
  isComplete_ = true;
}

}  // namespace mandoline::cli
