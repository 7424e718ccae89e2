// VTK XML unstructured grids, with the arrays appended as raw bytes (which VTK, ParaView and meshio read).
//
// The file has one array after the other, each with its size before it: the cells are counted first, then walked through once for each
// array, and only a buffer of it is ever kept.
#include <optional>

#include "io/output_buffer.h"
#include "io/vtu_cells.h"
#include "mandoline/measure.h"
#include "mesh/read/scalar.h"

namespace mandoline {
namespace detail {
namespace {

constexpr uint8_t kHexahedron = 12, kPolyhedron = 42;  // VTK's cell types

/// Numbers as bytes for a sink, gathered in a buffer. Whoever uses it calls flush() at the end.
template <class Scalar>
class ArrayBuffer {
 public:
  explicit ArrayBuffer(const Sink& sink) : sink_(sink) { buffer_.reserve(kCapacity); }

  void put(Scalar value) {
    buffer_.push_back(value);
    if (buffer_.size() == kCapacity) flush();
  }
  void flush() {
    sink_({reinterpret_cast<const char*>(buffer_.data()), buffer_.size() * sizeof(Scalar)});
    buffer_.clear();
  }

 private:
  static constexpr size_t kCapacity = size_t(1) << 15;
  const Sink& sink_;
  std::vector<Scalar> buffer_;
};

class VtuWriter {
 public:
  VtuWriter(const Sink& sink, const MeshView& mesh, const Selection& selection)
      : sink_(sink),
        out_(sink),
        cutMesh_(selection.cutMesh()),
        cellVolume_(measure(mesh, cutMesh_).cellVolume),
        cells_(cutMesh_, selection) {
    count(selection);
  }

  void write() {
    writeHead();
    forEachArray([&](auto scalar, const char* name, uint64_t count, int components, const auto& fill) {
      using Scalar = decltype(scalar);
      (void)name;
      const uint64_t size = count * uint64_t(components) * sizeof(Scalar);
      sink_({reinterpret_cast<const char*>(&size), sizeof size});
      ArrayBuffer<Scalar> buffer(sink_);
      fill([&](auto value) { buffer.put(Scalar(value)); });
      buffer.flush();
    });
    sink_("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  void count(const Selection& selection) {
    const size_t cutVertices = cutMesh_.vertexCount();
    std::vector<uint8_t> used(selection.all() ? 0 : cutVertices, 0);
    const auto use = [&](int64_t v) {
      if (size_t(v) < used.size()) used[size_t(v)] = 1;
    };
    cells_.forEach(
        [&](const VtuCell& cell) {
          const Polyhedron& polyhedron = cells_.polyhedron(cell);
          polyhedronSizes_.push_back(
              {uint32_t(polyhedron.vertices.size()), 1 + polyhedron.faceSizes.size() + polyhedron.faceVertices.size()});
          connectivitySize_ += polyhedron.vertices.size();
          facesSize_ += polyhedronSizes_.back().faces;
          std::for_each(polyhedron.vertices.begin(), polyhedron.vertices.end(), use);
          ++cellCount_;
        },
        [&](const VtuCell& first, int32_t count) {
          connectivitySize_ += 8 * uint64_t(count);
          cellCount_ += uint64_t(count);
          if (!used.empty()) cells_.forEachCorner(first, count, use);
        });
    usedCutVertices_ = cutVertices;
    if (used.empty()) return;
    usedCutVertices_ = 0;
    numbers_.resize(cutVertices);
    for (size_t v = 0; v < cutVertices; ++v) {
      numbers_[v] = used[v] ? uint32_t(usedCutVertices_++) : kUnused;
    }
  }

  /// The vertex's number in the file, which has those only that are used.
  int64_t number(int64_t vertex) const {
    const int64_t cutVertices = int64_t(cutMesh_.vertexCount());
    if (numbers_.empty()) return vertex;
    return vertex < cutVertices ? int64_t(numbers_[size_t(vertex)]) : vertex - cutVertices + int64_t(usedCutVertices_);
  }

  void writeHead() {
    out_.text("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"");
    out_.text(kNativeOrder == ByteOrder::little ? "LittleEndian" : "BigEndian");
    out_.text("\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"");
    out_.number(pointCount());
    out_.text("\" NumberOfCells=\"");
    out_.number(cellCount_);
    out_.text("\">\n<Points>\n");
    uint64_t offset = 0;
    forEachArray([&](auto scalar, std::string_view name, uint64_t count, int components, const auto&) {
      if (name == "connectivity") out_.text("</Points>\n<Cells>\n");
      if (name == "grid_cell") out_.text("</Cells>\n<CellData>\n");
      out_.text("<DataArray type=\"");
      out_.text(typeName(scalar));
      out_.text("\" Name=\"");
      out_.text(name);
      out_.text("\" NumberOfComponents=\"");
      out_.number(components);
      out_.text("\" format=\"appended\" offset=\"");
      out_.number(offset);
      out_.text("\"/>\n");
      offset += sizeof(uint64_t) + count * uint64_t(components) * sizeof scalar;
    });
    out_.text("</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    out_.flush();
  }

  static const char* typeName(double) { return "Float64"; }
  static const char* typeName(int64_t) { return "Int64"; }
  static const char* typeName(int32_t) { return "Int32"; }
  static const char* typeName(uint8_t) { return "UInt8"; }

  uint64_t pointCount() const { return usedCutVertices_ + uint64_t(cells_.vertices().count()) - cutMesh_.vertexCount(); }

  /// Calls visit(a number of the array's type, name, count, components, fill) in the order of the file; fill(put) puts the numbers. The
  /// names of points and cells are VTK's.
  template <class Visit>
  void forEachArray(const Visit& visit) {
    visit(double(), "Points", pointCount(), 3, [&](const auto& put) { putPoints(put); });
    visit(int64_t(), "connectivity", connectivitySize_, 1, [&](const auto& put) { putConnectivity(put); });
    visit(int64_t(), "offsets", cellCount_, 1, [&](const auto& put) { putOffsets(put); });
    visit(uint8_t(), "types", cellCount_, 1,
          [&](const auto& put) { putPerCell([&](const VtuCell&) { put(kPolyhedron); }, [&](const VtuCell&) { put(kHexahedron); }); });
    if (facesSize_ > 0) {
      visit(int64_t(), "faces", facesSize_, 1, [&](const auto& put) { putFaces(put); });
      visit(int64_t(), "faceoffsets", cellCount_, 1, [&](const auto& put) {
        size_t polyhedron = 0;
        int64_t offset = 0;
        putPerCell([&](const VtuCell&) { put(offset += int64_t(polyhedronSizes_[polyhedron++].faces)); }, [&](const VtuCell&) { put(-1); });
      });
    }
    visit(int32_t(), "grid_cell", cellCount_, 3,
          [&](const auto& put) { putAlike([&](const VtuCell& cell) { std::for_each(cell.gridCell.begin(), cell.gridCell.end(), put); }); });
    visit(int32_t(), "region", cellCount_, 1, [&](const auto& put) { putAlike([&](const VtuCell& cell) { put(cell.region); }); });
    if (cutMesh_.hasWinding) {
      visit(int32_t(), "winding", cellCount_, 1,
            [&](const auto& put) { putAlike([&](const VtuCell& cell) { put(cutMesh_.regionWinding[cell.region]); }); });
    }
    visit(double(), "volume", cellCount_, 1, [&](const auto& put) { putAlike([&](const VtuCell& cell) { put(volume(cell)); }); });
  }

  template <class OnPolyhedron, class OnHexahedron>
  void putPerCell(const OnPolyhedron& onPolyhedron, const OnHexahedron& onHexahedron) const {
    cells_.forEach(onPolyhedron, [&](VtuCell cell, int32_t count) {
      for (; count > 0; --count, ++cell.gridCell[0]) onHexahedron(cell);
    });
  }
  template <class OnCell>
  void putAlike(const OnCell& onCell) const {
    putPerCell(onCell, onCell);
  }

  template <class Put>
  void putPoints(const Put& put) const {
    for (size_t v = 0; v < cutMesh_.vertexCount(); ++v) {
      if (!numbers_.empty() && numbers_[v] == kUnused) continue;
      for (size_t d = 0; d < 3; ++d) put(cutMesh_.positions[3 * v + d]);
    }
    cells_.vertices().forEachAdded([&](double x, double y, double z) {
      put(x);
      put(y);
      put(z);
    });
  }

  template <class Put>
  void putConnectivity(const Put& put) {
    cells_.forEach(
        [&](const VtuCell& cell) {
          for (const int64_t v : cells_.polyhedron(cell).vertices) put(number(v));
        },
        [&](const VtuCell& first, int32_t count) { cells_.forEachCorner(first, count, [&](int64_t v) { put(number(v)); }); });
  }

  template <class Put>
  void putOffsets(const Put& put) const {
    size_t polyhedron = 0;
    int64_t offset = 0;
    putPerCell([&](const VtuCell&) { put(offset += polyhedronSizes_[polyhedron++].vertices); }, [&](const VtuCell&) { put(offset += 8); });
  }

  template <class Put>
  void putFaces(const Put& put) {
    const auto putPolyhedron = [&](const VtuCell& cell) {
      const Polyhedron& polyhedron = cells_.polyhedron(cell);
      put(polyhedron.faceSizes.size());
      auto vertex = polyhedron.faceVertices.begin();
      for (size_t size : polyhedron.faceSizes) {
        put(size);
        for (; size > 0; --size) put(number(*vertex++));
      }
    };
    cells_.forEach(putPolyhedron, [](const VtuCell&, int32_t) {});
  }

  double volume(const VtuCell& cell) const {
    if (cell.cutCell >= 0) return cellVolume_[size_t(cell.cutCell)];
    double volume = 1;
    for (size_t d = 0; d < 3; ++d) {
      const double* plane = cutMesh_.grid.planes[d].data() + cell.gridCell[d];
      volume *= plane[1] - plane[0];
    }
    return volume;
  }

  static constexpr uint32_t kUnused = ~0u;
  struct PolyhedronSize {
    uint32_t vertices;
    uint64_t faces;  // in numbers of the array "faces"
  };

  const Sink& sink_;
  OutputBuffer out_;
  const CutMesh& cutMesh_;
  std::vector<double> cellVolume_;  // per cut-cell
  VtuCells cells_;
  uint64_t cellCount_ = 0, connectivitySize_ = 0, facesSize_ = 0, usedCutVertices_ = 0;
  std::vector<PolyhedronSize> polyhedronSizes_;
  std::vector<uint32_t> numbers_;  // per cut-vertex, if not all are used
};

}  // namespace
}  // namespace detail

void writeVtu(const Sink& sink, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options) {
  detail::VtuWriter(sink, mesh, detail::Selection(cutMesh, options)).write();
}

}  // namespace mandoline
