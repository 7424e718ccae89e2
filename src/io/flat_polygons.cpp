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

using Point = std::array<double, 3>;

Point positionOf(const CellComplex& cells, uint32_t v) {
  return {cells.positions[3 * size_t(v)], cells.positions[3 * size_t(v) + 1], cells.positions[3 * size_t(v) + 2]};
}

/// Adds a polygon of a face to what all processes are told.
void tell(const CellComplex& cells, const PolygonSharing& sharing, uint32_t face, std::span<const uint32_t> polygon,
          std::vector<KnownPolygon>& told) {
  const double* const normal = &cells.faceNormal[3 * size_t(face)];
  KnownPolygon& known = told.emplace_back(KnownPolygon{sharing.faceId(face), {normal[0], normal[1], normal[2]}, {}, {}});
  for (const uint32_t v : polygon) {
    known.vertices.push_back(sharing.vertexId(v));
    known.positions.push_back(positionOf(cells, v));
  }
}

class Collapser {
 public:
  Collapser(const CellComplex& cells, ComplexPolygons& polygons, PolygonSharing& sharing)
      : cells_(cells), polygons_(polygons), sharing_(sharing) {
    int exponent = 0;
    std::frexp(sharing.largest(largestCoordinate(cells)), &exponent);
    scale_ = std::ldexp(1, std::min(-exponent, 1000));
  }

  /// Ends, since vertices become fewer, or edges shorter.
  void run() {
    std::vector<uint32_t> faces;
    sharing_.together([&] {
      faces.resize(cells_.faceCount());
      for (uint32_t f = 0; f < faces.size(); ++f) faces[f] = f;
    });
    for (bool any = true; any;) {
      sharing_.together([&] { findFlat(faces); });
      sharing_.gather(told_);
      sharing_.together([&] {
        any = findChanges();
        if (any) faces = change();
      });
    }
  }

 private:
  using Vector = measuring::Vector<double>;
  using Edge = std::pair<uint64_t, uint64_t>;  ///< the lower vertex first
  static Edge edgeOf(uint64_t a, uint64_t b) { return {std::min(a, b), std::max(a, b)}; }

  Vector vectorTo(const Point& a, const Point& from) const {
    Vector vector;
    for (size_t d = 0; d < 3; ++d) vector[d] = scale_ * (a[d] - from[d]);
    return vector;
  }
  double squareOf(const Point& a, const Point& b) const {
    const Vector vector = vectorTo(b, a);
    return measuring::dot(vector, vector);
  }
  Point at(uint32_t v) const { return positionOf(cells_, v); }

  /// The flat polygons of some faces.
  void findFlat(std::span<const uint32_t> faces) {
    told_.clear();
    flat_.clear();
    for (const uint32_t f : faces) {
      polygons_.forEach(f, [&](std::span<const uint32_t> polygon) {
        if (!isFlat(polygon)) return;
        if (flat_.empty() || flat_.back() != f) flat_.push_back(f);
        if (sharing_.tellsOf(f)) tell(cells_, sharing_, f, polygon, told_);
      });
    }
  }

  /// What becomes of those of all: vertices that become one, or else edges that get a vertex. Whether there is anything.
  bool findChanges() {
    same_.clear();
    added_.clear();
    for (const KnownPolygon& polygon : told_) {
      if (!joinVertices(polygon)) addVertex(polygon);
    }
    if (!same_.empty()) added_.clear();
    return !same_.empty() || !added_.empty();
  }

  /// Whether the area of its triangles is not more than that of a strip along the longest edge.
  bool isFlat(std::span<const uint32_t> polygon) const {
    constexpr double kLongest = 12;  // square of the diagonal, where coordinates are from -1 to 1
    if (squareOfTwice(polygon, 1) > 4 * kWidth * kWidth * kLongest) return false;
    double longest = 0, area = 0;
    for (size_t i = 0; i < polygon.size(); ++i)
      longest = std::max(longest, squareOf(at(polygon[i]), at(polygon[(i + 1) % polygon.size()])));
    for (size_t i = 1; i + 1 < polygon.size(); ++i) area += std::sqrt(squareOfTwice(polygon, i));
    return area * area <= 4 * kWidth * kWidth * longest;
  }

  /// Of the area of a triangle at the first vertex.
  double squareOfTwice(std::span<const uint32_t> polygon, size_t i) const {
    const Point first = at(polygon[0]);
    const Vector normal = measuring::cross(vectorTo(at(polygon[i]), first), vectorTo(at(polygon[i + 1]), first));
    return measuring::dot(normal, normal);
  }

  bool joinVertices(const KnownPolygon& polygon) {
    bool any = false;
    for (size_t i = 0; i < polygon.vertices.size(); ++i) {
      for (size_t j = i + 1; j < polygon.vertices.size(); ++j) {
        if (squareOf(polygon.positions[i], polygon.positions[j]) > kApart * kApart * kWidth * kWidth) continue;
        const Edge roots = edgeOf(root(polygon.vertices[i]), root(polygon.vertices[j]));
        if (roots.first != roots.second) same_[roots.second] = roots.first;
        any = true;
      }
    }
    return any;
  }

  uint64_t root(uint64_t v) const {
    for (auto lower = same_.find(v); lower != same_.end(); lower = same_.find(v)) v = lower->second;
    return v;
  }

  /// To the longest edge, the vertex that is nearest to its middle.
  void addVertex(const KnownPolygon& polygon) {
    const size_t count = polygon.vertices.size();
    double longest = -1;
    Edge edge;
    std::array<size_t, 2> ends{};
    for (size_t i = 0; i < count; ++i) {
      const size_t j = (i + 1) % count;
      const Edge next = edgeOf(polygon.vertices[i], polygon.vertices[j]);
      const double length = squareOf(polygon.positions[i], polygon.positions[j]);
      if (length > longest || (length == longest && next < edge)) longest = length, edge = next, ends = {i, j};
    }
    double least = longest;
    std::optional<uint64_t> middle;
    for (size_t i = 0; i < count; ++i) {
      const double farther =
          std::max(squareOf(polygon.positions[ends[0]], polygon.positions[i]), squareOf(polygon.positions[ends[1]], polygon.positions[i]));
      if (farther < least) least = farther, middle = polygon.vertices[i];
    }
    if (middle) added_.emplace(edge, *middle);
  }

  /// All faces; gives those that changed or have flat polygons, ascending.
  std::vector<uint32_t> change() {
    places_.clear();
    for (const KnownPolygon& polygon : told_) {
      for (size_t i = 0; i < polygon.vertices.size(); ++i) places_[polygon.vertices[i]] = polygon.positions[i];
    }
    std::vector<uint8_t> isNear(cells_.vertexCount());
    const auto mark = [&](uint64_t id) {
      if (const std::optional<uint32_t> vertex = sharing_.vertexOf(id)) isNear[*vertex] = 1;
    };
    for (const auto& [high, low] : same_) mark(high);
    for (const auto& [edge, middle] : added_) mark(edge.first);
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
        const uint64_t from = sharing_.vertexId(polygon[i]), to = sharing_.vertexId(polygon[(i + 1) % polygon.size()]);
        const uint64_t becomes = root(from);
        loop.push_back(becomes == from ? polygon[i] : vertexOf(becomes));
        const auto added = added_.find(edgeOf(from, to));
        if (added != added_.end()) loop.push_back(vertexOf(added->second));
      }
      isChanged |= !std::equal(loop.begin(), loop.end(), polygon.begin(), polygon.end());
      addSimpleLoops(loop, now);
    });
    if (isChanged) polygons_.replace(face, std::move(now));
    return isChanged;
  }

  uint32_t vertexOf(uint64_t id) {
    const std::optional<uint32_t> vertex = sharing_.vertexOf(id);
    return vertex ? *vertex : sharing_.addVertex(id, places_.at(id));
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

  const CellComplex& cells_;
  ComplexPolygons& polygons_;
  PolygonSharing& sharing_;
  double scale_ = 1;
  std::vector<KnownPolygon> told_;     // that are flat
  std::map<uint64_t, Point> places_;   // of their vertices
  std::map<uint64_t, uint64_t> same_;  // per vertex that becomes another: a lower one
  std::map<Edge, uint64_t> added_;     // per edge: the vertex that it gets
  std::vector<uint32_t> flat_;         // faces, ascending
};

double along(const Point& normal, const Point& a, const Point& b) {
  double sum = 0;
  for (size_t d = 0; d < 3; ++d) sum += normal[d] * (a[d] - b[d]);
  return sum;
}

/// The walls that lie in a plane with the centroid of a cell beside them.
std::vector<KnownPolygon> wallsAtCentroids(const CellComplex& cells, const ComplexPolygons& polygons, const PolygonSharing& sharing,
                                           double far) {
  std::vector<KnownPolygon> told;
  const auto pointOf = [](const std::vector<double>& points, size_t i) {
    return Point{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
  };
  for (uint32_t f = 0; f < cells.faceCount(); ++f) {
    if (cells.faceTag[f] != FaceTag::surface || !sharing.tellsOf(f)) continue;
    const auto isNear = [&](int32_t cell) {
      return cell >= 0 && std::fabs(along(pointOf(cells.faceNormal, f), pointOf(cells.faceCentroid, f),
                                          pointOf(cells.cellCentroid, size_t(cell)))) <= far / 2;
    };
    if (!isNear(cells.faceCells[2 * size_t(f)]) && !isNear(cells.faceCells[2 * size_t(f) + 1])) continue;
    polygons.forEach(f, [&](std::span<const uint32_t> polygon) { tell(cells, sharing, f, polygon, told); });
  }
  return told;
}

}  // namespace

void collapseFlatPolygons(const CellComplex& cells, ComplexPolygons& polygons, PolygonSharing& sharing) {
  Collapser(cells, polygons, sharing).run();
}

MovedVertices movedOffCentroids(const CellComplex& cells, const ComplexPolygons& polygons, PolygonSharing& sharing) {
  const double far = kFromCentroid * sharing.largest(largestCoordinate(cells));
  std::vector<KnownPolygon> told;
  sharing.together([&] { told = wallsAtCentroids(cells, polygons, sharing, far); });
  sharing.gather(told);
  MovedVertices moved;
  sharing.together([&] {
    std::map<uint64_t, Point> places;
    for (const KnownPolygon& wall : told) {
      const size_t axis = size_t(measuring::largestAxis(wall.normal));
      const double shift = wall.normal[axis] < 0 ? -far : far;  // the same way, however those of one plane are oriented
      for (size_t i = 0; i < wall.vertices.size(); ++i) {
        Point& now = places.try_emplace(wall.vertices[i], wall.positions[i]).first->second;
        if (std::fabs(along(wall.normal, now, wall.positions[i])) > far / 2) continue;
        for (size_t d = 0; d < 3; ++d) now[d] += shift * wall.normal[d];
      }
    }
    for (const auto& [id, place] : places) {
      if (const std::optional<uint32_t> vertex = sharing.vertexOf(id)) moved.emplace(*vertex, place);
    }
  });
  return moved;
}

bool isEnclosedByWalls(const CellComplex& cells, const ComplexPolygons& polygons, size_t cell) {
  const auto sides = cells.halfFaces(cell);
  return std::all_of(sides.begin(), sides.end(),
                     [&](uint32_t h) { return cells.faceTag[h / 2] == FaceTag::surface || polygons.isEmpty(h / 2); });
}

}  // namespace mandoline::detail
