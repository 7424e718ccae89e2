#include "io/seen_polygons.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

#include "operators/measure/vector.h"
#include "operators/triangulate/polygon_triangulator.h"
#include "operators/unit_scale.h"

namespace mandoline::detail {
namespace {

using operators::PlanePoint;
using Polygon = std::vector<uint32_t>;

/// An edge is seen from a point if their triangle has more than this of the area of the polygon that is divided: no piece has less.
constexpr double kLeastSeen = 1e-12;

/// Edges are left out whose square is not more than this of that area: their ends are one but for rounding.
constexpr double kLeastSquare = 1e-20;

class Divider {
 public:
  Divider(const CellComplex& cells, ComplexPolygons& polygons) : cells_(cells), polygons_(polygons) {
    double largest = 0;
    for (const double x : cells.positions) largest = std::max(largest, std::fabs(x));
    factor_ = std::ldexp(1.0, operators::unitExponent(largest));
  }

  void run() {
    for (uint32_t f = 0; f < cells_.faceCount(); ++f) {
      if (cells_.faceTag[f] != FaceTag::surface) divide(f);
    }
  }

 private:
  void divide(uint32_t face) {
    const double* const normal = &cells_.faceNormal[3 * size_t(face)];
    const size_t axis = size_t(measuring::largestAxis({normal[0], normal[1], normal[2]}));
    right_ = (axis + (normal[axis] < 0 ? 2 : 1)) % 3;
    up_ = (axis + (normal[axis] < 0 ? 1 : 2)) % 3;
    bool any = false;
    ComplexPolygons::Replacement pieces;
    polygons_.forEach(face, [&](std::span<const uint32_t> polygon) {
      const bool isDivided = polygon.size() > 3 && addPieces(polygon, pieces);
      if (!isDivided) pieces.emplace_back(polygon.begin(), polygon.end());
      any |= isDivided;
    });
    if (any) polygons_.replace(face, std::move(pieces));
  }

  PlanePoint at(uint32_t v) const {
    return {cells_.positions[3 * size_t(v) + right_] * factor_, cells_.positions[3 * size_t(v) + up_] * factor_};
  }

  /// Whether the centre sees all edges, and some vertex all that it has no part in.
  bool isSeen(std::span<const uint32_t> polygon) {
    points_.clear();
    for (const uint32_t v : polygon) points_.push_back(at(v));
    if (!seesEdges(centre(), points_.size())) return false;
    for (size_t i = 0; i < points_.size(); ++i) {
      if (seesEdges(points_[i], i)) return true;
    }
    return false;
  }

  double twiceArea(std::span<const uint32_t> polygon) const {
    double area = 0;
    for (size_t i = 1; i + 1 < polygon.size(); ++i) area += operators::orientation(at(polygon[0]), at(polygon[i]), at(polygon[i + 1]));
    return area;
  }

  /// As OpenFOAM finds it: of the triangles about the mean of the vertices, whichever way they turn.
  PlanePoint centre() const {
    PlanePoint mean{0, 0}, sum{0, 0};
    for (const PlanePoint& p : points_) mean.x += p.x / double(points_.size()), mean.y += p.y / double(points_.size());
    double area = 0;
    for (size_t i = 0; i < points_.size(); ++i) {
      const PlanePoint &a = points_[i], &b = points_[(i + 1) % points_.size()];
      const double mine = std::fabs(operators::orientation(mean, a, b));
      area += mine;
      sum.x += mine * ((a.x - mean.x) + (b.x - mean.x));
      sum.y += mine * ((a.y - mean.y) + (b.y - mean.y));
    }
    return area > 0 ? PlanePoint{mean.x + sum.x / (3 * area), mean.y + sum.y / (3 * area)} : mean;
  }

  /// All edges but those at a vertex, if that is the point.
  bool seesEdges(const PlanePoint& point, size_t vertex) const {
    const size_t n = points_.size();
    for (size_t i = 0; i < n; ++i) {
      const size_t next = i + 1 < n ? i + 1 : 0;
      if (i == vertex || next == vertex || operators::squaredDistance(points_[i], points_[next]) <= leastSquare_) continue;
      if (!(operators::orientation(point, points_[i], points_[next]) > least_)) return false;
    }
    return true;
  }

  /// If not all is seen: triangles, which join along diagonals as long as the results are seen, along the longest ones first. Whether there
  /// are such pieces; none where some would not be seen.
  bool addPieces(std::span<const uint32_t> polygon, ComplexPolygons::Replacement& pieces) {
    const double twice = std::fabs(twiceArea(polygon));
    least_ = kLeastSeen * twice;
    leastSquare_ = kLeastSquare * twice;
    if (isSeen(polygon)) return false;
    triangles_.clear();
    triangulator_.startLoop();
    for (const uint32_t v : polygon) triangulator_.addCorner(v, at(v));
    triangulator_.run(triangles_);
    std::vector<Polygon> loops = joinedTriangles();
    std::erase_if(loops, [](const Polygon& loop) { return loop.empty(); });
    if (!std::all_of(loops.begin(), loops.end(), [&](const Polygon& loop) { return isSeen(loop); })) return false;
    std::move(loops.begin(), loops.end(), std::back_inserter(pieces));
    return true;
  }

  /// Per triangle the polygon that others have joined; empty where it has joined another.
  std::vector<Polygon> joinedTriangles() {
    std::vector<Polygon> loops(triangles_.size() / 3);
    std::vector<size_t> loopOf(loops.size());
    for (size_t t = 0; t < loops.size(); ++t) {
      loops[t].assign({triangles_[3 * t], triangles_[3 * t + 1], triangles_[3 * t + 2]});
      loopOf[t] = t;
    }
    for (const Diagonal& diagonal : diagonals()) {
      const size_t a = loopOf[diagonal.triangles[0]], b = loopOf[diagonal.triangles[1]];
      Polygon both = joined(loops[a], loops[b], diagonal.from, diagonal.to);
      if (!isSeen(both)) continue;
      loops[a] = std::move(both);
      loops[b].clear();
      std::replace(loopOf.begin(), loopOf.end(), b, a);
    }
    return loops;
  }

  struct Diagonal {
    double square;
    uint32_t from, to;  ///< of the first triangle; the other one has it the other way
    size_t triangles[2];
  };

  /// Of the triangles, the longest first.
  std::vector<Diagonal> diagonals() const {
    struct Edge {
      uint32_t low, high;
      bool ascends;
      size_t triangle;
    };
    std::vector<Edge> edges;
    for (size_t i = 0; i < triangles_.size(); ++i) {
      const uint32_t from = triangles_[i], to = triangles_[i % 3 == 2 ? i - 2 : i + 1];
      edges.push_back({std::min(from, to), std::max(from, to), from < to, i / 3});
    }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle); });
    std::vector<Diagonal> result;
    for (size_t i = 1; i < edges.size(); ++i) {
      const Edge &a = edges[i - 1], &b = edges[i];
      if (a.low != b.low || a.high != b.high || a.ascends == b.ascends) continue;
      const double square = operators::squaredDistance(at(a.low), at(a.high));
      result.push_back({square, a.ascends ? a.low : a.high, a.ascends ? a.high : a.low, {a.triangle, b.triangle}});
    }
    std::stable_sort(result.begin(), result.end(), [](const Diagonal& a, const Diagonal& b) { return a.square > b.square; });
    return result;
  }

  /// Of two polygons, of which one has the edge and the other has it the other way.
  static Polygon joined(const Polygon& a, const Polygon& b, uint32_t from, uint32_t to) {
    Polygon both;
    const auto addAfter = [&](const Polygon& polygon, uint32_t v) {
      const size_t n = polygon.size(), first = size_t(std::find(polygon.begin(), polygon.end(), v) - polygon.begin());
      for (size_t i = 0; i + 1 < n; ++i) both.push_back(polygon[(first + i) % n]);
    };
    addAfter(a, to);
    addAfter(b, from);
    return both;
  }

  const CellComplex& cells_;
  ComplexPolygons& polygons_;
  double factor_ = 1;
  size_t right_ = 0, up_ = 1;           // axes, so that the current face is seen from where its normal points to
  double least_ = 0, leastSquare_ = 0;  // see kLeastSeen and kLeastSquare
  std::vector<PlanePoint> points_;      // of the current polygon
  std::vector<uint32_t> triangles_;     // of the current polygon, 3 vertices each
  operators::PolygonTriangulator triangulator_;
};

}  // namespace

void dividePolygonsNotSeen(const CellComplex& cells, ComplexPolygons& polygons) { Divider(cells, polygons).run(); }

}  // namespace mandoline::detail
