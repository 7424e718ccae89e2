// VTK XML unstructured grids, with the arrays appended as raw bytes (which VTK, ParaView and meshio read).
//
// Cut-cells are polyhedra. Untouched grid cells are hexahedra, except that one with a cut-vertex inside of one of its grid-edges is a
// polyhedron too: its faces then have that vertex, as those of its neighbours do, so that all cells match face by face.
#include "io/grid_vertices.h"
#include "io/output_buffer.h"
#include "mandoline/measure.h"
#include "mesh/read/polygons.h"
#include "mesh/read/scalar.h"

namespace mandoline {
namespace detail {
namespace {

constexpr uint8_t kHexahedron = 12, kPolyhedron = 42;  // VTK's cell types

/// The arrays of the file; the names are VTK's.
struct UnstructuredGrid {
  std::vector<int64_t> connectivity, offsets, faces, faceoffsets;
  std::vector<uint8_t> types;
  std::vector<int32_t> gridCell, region, winding;
  std::vector<double> volume;
};

class VtuBuilder {
 public:
  explicit VtuBuilder(const CutMesh& cutMesh) : cutMesh_(cutMesh), vertices_(cutMesh) {}

  void addCutCells(const MeshView& mesh) {
    const Polygons polygons(cutMesh_);
    for (size_t c = 0; c < cutMesh_.cellCount(); ++c) {
      beginPolyhedron();
      for (const uint32_t h : cutMesh_.cell(c)) {
        polygons.forEach(h / 2, [&](std::span<const uint32_t> polygon) { addFace(polygon, h % 2 != 0); });
      }
      endPolyhedron();
      describe({cutMesh_.cellGridCell[3 * c], cutMesh_.cellGridCell[3 * c + 1], cutMesh_.cellGridCell[3 * c + 2]}, cutMesh_.cellRegion[c]);
    }
    result_.volume = measure(mesh, cutMesh_).cellVolume;
  }

  void addUntouchedCells() {
    const int32_t rowsPerLayer = int32_t(cutMesh_.grid.cells(1));
    for (size_t row = 0; row + 1 < cutMesh_.rowRunOffsets.size(); ++row) {
      for (uint32_t run = cutMesh_.rowRunOffsets[row]; run < cutMesh_.rowRunOffsets[row + 1]; ++run) {
        for (int32_t i = cutMesh_.runBegin[run]; i < cutMesh_.runEnd[run]; ++i) {
          addUntouchedCell({i, int32_t(row) % rowsPerLayer, int32_t(row) / rowsPerLayer}, cutMesh_.runRegion[run]);
        }
      }
    }
  }

  const UnstructuredGrid& result() const { return result_; }
  const std::vector<double>& positions() const { return vertices_.positions(); }

 private:
  using Index = GridVertices::Index;

  static Index moved(Index cell, int axis, int by) {
    cell[axis] += by;
    return cell;
  }

  void addUntouchedCell(const Index& cell, uint32_t region) {
    if (hasDividedEdge(cell)) {
      addGridPolyhedron(cell);
    } else {
      addHexahedron(cell);
    }
    describe(cell, region);
    double volume = 1;
    for (int d = 0; d < 3; ++d) volume *= cutMesh_.grid.planes[d][cell[d] + 1] - cutMesh_.grid.planes[d][cell[d]];
    result_.volume.push_back(volume);
  }

  bool hasDividedEdge(const Index& cell) const {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 4; ++side) {
        if (vertices_.divided(moved(moved(cell, (axis + 1) % 3, side & 1), (axis + 2) % 3, side >> 1), axis)) return true;
      }
    }
    return false;
  }

  void addHexahedron(const Index& cell) {
    for (int k = 0; k < 2; ++k) {
      for (const auto& [i, j] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
        result_.connectivity.push_back(vertices_.corner({cell[0] + i, cell[1] + j, cell[2] + k}));
      }
    }
    endCell(kHexahedron, -1);
  }

  void addGridPolyhedron(const Index& cell) {
    beginPolyhedron();
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int side = 0; side < 2; ++side) {
        const Index lowest = moved(cell, axis, side);
        std::vector<uint32_t> loop;  // counter-clockwise about +axis
        vertices_.appendEdge(lowest, u, true, loop);
        vertices_.appendEdge(moved(lowest, u, 1), v, true, loop);
        vertices_.appendEdge(moved(lowest, v, 1), u, false, loop);
        vertices_.appendEdge(lowest, v, false, loop);
        addFace(loop, side == 0);
      }
    }
    endPolyhedron();
  }

  void beginPolyhedron() {
    faceCountAt_ = result_.faces.size();
    result_.faces.push_back(0);
  }
  /// The polygon must run counter-clockwise as seen from outside of the cell, once reversed if told so.
  void addFace(std::span<const uint32_t> polygon, bool reversed) {
    ++result_.faces[faceCountAt_];
    result_.faces.push_back(int64_t(polygon.size()));
    for (size_t i = 0; i < polygon.size(); ++i) {
      const uint32_t v = polygon[reversed ? polygon.size() - 1 - i : i];
      result_.faces.push_back(v);
      if (v >= lastCell_.size()) lastCell_.resize(size_t(v) + v / 2 + 1, kNoCell);
      if (lastCell_[v] == result_.types.size()) continue;
      lastCell_[v] = result_.types.size();
      result_.connectivity.push_back(v);
    }
  }
  void endPolyhedron() { endCell(kPolyhedron, int64_t(result_.faces.size())); }

  void endCell(uint8_t type, int64_t faceOffset) {
    result_.types.push_back(type);
    result_.offsets.push_back(int64_t(result_.connectivity.size()));
    result_.faceoffsets.push_back(faceOffset);
  }
  void describe(const Index& cell, uint32_t region) {
    result_.gridCell.insert(result_.gridCell.end(), cell.begin(), cell.end());
    result_.region.push_back(int32_t(region));
    if (cutMesh_.hasWinding) result_.winding.push_back(cutMesh_.regionWinding[region]);
  }

  static constexpr size_t kNoCell = ~size_t(0);

  const CutMesh& cutMesh_;
  GridVertices vertices_;
  UnstructuredGrid result_;
  size_t faceCountAt_ = 0;        // place of the face count of the polyhedron being made
  std::vector<size_t> lastCell_;  // per vertex: the cell whose connectivity has it already
};

class VtuWriter {
 public:
  explicit VtuWriter(const Sink& sink) : sink_(sink), out_(sink) {}

  void write(const UnstructuredGrid& grid, const std::vector<double>& positions, bool hasWinding) {
    out_.text("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"");
    out_.text(kNativeOrder == ByteOrder::little ? "LittleEndian" : "BigEndian");
    out_.text("\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"");
    out_.number(positions.size() / 3);
    out_.text("\" NumberOfCells=\"");
    out_.number(grid.types.size());
    out_.text("\">\n<Points>\n");
    array("Float64", "Points", positions, 3);
    out_.text("</Points>\n<Cells>\n");
    array("Int64", "connectivity", grid.connectivity);
    array("Int64", "offsets", grid.offsets);
    array("UInt8", "types", grid.types);
    if (!grid.faces.empty()) {
      array("Int64", "faces", grid.faces);
      array("Int64", "faceoffsets", grid.faceoffsets);
    }
    out_.text("</Cells>\n<CellData>\n");
    array("Int32", "grid_cell", grid.gridCell, 3);
    array("Int32", "region", grid.region);
    if (hasWinding) array("Int32", "winding", grid.winding);
    array("Float64", "volume", grid.volume);
    out_.text("</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    out_.flush();
    for (const std::string_view bytes : appended_) {
      const uint64_t size = bytes.size();
      sink_({reinterpret_cast<const char*>(&size), sizeof size});
      sink_(bytes);
    }
    sink_("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  template <class Scalar>
  void array(const char* type, const char* name, const std::vector<Scalar>& values, int components = 1) {
    out_.text("<DataArray type=\"");
    out_.text(type);
    out_.text("\" Name=\"");
    out_.text(name);
    out_.text("\" NumberOfComponents=\"");
    out_.number(components);
    out_.text("\" format=\"appended\" offset=\"");
    out_.number(offset_);
    out_.text("\"/>\n");
    appended_.push_back({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Scalar)});
    offset_ += sizeof(uint64_t) + appended_.back().size();
  }

  const Sink& sink_;
  OutputBuffer out_;
  std::vector<std::string_view> appended_;
  uint64_t offset_ = 0;
};

}  // namespace
}  // namespace detail

void writeVtu(const Sink& sink, const MeshView& mesh, const CutMesh& cutMesh) {
  detail::VtuBuilder builder(cutMesh);
  builder.addCutCells(mesh);
  builder.addUntouchedCells();
  detail::VtuWriter(sink).write(builder.result(), builder.positions(), cutMesh.hasWinding);
}

}  // namespace mandoline
