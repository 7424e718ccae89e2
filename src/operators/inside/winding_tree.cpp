#include "operators/inside/winding_tree.h"

#include <algorithm>
#include <cmath>

#include "base/curve_order.h"
#include "base/position_table.h"
#include "operators/inside/turn_sum.h"

namespace mandoline::operators {
namespace {

using detail::Point;

constexpr uint32_t kLeaf = 8;
/// How far from a node's box its fan is taken, in sizes of the box: so that rounding does not bring a fan's triangle to its other side.
constexpr double kFarFrom = 0x1p-5;
/// Where all solid angles vanish; products of three distances don't overflow before.
constexpr double kInfinitelyFar = 0x1p100;

/// From the eye to a vertex.
struct Ray {
  Point to;
  double length;

  Ray(const Point& eye, const Point& vertex) : to{vertex[0] - eye[0], vertex[1] - eye[1], vertex[2] - eye[2]} {
    length = std::sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
  }
};

double dot(const Ray& a, const Ray& b) { return a.to[0] * b.to[0] + a.to[1] * b.to[1] + a.to[2] * b.to[2]; }

/// Half the solid angle of a triangle, whose normal points away from the eye, as a vector (van Oosterom, Strackee 1983).
struct HalfSolidAngle {
  double x, y;

  HalfSolidAngle(const Ray& a, const Ray& b, const Ray& c) {
    const auto minor = [&](size_t i, size_t j) { return b.to[i] * c.to[j] - b.to[j] * c.to[i]; };
    y = a.to[0] * minor(1, 2) + a.to[1] * minor(2, 0) + a.to[2] * minor(0, 1);
    x = a.length * b.length * c.length + dot(a, b) * c.length + dot(b, c) * a.length + dot(c, a) * b.length;
  }
};

}  // namespace

WindingTree::WindingTree(const MeshView& mesh, std::span<const uint32_t> triangles) {
  addTriangles(mesh, triangles);
  if (!triangles_.empty()) addRim(addNode(0, uint32_t(triangles_.size())));
}

void WindingTree::addTriangles(const MeshView& mesh, std::span<const uint32_t> triangles) {
  std::vector<uint32_t> used;
  for (const uint32_t t : triangles) {
    for (size_t i = 0; i < 3; ++i) used.push_back(mesh.triangles[3 * size_t(t) + i]);
  }
  double largest = 0;
  for (const uint32_t v : used) {
    for (size_t d = 0; d < 3; ++d) largest = std::max(largest, std::fabs(mesh.positions[3 * size_t(v) + d]));
  }
  if (largest > 0) scale_ = std::ldexp(1.0, std::clamp(-std::ilogb(largest) - 1, -1022, 1022));
  detail::sortUnique(used);
  const auto at = [&](uint32_t i) { return &mesh.positions[3 * size_t(used[i])]; };
  const std::vector<uint32_t> lowest = detail::lowestAtPosition(used.size(), at, [](uint32_t) { return true; });
  for (uint32_t i = 0; i < used.size(); ++i) points_.push_back({at(i)[0] * scale_, at(i)[1] * scale_, at(i)[2] * scale_});
  std::vector<Point> centres;
  std::vector<Triangle> given;
  for (const uint32_t t : triangles) {
    Triangle triangle{{}, t};
    Point centre{};
    for (size_t i = 0; i < 3; ++i) {
      const auto place = std::lower_bound(used.begin(), used.end(), mesh.triangles[3 * size_t(t) + i]) - used.begin();
      triangle.corners[i] = lowest[size_t(place)];
      for (size_t d = 0; d < 3; ++d) centre[d] += points_[triangle.corners[i]][d];
    }
    given.push_back(triangle);
    centres.push_back(centre);
  }
  for (const detail::KeyedItem& next : detail::orderAlongCurve(centres, [&](size_t i) { return given[i].id; })) {
    triangles_.push_back(given[next.item]);
  }
}

/// Returns the edges that bound its triangles.
std::vector<WindingTree::Edge> WindingTree::addNode(uint32_t begin, uint32_t end) {
  const size_t n = nodes_.size();
  Node node;
  node.begin = begin, node.end = end;
  const Point& first = points_[triangles_[begin].corners[0]];
  node.box = {first, first};
  for (uint32_t t = begin; t < end; ++t) {
    for (const uint32_t v : triangles_[t].corners) node.box.include({points_[v], points_[v]});
  }
  nodes_.push_back(node);
  std::vector<Edge> edges;
  if (end - begin <= kLeaf) {
    edges = edgesOf(node);
  } else {
    const uint32_t middle = begin + (end - begin) / 2;
    edges = addNode(begin, middle);
    const std::vector<Edge> more = addNode(middle, end);
    edges.insert(edges.end(), more.begin(), more.end());
  }
  detail::sortItems(edges, [](const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  size_t kept = 0;
  for (size_t i = 0; i < edges.size();) {
    Edge edge = edges[i];
    while (++i < edges.size() && edges[i].low == edge.low && edges[i].high == edge.high) edge.count += edges[i].count;
    if (edge.count != 0) edges[kept++] = edge;
  }
  edges.resize(kept);
  nodes_[n].past = uint32_t(nodes_.size());
  nodes_[n].hasFan = edges.size() < end - begin;
  if (nodes_[n].hasFan) {
    nodes_[n].firstEdge = uint32_t(edges_.size());
    edges_.insert(edges_.end(), edges.begin(), edges.end());
    nodes_[n].endEdge = uint32_t(edges_.size());
  }
  return edges;
}

std::vector<WindingTree::Edge> WindingTree::edgesOf(const Node& leaf) const {
  std::vector<Edge> edges;
  for (uint32_t t = leaf.begin; t < leaf.end; ++t) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t u = triangles_[t].corners[i], v = triangles_[t].corners[(i + 1) % 3];
      if (u != v) edges.push_back({std::min(u, v), std::max(u, v), u < v ? 1 : -1});
    }
  }
  return edges;
}

bool WindingTree::isFar(const Node& node, const Point& p) const {
  double distance = 0, size = 0;
  for (size_t d = 0; d < 3; ++d) {
    distance = std::max({distance, node.box.low[d] - p[d], p[d] - node.box.high[d]});
    size = std::max(size, node.box.high[d] - node.box.low[d]);
  }
  return distance > size * kFarFrom;
}

void WindingTree::addFan(const Node& node, const Point& p, TurnSum& sum) const {
  if (node.firstEdge == node.endEdge) return;
  const Ray apex(p, points_[edges_[node.firstEdge].low]);
  for (uint32_t e = node.firstEdge; e < node.endEdge; ++e) {
    const Edge& edge = edges_[e];
    const HalfSolidAngle angle(apex, Ray(p, points_[edge.low]), Ray(p, points_[edge.high]));
    for (int32_t i = 0; i < std::abs(edge.count); ++i) sum.add(angle.x, edge.count > 0 ? angle.y : -angle.y);
  }
}

void WindingTree::addRim(const std::vector<Edge>& edges) {
  for (const Edge& edge : edges) {
    const Point &a = points_[edge.low], &b = points_[edge.high];
    RimEdge rim{edge, {a, a}, 0};
    rim.box.include({b, b});
    double length = 0;
    for (size_t d = 0; d < 3; ++d) length += (b[d] - a[d]) * (b[d] - a[d]);
    rim.weight = std::abs(edge.count) * std::sqrt(length);
    rim_.push_back(rim);
  }
}

double WindingTree::variation(const detail::Box& given) const {
  constexpr double kWholeSphere = 12.566370614359172954;
  detail::Box box;
  double diagonal = 0, steepest = 0;
  for (size_t d = 0; d < 3; ++d) {
    box.low[d] = given.low[d] * scale_;
    box.high[d] = given.high[d] * scale_;
    diagonal += (box.high[d] - box.low[d]) * (box.high[d] - box.low[d]);
  }
  for (const RimEdge& rim : rim_) {  // the gradient is an integral over the rim, that of Biot and Savart: at most length / distance^2
    double distance = 0;
    for (size_t d = 0; d < 3; ++d) {
      const double gap = std::max({0.0, rim.box.low[d] - box.high[d], box.low[d] - rim.box.high[d]});
      distance += gap * gap;
    }
    steepest += rim.weight / distance;
  }
  const double variation = steepest * std::sqrt(diagonal) / kWholeSphere;
  return variation < INFINITY ? variation : INFINITY;
}

double WindingTree::change(const Point& from, const Point& to) const {
  const Point p = scaled(from), q = scaled(to);
  TurnSum sum;
  for (const RimEdge& rim : rim_) {  // if the edges moved instead of the point, they would sweep two triangles each
    const Point &low = points_[rim.edge.low], &high = points_[rim.edge.high];
    const Ray a(p, low), b(p, high), movedA(q, low), movedB(q, high);
    const HalfSolidAngle first(a, movedA, movedB), second(a, movedB, b);
    for (int32_t i = 0; i < std::abs(rim.edge.count); ++i) {
      sum.add(first.x, rim.edge.count > 0 ? first.y : -first.y);
      sum.add(second.x, rim.edge.count > 0 ? second.y : -second.y);
    }
  }
  return sum.turns();
}

double WindingTree::at(const Point& given, std::span<const uint32_t> leftOut) const {
  const Point p = scaled(given);
  for (const double x : p) {
    if (!(std::fabs(x) < kInfinitelyFar)) return 0;
  }
  TurnSum sum;
  for (size_t n = 0; n < nodes_.size();) {
    const Node& node = nodes_[n];
    const bool isLeaf = node.past == n + 1;
    if (node.hasFan && isFar(node, p)) {
      addFan(node, p, sum);
      n = node.past;
    } else if (isLeaf) {
      for (uint32_t t = node.begin; t < node.end; ++t) {
        const auto& [a, b, c] = triangles_[t].corners;
        if (!leftOut.empty() && std::find(leftOut.begin(), leftOut.end(), triangles_[t].id) != leftOut.end()) continue;
        const HalfSolidAngle angle(Ray(p, points_[a]), Ray(p, points_[b]), Ray(p, points_[c]));
        sum.add(angle.x, angle.y);
      }
      n = node.past;
    } else {
      ++n;
    }
  }
  return sum.turns();
}

}  // namespace mandoline::operators
