#include "io/flat_polygons.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "operators/measure/vector.h"

namespace mandoline::detail {
namespace {

/// What several roundings may add up to, where the largest coordinate is between a half and 1.
constexpr double kWidth = 0x1p-48;

/// How many times as far apart as a flat polygon is wide its vertices are at least. Then each but the ends of its longest edge is nearer
/// to both of these than they are to each other.
constexpr double kApart = 4;

/// How far from a centroid a wall is moved, of the largest coordinate. Nearer than half of it is too near: rounding is less.
constexpr double kFromCentroid = 0x1p-44;

double largestCoordinate(const CellComplex& cells) {
  double largest = 0;
  for (const double x : cells.positions) largest = std::max(largest, std::fabs(x));
  return largest;
}

class Collapser {
 public:
  Collapser(const CellComplex& cells, ComplexPolygons& polygons) : cells_(cells), polygons_(polygons) {
    int exponent = 0;
    std::frexp(largestCoordinate(cells), &exponent);
    scale_ = std::ldexp(1, std::min(-exponent, 1000));
  }

  /// Ends, since vertices become fewer, or edges shorter.
  void run() {
    std::vector<uint32_t> faces(cells_.faceCount());
    for (uint32_t f = 0; f < faces.size(); ++f) faces[f] = f;
    while (findChanges(faces)) faces = change();
  }

 private:
  using Vector = measuring::Vector<double>;
  using Edge = std::pair<uint32_t, uint32_t>;  ///< the lower vertex first
  static Edge edgeOf(uint32_t a, uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

  Vector vectorTo(uint32_t v, uint32_t from) const {
    Vector vector;
    for (size_t d = 0; d < 3; ++d) vector[d] = scale_ * (cells_.positions[3 * size_t(v) + d] - cells_.positions[3 * size_t(from) + d]);
    return vector;
  }
  double squareOf(uint32_t a, uint32_t b) const {
    const Vector vector = vectorTo(b, a);
    return measuring::dot(vector, vector);
  }

  /// What becomes of the flat polygons of some faces: vertices that become one, or else edges that get a vertex. Whether there is anything.
  bool findChanges(std::span<const uint32_t> faces) {
    same_.clear();
    added_.clear();
    flat_.clear();
    for (const uint32_t f : faces) {
      polygons_.forEach(f, [&](std::span<const uint32_t> polygon) {
        if (!isFlat(polygon)) return;
        if (flat_.empty() || flat_.back() != f) flat_.push_back(f);
        if (!joinVertices(polygon)) addVertex(polygon);
      });
    }
    if (!same_.empty()) added_.clear();
    return !same_.empty() || !added_.empty();
  }

  /// Whether the area of its triangles is not more than that of a strip along the longest edge.
  bool isFlat(std::span<const uint32_t> polygon) const {
    constexpr double kLongest = 12;  // square of the diagonal, where coordinates are from -1 to 1
    if (squareOfTwice(polygon, 1) > 4 * kWidth * kWidth * kLongest) return false;
    double longest = 0, area = 0;
    for (size_t i = 0; i < polygon.size(); ++i) longest = std::max(longest, squareOf(polygon[i], polygon[(i + 1) % polygon.size()]));
    for (size_t i = 1; i + 1 < polygon.size(); ++i) area += std::sqrt(squareOfTwice(polygon, i));
    return area * area <= 4 * kWidth * kWidth * longest;
  }

  /// Of the area of a triangle at the first vertex.
  double squareOfTwice(std::span<const uint32_t> polygon, size_t i) const {
    const Vector normal = measuring::cross(vectorTo(polygon[i], polygon[0]), vectorTo(polygon[i + 1], polygon[0]));
    return measuring::dot(normal, normal);
  }

  bool joinVertices(std::span<const uint32_t> polygon) {
    bool any = false;
    for (size_t i = 0; i < polygon.size(); ++i) {
      for (size_t j = i + 1; j < polygon.size(); ++j) {
        if (squareOf(polygon[i], polygon[j]) > kApart * kApart * kWidth * kWidth) continue;
        const Edge roots = edgeOf(root(polygon[i]), root(polygon[j]));
        if (roots.first != roots.second) same_[roots.second] = roots.first;
        any = true;
      }
    }
    return any;
  }

  uint32_t root(uint32_t v) const {
    for (auto lower = same_.find(v); lower != same_.end(); lower = same_.find(v)) v = lower->second;
    return v;
  }

  /// To the longest edge, the vertex that is nearest to its middle.
  void addVertex(std::span<const uint32_t> polygon) {
    double longest = -1;
    Edge edge;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Edge next = edgeOf(polygon[i], polygon[(i + 1) % polygon.size()]);
      const double length = squareOf(next.first, next.second);
      if (length > longest || (length == longest && next < edge)) longest = length, edge = next;
    }
    double least = longest;
    uint32_t middle = kNone;
    for (const uint32_t v : polygon) {
      const double farther = std::max(squareOf(edge.first, v), squareOf(edge.second, v));
      if (farther < least) least = farther, middle = v;
    }
    if (middle != kNone) added_.emplace(edge, middle);
  }

  /// All faces; gives those that changed or have flat polygons, ascending.
  std::vector<uint32_t> change() {
    std::vector<uint8_t> isNear(cells_.vertexCount());
    for (const auto& [high, low] : same_) isNear[high] = 1;
    for (const auto& [edge, middle] : added_) isNear[edge.first] = 1;
    std::vector<uint32_t> changed;
    for (uint32_t f = 0; f < cells_.faceCount(); ++f) {
      if (changeFace(f, isNear)) changed.push_back(f);
    }
    std::vector<uint32_t> all;
    std::set_union(changed.begin(), changed.end(), flat_.begin(), flat_.end(), std::back_inserter(all));
    return all;
  }

  bool changeFace(uint32_t face, const std::vector<uint8_t>& isNear) {
    bool any = false;
    polygons_.forEach(face, [&](std::span<const uint32_t> polygon) {
      any |= std::any_of(polygon.begin(), polygon.end(), [&](uint32_t v) { return isNear[v] != 0; });
    });
    if (!any) return false;
    ComplexPolygons::Replacement now;
    bool isChanged = false;
    polygons_.forEach(face, [&](std::span<const uint32_t> polygon) {
      std::vector<uint32_t> loop;
      for (size_t i = 0; i < polygon.size(); ++i) {
        loop.push_back(root(polygon[i]));
        const auto added = added_.find(edgeOf(polygon[i], polygon[(i + 1) % polygon.size()]));
        if (added != added_.end()) loop.push_back(added->second);
      }
      isChanged |= !std::equal(loop.begin(), loop.end(), polygon.begin(), polygon.end());
      addSimpleLoops(loop, now);
    });
    if (isChanged) polygons_.replace(face, std::move(now));
    return isChanged;
  }

  /// Those that a loop has between the same vertex and itself; edges that it goes back cancel.
  static void addSimpleLoops(std::span<const uint32_t> loop, ComplexPolygons::Replacement& loops) {
    std::vector<uint32_t> path;
    const auto add = [&](auto begin) {
      if (path.end() - begin >= 3) loops.emplace_back(begin, path.end());
      path.erase(begin, path.end());
    };
    for (const uint32_t v : loop) {
      add(std::find(path.begin(), path.end(), v));
      path.push_back(v);
    }
    add(path.begin());
  }

  static constexpr uint32_t kNone = ~0u;
  const CellComplex& cells_;
  ComplexPolygons& polygons_;
  double scale_ = 1;
  std::map<uint32_t, uint32_t> same_;  // per vertex that becomes another: a lower one
  std::map<Edge, uint32_t> added_;     // per edge: the vertex that it gets
  std::vector<uint32_t> flat_;         // faces, ascending
};

}  // namespace

void collapseFlatPolygons(const CellComplex& cells, ComplexPolygons& polygons) { Collapser(cells, polygons).run(); }

MovedVertices movedOffCentroids(const CellComplex& cells, const ComplexPolygons& polygons) {
  const double far = kFromCentroid * largestCoordinate(cells);
  MovedVertices moved;
  const auto alongNormal = [&](size_t face, const double* a, const double* b) {
    double sum = 0;
    for (size_t d = 0; d < 3; ++d) sum += cells.faceNormal[3 * face + d] * (a[d] - b[d]);
    return sum;
  };
  for (size_t f = 0; f < cells.faceCount(); ++f) {
    if (cells.faceTag[f] != FaceTag::surface) continue;
    const auto isNear = [&](int32_t cell) {
      return cell >= 0 && std::fabs(alongNormal(f, &cells.faceCentroid[3 * f], &cells.cellCentroid[3 * size_t(cell)])) <= far / 2;
    };
    if (!isNear(cells.faceCells[2 * f]) && !isNear(cells.faceCells[2 * f + 1])) continue;
    const double* const normal = &cells.faceNormal[3 * f];
    const size_t axis = size_t(measuring::largestAxis({normal[0], normal[1], normal[2]}));
    const double shift = normal[axis] < 0 ? -far : far;  // the same way, however those of one plane are oriented
    polygons.forEach(f, [&](std::span<const uint32_t> polygon) {
      for (const uint32_t v : polygon) {
        const double* const before = &cells.positions[3 * size_t(v)];
        std::array<double, 3>& now = moved.try_emplace(v, std::array{before[0], before[1], before[2]}).first->second;
        if (std::fabs(alongNormal(f, now.data(), before)) > far / 2) continue;
        for (size_t d = 0; d < 3; ++d) now[d] += shift * normal[d];
      }
    });
  }
  return moved;
}

bool isEnclosedByWalls(const CellComplex& cells, const ComplexPolygons& polygons, size_t cell) {
  const auto sides = cells.halfFaces(cell);
  return std::all_of(sides.begin(), sides.end(),
                     [&](uint32_t h) { return cells.faceTag[h / 2] == FaceTag::surface || polygons.isEmpty(h / 2); });
}

}  // namespace mandoline::detail
