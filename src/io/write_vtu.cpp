// Cut-meshes as VTK XML unstructured grids: the cells are counted first, then walked through once for each array, and only a buffer of it
// is ever kept.
#include "io/pvtu.h"
#include "io/vtu_cells.h"
#include "io/vtu_file.h"
#include "mandoline/measure.h"
#include "mesh/run_call.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace detail {
namespace {

class VtuWriter {
 public:
  static constexpr int kStages = 3;

  /// `piece` has the cut-mesh, or is null.
  VtuWriter(Meter& meter, const Selection& selection, std::vector<double> cellVolume, const CutPiece* piece)
      : meter_(meter), cutMesh_(selection.cutMesh()), piece_(piece), cellVolume_(std::move(cellVolume)), cells_(cutMesh_, selection) {
    meter_.beginStage("count", 1, cutMesh_.cellCount());
    count(selection);
  }

  void write() {
    VtuFile(meter_, pointCount(), cellCount_, "grid_cell").write(2, [&](const auto& visit) { forEachArray(visit); });
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
          constexpr size_t kBlock = 1024;  // polyhedra between two reports
          if (polyhedronSizes_.size() % kBlock == 0) meter_.report();
          if (cell.cutCell >= 0) meter_.advance();
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

  /// The vertex's number in the file, which has only vertices that are used.
  int64_t number(int64_t vertex) const {
    const int64_t cutVertices = int64_t(cutMesh_.vertexCount());
    if (numbers_.empty()) return vertex;
    return vertex < cutVertices ? int64_t(numbers_[size_t(vertex)]) : vertex - cutVertices + int64_t(usedCutVertices_);
  }

  uint64_t pointCount() const { return usedCutVertices_ + uint64_t(cells_.vertices().count()) - cutMesh_.vertexCount(); }

  /// Calls visit(a number of the array's type, name, count, components, fill) in the order of the file; fill(put) puts the numbers. The
  /// names of points and cells are VTK's.
  template <class Visit>
  void forEachArray(const Visit& visit) {
    visit(double(), "Points", pointCount(), 3, [&](const auto& put) { putPoints(put); });
    visit(int64_t(), "connectivity", connectivitySize_, 1, [&](const auto& put) { putConnectivity(put); });
    visit(int64_t(), "offsets", cellCount_, 1, [&](const auto& put) { putOffsets(put); });
    visit(uint8_t(), "types", cellCount_, 1,
          [&](const auto& put) { putPerCell([&](const VtuCell&) { put(kVtkPolyhedron); }, [&](const VtuCell&) { put(kVtkHexahedron); }); });
    if (facesSize_ > 0) {
      visit(int64_t(), "faces", facesSize_, 1, [&](const auto& put) { putFaces(put); });
      visit(int64_t(), "faceoffsets", cellCount_, 1, [&](const auto& put) {
        size_t polyhedron = 0;
        int64_t offset = 0;
        putPerCell([&](const VtuCell&) { put(offset += int64_t(polyhedronSizes_[polyhedron++].faces)); }, [&](const VtuCell&) { put(-1); });
      });
    }
    visit(int32_t(), "grid_cell", cellCount_, 3, [&](const auto& put) {
      putAlike([&](const VtuCell& cell) {
        for (size_t d = 0; d < 3; ++d) put(cell.gridCell[d] + (piece_ ? piece_->first[d] : 0));
      });
    });
    if (!piece_)
      visit(int32_t(), "region", cellCount_, 1, [&](const auto& put) { putAlike([&](const VtuCell& cell) { put(cell.region); }); });
    forEachRegionArray(cutMesh_, [&]<class Number>(const char* name, const std::vector<Number>& numbers) {
      visit(Number(), name, cellCount_, 1, [&](const auto& put) { putAlike([&](const VtuCell& cell) { put(numbers[cell.region]); }); });
    });
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

  Meter& meter_;
  const CutMesh& cutMesh_;
  const CutPiece* piece_;
  std::vector<double> cellVolume_;  // per cut-cell
  VtuCells cells_;
  uint64_t cellCount_ = 0, connectivitySize_ = 0, facesSize_ = 0, usedCutVertices_ = 0;
  std::vector<PolyhedronSize> polyhedronSizes_;
  std::vector<uint32_t> numbers_;  // per cut-vertex, if not all are used
};

/// Measuring is one stage of writing.
std::vector<double> cellVolumes(Meter& meter, const MeshView& mesh, const CutMesh& cutMesh, const RunOptions& options) {
  meter.beginStage("measure", 0, 1);
  RunOptions measuring{options.threads, {}};
  if (options.progress) {
    measuring.progress = [&](const Progress&) {
      meter.report();
      return true;
    };
  }
  return measure(mesh, cutMesh, measuring).cellVolume;
}

void write(const Sink& sink, const MeshView& mesh, const CutMesh& cutMesh, const CutPiece* piece, const WriteOptions& options) {
  operators::refuseRefined(cutMesh);
  const Selection selection(cutMesh, options);
  runCall("writing", [&] {
    Meter meter(sink, options, VtuWriter::kStages);
    VtuWriter(meter, selection, cellVolumes(meter, mesh, cutMesh, options), piece).write();
  });
}

}  // namespace

void writeVtuPiece(const Sink& sink, const CutMesh& cutMesh, std::vector<double> cellVolume, const WriteOptions& options) {
  const Selection selection(cutMesh, options);
  runCall("writing", [&] {
    Meter meter(sink, options, VtuWriter::kStages);
    VtuWriter(meter, selection, std::move(cellVolume), nullptr).write();
  });
}

}  // namespace detail

void writeVtu(const Sink& sink, const MeshView& mesh, const CutMesh& cutMesh, const WriteOptions& options) {
  detail::write(sink, mesh, cutMesh, nullptr, options);
}

void writeVtu(const Sink& sink, const CutPiece& piece, const WriteOptions& options) {
  detail::write(sink, piece.mesh, piece.cutMesh, &piece, options);
}

}  // namespace mandoline
