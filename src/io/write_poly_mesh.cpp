// OpenFOAM's polyMesh: a folder with the lists of points, faces, owners, neighbours and patches.
//
// A face's normal points out of its owner, the cell of lower number. Inner faces come first, by owner and then by neighbour (the upper
// triangular order), and those of each patch follow.
#include <algorithm>
#include <array>

#include "base/sort.h"
#include "io/complex_polygons.h"
#include "io/groups.h"
#include "io/output_buffer.h"
#include "io/selection.h"
#include "mesh/run_call.h"

namespace mandoline {
namespace detail {
namespace {

constexpr int32_t kLeftOut = -1;

/// One side of a face of the cell complex, whose cell is its owner.
struct Side {
  int32_t owner, neighbour;  ///< cells of the polyMesh; no neighbour: kLeftOut
  uint32_t halfFace;
};

struct Patch {
  std::string name;
  const char* type;
  std::vector<Side> sides;
};

/// All sides that are written, in their order.
struct Sides {
  std::vector<Side> inner;
  std::vector<Patch> patches;

  template <class Visit>
  void forEach(const Visit& visit) const {
    for (const Side& side : inner) visit(side);
    for (const Patch& patch : patches) {
      for (const Side& side : patch.sides) visit(side);
    }
  }
};

constexpr const char* kBoxPatches[] = {"xMin", "xMax", "yMin", "yMax", "zMin", "zMax", "inner"};  // in the order of FaceTag
constexpr const char* kSurface = "surface";

/// What the faces of a tag belong to, in the order of FaceTag; inner ones if only one of their cells is written. From FaceTag::surface on
/// there is one for each group.
std::vector<Patch> emptyPatches(const TriangleGroups* groups) {
  std::vector<Patch> patches;
  for (const char* const name : kBoxPatches) patches.push_back({name, "patch", {}});
  const std::vector<std::string> walls = groups ? patchNames(groups->names, kBoxPatches) : std::vector<std::string>{kSurface};
  for (const std::string& name : walls) patches.push_back({name, "wall", {}});
  return patches;
}

Sides sort(const CutMesh& cutMesh, const CellComplex& cells, const std::vector<int32_t>& numbers, const TriangleGroups* groups,
           bool simpleCells) {
  Sides sides;
  sides.patches = emptyPatches(groups);
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    std::array<int32_t, 2> at{};
    for (size_t side = 0; side < 2; ++side) {
      const int32_t cell = cells.faceCells[2 * f + side];
      at[side] = cell < 0 ? kLeftOut : numbers[size_t(cell)];
    }
    if (simpleCells && at[0] == at[1] && at[0] != kLeftOut) continue;
    const bool separates = cells.faceTag[f] == FaceTag::surface;  // also two sides of one cell
    if (!separates && at[0] != kLeftOut && at[1] != kLeftOut) {
      const size_t owner = at[0] < at[1] ? 0 : 1;
      sides.inner.push_back({at[owner], at[1 - owner], uint32_t(2 * f + owner)});
      continue;
    }
    const size_t patch = size_t(cells.faceTag[f]) + (separates && groups ? size_t(groups->of(triangleOf(cutMesh, cells, f))) : 0);
    for (size_t side = 0; side < 2; ++side) {
      if (at[side] != kLeftOut) sides.patches[patch].sides.push_back({at[side], kLeftOut, uint32_t(2 * f + side)});
    }
  }
  detail::sortItems(sides.inner,
                    [](const Side& a, const Side& b) { return a.owner != b.owner ? a.owner < b.owner : a.neighbour < b.neighbour; });
  std::erase_if(sides.patches, [](const Patch& patch) { return patch.name == kBoxPatches[size_t(FaceTag::inner)] && patch.sides.empty(); });
  return sides;
}

class PolyMeshWriter {
 public:
  PolyMeshWriter(const FolderSink& sink, const CutMesh& cutMesh, const CellComplex& cells, const WriteOptions& options)
      : sink_(sink),
        cutMesh_(cutMesh),
        cells_(cells),
        options_(options),
        groups_(checkedGroups(options.groups, cutMesh.triangleCount)),
        polygons_(cutMesh, cells) {}

  void write() {
    numberCells();
    sides_ = sort(cutMesh_, cells_, cellNumbers_, groups_, options_.simpleCells);
    countFaces();
    writeFile("points", "vectorField", points_, [&](OutputBuffer& out) { putPoints(out); });
    writeFile("faces", "faceList", faces_, [&](OutputBuffer& out) { putFaces(out); });
    writeFile("owner", "labelList", faces_, [&](OutputBuffer& out) { putLabels(out, faces_, &Side::owner); });
    writeFile("neighbour", "labelList", innerFaces_, [&](OutputBuffer& out) { putLabels(out, innerFaces_, &Side::neighbour); });
    writeFile("boundary", "polyBoundaryMesh", sides_.patches.size(), [&](OutputBuffer& out) { putPatches(out); });
    if (zones_.size() > 1) writeFile("cellZones", "regIOobject", zones_.size(), [&](OutputBuffer& out) { putZones(out); });
  }

 private:
  void numberCells() {
    cellNumbers_.assign(cells_.cellCount(), kLeftOut);
    std::vector<std::vector<int32_t>> ofRegion;
    for (size_t c = 0; c < cells_.cellCount(); ++c) {
      const uint32_t region = cells_.cellRegion[c];
      if (!options_.regions.empty() && !options_.regions[region]) continue;
      if (!options_.untouched && c >= cells_.cutCells) continue;
      cellNumbers_[c] = int32_t(cellCount_++);
      if (ofRegion.size() <= region) ofRegion.resize(size_t(region) + 1);
      ofRegion[region].push_back(cellNumbers_[c]);
    }
    for (uint32_t r = 0; r < ofRegion.size(); ++r) {
      if (!ofRegion[r].empty()) zones_.push_back({r, std::move(ofRegion[r])});
    }
  }

  void countFaces() {
    constexpr uint32_t kUsed = 0, kUnused = ~0u;
    pointNumbers_.assign(cells_.vertexCount(), kUnused);
    sides_.forEach([&](const Side& side) {
      polygons_.forEach(side.halfFace / 2, [&](std::span<const uint32_t> polygon) {
        for (const uint32_t v : polygon) pointNumbers_[v] = kUsed;
        ++faces_;
        innerFaces_ += side.neighbour != kLeftOut;
      });
    });
    for (uint32_t& number : pointNumbers_) {
      if (number == kUsed) number = uint32_t(points_++);
    }
  }

  template <class Put>
  void writeFile(const char* name, const char* type, uint64_t count, const Put& put) {
    const Sink sink = [&, file = std::string(name)](std::string_view piece) { sink_(file, piece); };
    Meter meter(sink, options_, kFiles);
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
        {"nPoints: ", points_}, {"  nCells: ", cellCount_}, {"  nFaces: ", faces_}, {"  nInternalFaces: ", innerFaces_}};
    out.text("    note \"");
    for (const auto& [name, count] : counts) {
      out.text(name);
      out.number(count);
    }
    out.text("\";\n");
  }

  void putPoints(OutputBuffer& out) const {
    for (size_t v = 0; v < pointNumbers_.size(); ++v) {
      if (pointNumbers_[v] == ~0u) continue;
      for (size_t d = 0; d < 3; ++d) {
        out.character(d == 0 ? '(' : ' ');
        out.number(cells_.positions[3 * v + d]);
      }
      out.text(")\n");
      out.advance();
    }
  }

  void putFaces(OutputBuffer& out) const {
    sides_.forEach([&](const Side& side) {
      polygons_.forEach(side.halfFace / 2, [&](std::span<const uint32_t> polygon) {
        out.number(polygon.size());
        for (size_t i = 0; i < polygon.size(); ++i) {
          out.character(i == 0 ? '(' : ' ');
          out.number(pointNumbers_[polygon[side.halfFace % 2 ? polygon.size() - 1 - i : i]]);
        }
        out.text(")\n");
        out.advance();
      });
    });
  }

  /// Owners or neighbours of the first faces.
  void putLabels(OutputBuffer& out, uint64_t count, int32_t Side::*label) const {
    uint64_t next = 0;
    sides_.forEach([&](const Side& side) {
      polygons_.forEach(side.halfFace / 2, [&](std::span<const uint32_t>) {
        if (next++ >= count) return;
        out.number(side.*label);
        out.character('\n');
        out.advance();
      });
    });
  }

  /// Patches of groups are one group of OpenFOAM's, so that `surface` means all of them there; not if one has that name itself.
  bool isOfGroup(const Patch& patch) const {
    const auto isSurface = [](const Patch& other) { return other.name == kSurface; };
    return std::string_view(patch.type) == "wall" && std::none_of(sides_.patches.begin(), sides_.patches.end(), isSurface);
  }

  void putPatches(OutputBuffer& out) const {
    uint64_t start = innerFaces_;
    for (const Patch& patch : sides_.patches) {
      uint64_t count = 0;
      for (const Side& side : patch.sides) polygons_.forEach(side.halfFace / 2, [&](std::span<const uint32_t>) { ++count; });
      out.text(patch.name);
      out.text("\n{\n    type ");
      out.text(patch.type);
      out.text(";\n    nFaces ");
      out.number(count);
      out.text(";\n    startFace ");
      out.number(start);
      out.text(isOfGroup(patch) ? ";\n    inGroups 1(surface);\n}\n" : ";\n}\n");
      start += count;
    }
  }

  void putZones(OutputBuffer& out) const {
    for (const Zone& zone : zones_) {
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

  struct Zone {
    uint32_t region;
    std::vector<int32_t> cells;
  };
  static constexpr int kFiles = 6;
  const FolderSink& sink_;
  const CutMesh& cutMesh_;
  const CellComplex& cells_;
  const WriteOptions& options_;
  const TriangleGroups* groups_;  // null if there are none
  ComplexPolygons polygons_;
  std::vector<int32_t> cellNumbers_;    // per cell: that in the polyMesh, or kLeftOut
  std::vector<uint32_t> pointNumbers_;  // per vertex
  std::vector<Zone> zones_;
  Sides sides_;
  uint64_t cellCount_ = 0, points_ = 0, faces_ = 0, innerFaces_ = 0;
  int begunFiles_ = 0;
};

}  // namespace
}  // namespace detail

void writePolyMesh(const FolderSink& sink, const CutMesh& cutMesh, const CellComplex& cells, const WriteOptions& options) {
  const detail::Selection selection(cutMesh, options);
  detail::runCall("writing", [&] { detail::PolyMeshWriter(sink, cutMesh, cells, options).write(); });
}

}  // namespace mandoline
