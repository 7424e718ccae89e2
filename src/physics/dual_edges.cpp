#include "physics/dual_edges.h"

#include <algorithm>
#include <cmath>

#include "base/large_array.h"
#include "base/parallel.h"
#include "physics/node_loops.h"

namespace mandoline::physics {
namespace {

class Finder {
 public:
  Finder(const CellComplex& cells, DualPoints dualPoints, std::vector<double> coefficients)
      : cells_(cells), points_(pointsOf(cells, dualPoints)) {
    result_.coefficients = std::move(coefficients);
  }

  /// Counts, makes room and fills.
  DualEdges run(detail::Monitor& monitor) {
    struct Part {
      size_t edges = 0, faces = 0;
      std::vector<uint32_t> besides;
    };
    std::vector<Part> parts = detail::forChunks<Part>(cells_.faceCount(), monitor, [&](Part& part, size_t begin, size_t end) {
      forEdges(begin, end, part.besides, [&](size_t, std::span<const uint32_t> faces) { ++part.edges, part.faces += faces.size(); });
    });
    size_t edges = 0, faces = 0;
    for (Part& part : parts) {
      std::swap(edges, part.edges), std::swap(faces, part.faces);  // where it begins, and how much it adds
      edges += part.edges, faces += part.faces;
    }
    detail::makeLargeOnThreads(result_.edges, edges, monitor.threads());
    detail::makeLargeOnThreads(result_.faces.items, faces, monitor.threads());
    result_.faces.offsets.clear();
    detail::makeLargeOnThreads(result_.faces.offsets, edges + 1, monitor.threads());
    detail::runChunks(
        cells_.faceCount(), parts.size(), monitor,
        [&](size_t chunk, size_t begin, size_t end) {
          Part& part = parts[chunk];
          forEdges(begin, end, part.besides, [&](size_t side, std::span<const uint32_t> ofEdge) {
            std::copy(ofEdge.begin(), ofEdge.end(), result_.faces.items.begin() + ptrdiff_t(part.faces));
            part.faces += ofEdge.size();
            result_.edges[part.edges++] = edgeOf(side, ofEdge);
            result_.faces.offsets[part.edges] = uint32_t(part.faces);
          });
        },
        kBlock);
    return std::move(result_);
  }

 private:
  /// f(side, faces) for each dual edge whose first face is one of those. `besides` is room.
  template <class F>
  void forEdges(size_t begin, size_t end, std::vector<uint32_t>& besides, const F& f) const {
    for (auto face = uint32_t(begin); face < end; ++face) {
      if (!isInner(cells_, face)) continue;
      const size_t side = level(face, 1) > level(face, 0) ? 1 : 0;  // that of the one cell
      if (level(face, side) == level(face, 1 - side)) {
        f(side, std::span(&face, 1));
      } else {
        findBesides(face, side, besides);
        if (besides.front() == face) f(side, besides);
      }
    }
  }

  uint8_t level(size_t f, size_t side) const { return cells_.cellLevel[cell(f, side)]; }
  size_t cell(size_t f, size_t side) const { return size_t(cells_.faceCells[2 * f + side]); }

  /// Finds the faces on the side of the larger cell that face f is on.
  void findBesides(size_t f, size_t side, std::vector<uint32_t>& besides) const {
    besides.clear();
    const size_t axis = axisOf(f);
    const double plane = placeOf(f, axis);
    for (const uint32_t h : cells_.halfFaces(cell(f, side))) {
      const size_t other = h / 2;
      if (h % 2 == side && isInner(cells_, other) && level(other, 1 - side) < level(other, side) && axisOf(other) == axis &&
          placeOf(other, axis) == plane)
        besides.push_back(uint32_t(other));
    }
  }
  size_t axisOf(size_t f) const {
    const double* n = &cells_.faceNormal[3 * f];
    return n[0] != 0 ? 0 : n[1] != 0 ? 1 : 2;
  }
  /// Merged cells have several sides across one axis.
  double placeOf(size_t f, size_t axis) const { return cells_.positions[3 * size_t(cells_.loops(f)[0][0]) + axis]; }

  DualEdge edgeOf(size_t side, std::span<const uint32_t> faces) const {
    DualEdge edge{uint32_t(cell(faces[0], side)), side == 0 ? 1.0 : -1.0, 0, 0, 0};
    double sum = 0, largest = 0;
    for (const uint32_t face : faces) {
      const double flow = result_.flowOf(cells_, face), length = distance(face);
      edge.area += cells_.faceArea[face];
      edge.flow += flow;
      sum += flow * length;
      largest = std::max(largest, length);
    }
    edge.distance = edge.flow > 0 ? std::min(sum / edge.flow, largest) : largest;
    return edge;
  }

  /// Along the normal. Inner faces lie in axial planes between the cells' dual points. Centroids of slivers may round onto the plane;
  /// they keep a billionth of their grid cells' distance. Merged cells may lie around each other: with them it is at least a twentieth of
  /// the distance itself; or that of their centroids where both have the same dual point.
  double distance(size_t f) const {
    if (cells_.cellMemberOffsets.empty()) return std::max(along(points_, f).normal, 1e-9 * along(cells_.cellCentre, f).normal);
    const Along dual = along(points_, f), other = dual.all > 0 ? dual : along(cells_.cellCentroid, f);
    return other.all > 0 ? std::max(other.normal, other.all / 20) : 1e-9 * sizeOf(cell(f, 0));
  }
  double sizeOf(size_t c) const {
    double largest = 0;
    for (const uint32_t h : cells_.halfFaces(c)) largest = std::max(largest, cells_.faceArea[h / 2]);
    return std::sqrt(largest);
  }

  /// From the point of one cell at a face to that of the other: how far along the normal, and in all.
  struct Along {
    double normal, all;
  };
  Along along(const std::vector<double>& points, size_t f) const {
    double sum = 0, square = 0;
    for (size_t d = 0; d < 3; ++d) {
      const double difference = points[3 * cell(f, 1) + d] - points[3 * cell(f, 0) + d];
      sum += cells_.faceNormal[3 * f + d] * difference;
      square += difference * difference;
    }
    return {sum, std::sqrt(square)};
  }

  const CellComplex& cells_;
  const std::vector<double>& points_;
  DualEdges result_;
};

}  // namespace

DualEdges dualEdges(const CellComplex& cells, DualPoints dualPoints, std::vector<double> coefficients, unsigned threads) {
  detail::Monitor monitor(threads);
  return Finder(cells, dualPoints, std::move(coefficients)).run(monitor);
}

}  // namespace mandoline::physics
