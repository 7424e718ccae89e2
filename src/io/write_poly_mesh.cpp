#include "io/groups.h"
#include "io/output_buffer.h"
#include "io/poly_mesh.h"
#include "io/seen_polygons.h"
#include "io/selection.h"
#include "mesh/run_call.h"

namespace mandoline {
namespace detail {
namespace {

class PolyMeshWriter {
 public:
  PolyMeshWriter(const FolderSink& sink, const PolyFiles& files, const RunOptions& options)
      : sink_(sink), files_(files), mesh_(files.mesh), options_(options) {}

  void write() {
    writeFile("points", "vectorField", mesh_.points, [&](OutputBuffer& out) { putPoints(out); });
    writeFile("faces", "faceList", mesh_.faces, [&](OutputBuffer& out) { putFaces(out); });
    writeFile("owner", "labelList", mesh_.faces, [&](OutputBuffer& out) { putLabels(out, mesh_.faces, &PolySide::owner); });
    writeFile("neighbour", "labelList", mesh_.innerFaces,
              [&](OutputBuffer& out) { putLabels(out, mesh_.innerFaces, &PolySide::neighbour); });
    writeFile("boundary", "polyBoundaryMesh", mesh_.patches.size(), [&](OutputBuffer& out) { putPatches(out); });
    for (const PolyList& list : files_.lists) {
      writeFile(list.name, "labelList", list.numbers.size(), [&](OutputBuffer& out) {
        for (const int64_t number : list.numbers) putLabel(out, number);
      });
    }
    if (mesh_.zones.size() > 1) writeFile("cellZones", "regIOobject", mesh_.zones.size(), [&](OutputBuffer& out) { putZones(out); });
  }

 private:
  template <class Put>
  void writeFile(const char* name, const char* type, uint64_t count, const Put& put) {
    const Sink sink = [&, file = std::string(name)](std::string_view piece) { sink_(file, piece); };
    Meter meter(sink, options_, int(kFiles + files_.lists.size()));
    meter.beginStage(name, begunFiles_++, count);
    OutputBuffer out(meter);
    out.text("FoamFile\n{\n    version 2.0;\n    format ascii;\n    class ");
    out.text(type);
    out.text(";\n");
    if (std::string_view(name) == "owner" || std::string_view(name) == "neighbour") putNote(out);
    out.text("    location \"constant/polyMesh\";\n    object ");
    out.text(name);
    out.text(";\n}\n\n");
    out.number(count);
    out.text("\n(\n");
    put(out);
    out.text(")\n");
    out.flush();
  }

  void putNote(OutputBuffer& out) const {
    const std::pair<const char*, uint64_t> counts[] = {
        {"nPoints: ", mesh_.points}, {"  nCells: ", mesh_.cells}, {"  nFaces: ", mesh_.faces}, {"  nInternalFaces: ", mesh_.innerFaces}};
    out.text("    note \"");
    for (const auto& [name, count] : counts) {
      out.text(name);
      out.number(count);
    }
    out.text("\";\n");
  }

  void putPoints(OutputBuffer& out) const {
    for (size_t v = 0; v < mesh_.pointNumbers.size(); ++v) {
      if (mesh_.pointNumbers[v] == PolyMesh::kUnused) continue;
      const auto moved = files_.moved.find(uint32_t(v));
      const double* const point = moved == files_.moved.end() ? &files_.cells.positions[3 * v] : moved->second.data();
      for (size_t d = 0; d < 3; ++d) {
        out.character(d == 0 ? '(' : ' ');
        out.number(point[d]);
      }
      out.text(")\n");
      out.advance();
    }
  }

  void putFaces(OutputBuffer& out) const {
    mesh_.forEach([&](const PolySide& side) {
      files_.polygons.forEach(side.halfFace / 2, [&](std::span<const uint32_t> polygon) {
        out.number(polygon.size());
        for (size_t i = 0; i < polygon.size(); ++i) {
          out.character(i == 0 ? '(' : ' ');
          out.number(mesh_.pointNumbers[side.vertex(polygon, i)]);
        }
        out.text(")\n");
        out.advance();
      });
    });
  }

  void putLabel(OutputBuffer& out, int64_t label) const {
    out.number(label);
    out.character('\n');
    out.advance();
  }

  /// Owners or neighbours of the first faces.
  void putLabels(OutputBuffer& out, uint64_t count, int32_t PolySide::*label) const {
    uint64_t next = 0;
    mesh_.forEach([&](const PolySide& side) {
      files_.polygons.forEach(side.halfFace / 2, [&](std::span<const uint32_t>) {
        if (next++ < count) putLabel(out, side.*label);
      });
    });
  }

  void putPatches(OutputBuffer& out) const {
    uint64_t start = mesh_.innerFaces;
    for (const PolyPatch& patch : mesh_.patches) {
      uint64_t count = 0;
      for (const PolySide& side : patch.sides) files_.polygons.forEach(side.halfFace / 2, [&](std::span<const uint32_t>) { ++count; });
      out.text(patch.name);
      out.text("\n{\n    type ");
      out.text(patch.type);
      out.text(";\n    nFaces ");
      out.number(count);
      out.text(";\n    startFace ");
      out.number(start);
      out.text(";\n");
      out.text(patch.entries);
      out.text("}\n");
      start += count;
    }
  }

  void putZones(OutputBuffer& out) const {
    for (const PolyZone& zone : mesh_.zones) {
      out.text("region");
      out.number(zone.region);
      out.text("\n{\n    type cellZone;\n    cellLabels List<label>\n");
      out.number(zone.cells.size());
      out.text("\n(\n");
      for (const int32_t c : zone.cells) {
        out.number(c);
        out.character('\n');
      }
      out.text(");\n}\n");
    }
  }

  static constexpr int kFiles = 6;
  const FolderSink& sink_;
  const PolyFiles& files_;
  const PolyMesh& mesh_;
  const RunOptions& options_;
  int begunFiles_ = 0;
};

}  // namespace

void writeFiles(const FolderSink& sink, const PolyFiles& files, const RunOptions& options) { PolyMeshWriter(sink, files, options).write(); }

}  // namespace detail

namespace {

/// The options, with regions chosen of merged cells if none are.
WriteOptions withRegions(const CutMesh& cutMesh, const CellComplex& cells, WriteOptions options) {
  if (!detail::isMerged(cells) || !options.regions.empty()) return options;
  std::vector<uint8_t> atSides = detail::regionsAtSides(cutMesh.regionCount, cells);
  if (detail::countLeftOut(atSides) > 0) options.regions = std::move(atSides);
  return options;
}

}  // namespace

void writePolyMesh(const FolderSink& sink, const CutMesh& cutMesh, const CellComplex& cells, const WriteOptions& options) {
  detail::Selection(cutMesh, options);  // checks them
  detail::runCall("writing", [&] {
    const bool isMerged = detail::isMerged(cells);
    const TriangleGroups* const groups = detail::checkedGroups(options.groups, cutMesh.triangleCount);
    detail::ComplexPolygons polygons(cutMesh, cells);
    const WriteOptions chosen = withRegions(cutMesh, cells, options);
    detail::PolygonSharing alone;
    if (isMerged) {
      detail::collapseFlatPolygons(cells, polygons, alone);
      detail::dividePolygonsNotSeen(cells, polygons);
    }
    detail::PolyMesh mesh = detail::makePolyMesh(cutMesh, cells, groups, options.simpleCells, [&](size_t cell) {
      return chosen.hasRegion(cells.cellRegion[cell]) && (options.untouched || cell < cells.cutCells) &&
             !(isMerged && detail::isEnclosedByWalls(cells, polygons, cell));
    });
    if (isMerged) detail::dropEmptySides(mesh, polygons);
    detail::PolyFiles files{cells, polygons, mesh};
    if (isMerged) files.moved = detail::movedOffCentroids(cells, polygons, alone);
    detail::countFaces(files);
    detail::writeFiles(sink, files, options);
  });
}

}  // namespace mandoline
