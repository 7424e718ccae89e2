// What validate() works out from the arrays before it checks: the input as it was snapped and welded, owners of half-faces, grid cells.
#include "operators/validate/context.h"

#include <algorithm>
#include <cstring>

namespace mandoline::validation {
namespace {

/// For each referenced tri-vertex the lowest one at its position.
std::vector<uint32_t> lowestAtPosition(const MeshView& mesh, const std::vector<double>& positions) {
  constexpr uint32_t kNone = ~0u;
  size_t slots = 16;
  while (slots < 2 * mesh.vertexCount()) slots *= 2;
  std::vector<uint32_t> table(slots, kNone), lowest(mesh.vertexCount(), kNone);
  for (const uint32_t v : mesh.triangles) lowest[v] = v;
  for (uint32_t v = 0; v < lowest.size(); ++v) {
    if (lowest[v] == kNone) continue;
    uint64_t hash = 0;
    for (int d = 0; d < 3; ++d) {
      const double x = positions[3 * size_t(v) + d] + 0.0;  // -0 becomes 0
      uint64_t bits;
      std::memcpy(&bits, &x, sizeof bits);
      hash = Random::mix(hash + bits + 0x9e3779b97f4a7c15u);
    }
    size_t slot = hash & (slots - 1);
    const auto same = [&](uint32_t w) {
      return std::equal(&positions[3 * size_t(v)], &positions[3 * size_t(v)] + 3, &positions[3 * size_t(w)]);
    };
    while (table[slot] != kNone && !same(table[slot])) slot = (slot + 1) & (slots - 1);
    if (table[slot] == kNone) table[slot] = v;
    lowest[v] = table[slot];
  }
  return lowest;
}

/// The nearest plane if it is within the tolerance (in widths of the slab that x lies in, or that is next to it), else x.
double snapped(const std::vector<double>& planes, double x, double tolerance) {
  const int64_t cells = int64_t(planes.size()) - 1;
  const int64_t c = std::clamp<int64_t>(std::upper_bound(planes.begin(), planes.end(), x) - planes.begin() - 1, 0, cells - 1);
  const double width = planes[c + 1] - planes[c], low = std::fabs(x - planes[c]) / width, high = std::fabs(x - planes[c + 1]) / width;
  return std::min(low, high) > tolerance ? x : planes[low < high ? c : c + 1];
}

}  // namespace

Check Tally::finish() {
  check_.pass = check_.skipped || check_.worst <= check_.tolerance;
  if (check_.elementKind.empty()) {
    if (!check_.skipped) check_.message = note_;
    return check_;
  }
  if (!check_.pass) {
    check_.message = check_.elementKind + " " + std::to_string(check_.element) + " " + text_;
    if (check_.tolerance > 0) {
      check_.message += ": " + std::to_string(check_.worst) + " roundings, " + std::to_string(int(check_.tolerance)) + " are allowed";
    } else if (check_.worst > 1) {
      check_.message += "; " + std::to_string(int64_t(check_.worst)) + " violations in all";
    }
  } else {
    check_.message = note_;
  }
  return check_;
}

int scaleOf(const MeshView& mesh, const Grid& grid) {
  double largest = 0;
  for (const auto& planes : grid.planes) largest = std::max({largest, std::fabs(planes.front()), std::fabs(planes.back())});
  for (const uint32_t v : mesh.triangles) {
    for (int d = 0; d < 3; ++d) largest = std::max(largest, std::fabs(mesh.positions[3 * size_t(v) + d]));
  }
  return kLargestExponent - std::ilogb(largest);
}

Context::Context(const MeshView& mesh_, const CutMesh& cutMesh, double snapTolerance) : mesh(mesh_), cut(cutMesh) {
  dropped.assign(mesh.triangleCount(), 0);
  for (const uint32_t t : cut.droppedTriangles) dropped[t] = 1;
  scale(snapTolerance);
  weld = lowestAtPosition(mesh, triPositions);
  setRounding();
  setOwners();
  locateFaces();
  groupCells();
  setDuplicates();
  setClosed();
}

void Context::scale(double snapTolerance) {
  const int exponent = scaleOf(mesh, cut.grid);
  const auto scaled = [&](const auto& from, std::vector<double>& to) {
    to.resize(from.size());
    for (size_t i = 0; i < to.size(); ++i) {
      to[i] = std::ldexp(from[i], exponent);
      if (std::fabs(to[i]) < std::ldexp(1.0, kNegligibleExponent)) to[i] = 0;
    }
  };
  for (int d = 0; d < 3; ++d) scaled(cut.grid.planes[d], planes[d]);
  scaled(cut.positions, positions);
  scaled(mesh.positions, triPositions);
  for (size_t i = 0; i < triPositions.size() && snapTolerance > 0; ++i) {
    if (std::isfinite(triPositions[i])) triPositions[i] = snapped(planes[i % 3], triPositions[i], snapTolerance);
  }
}

void Context::setRounding() {
  for (int d = 0; d < 3; ++d) {
    double largest = std::max(std::fabs(planes[d].front()), std::fabs(planes[d].back()));
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!dropped[i / 3]) largest = std::max(largest, std::fabs(triPositions[3 * size_t(mesh.triangles[i]) + d]));
    }
    rounding[d] = kRounding * largest;
  }
}

void Context::setOwners() {
  owner.assign(2 * cut.faceCount(), -1);
  for (size_t c = 0; c < cut.cellCount(); ++c) {
    for (const uint32_t h : cut.halfFaces(c)) {
      if (owner[h] < 0) owner[h] = int32_t(c);
    }
  }
}

void Context::locateFaces() {
  faceGridCell.resize(3 * cut.faceCount());
  for (size_t f = 0; f < cut.faceCount(); ++f) {
    for (int d = 0; d < 3; ++d) {
      int32_t first = 0, last = INT32_MAX;  // of the grid cells that hold all vertices seen so far
      forLoops(f, [&](std::span<const uint32_t> loop) {
        for (const uint32_t v : loop) {
          first = std::max(first, cellAt(v)[d] - int32_t(onPlane(v, d)));
          last = std::min(last, cellAt(v)[d]);
        }
      });
      faceGridCell[3 * f + d] = d == cut.faceAxis[f] ? cut.facePlane[f] : first == last ? first : -1;
    }
  }
}

void Context::groupCells() {
  cellOrder.resize(cut.cellCount());
  for (size_t c = 0; c < cellOrder.size(); ++c) cellOrder[c] = uint32_t(c);
  const auto before = [&](uint32_t a, uint32_t b) {
    const int32_t *g = gridCellOf(a), *h = gridCellOf(b);
    return g[2] != h[2] ? g[2] < h[2] : g[1] != h[1] ? g[1] < h[1] : g[0] < h[0];
  };
  std::stable_sort(cellOrder.begin(), cellOrder.end(), before);
  groupOffsets = {0};
  for (size_t i = 1; i <= cellOrder.size(); ++i) {
    if (i == cellOrder.size() || before(cellOrder[i - 1], cellOrder[i])) groupOffsets.push_back(uint32_t(i));
  }
}

void Context::setDuplicates() {
  const bool possible = std::any_of(cut.droppedTriangles.begin(), cut.droppedTriangles.end(), [&](uint32_t t) { return hasArea(t); });
  if (!possible) return;
  struct Triple {
    std::array<uint32_t, 3> v;
    uint32_t triangle;
    int32_t orientation;
  };
  std::vector<Triple> triples(mesh.triangleCount());
  for (uint32_t t = 0; t < triples.size(); ++t) {
    Triple& x = triples[t];
    x.triangle = t, x.orientation = 1;
    for (int i = 0; i < 3; ++i) x.v[i] = weld[mesh.triangles[3 * size_t(t) + i]];
    const auto order = [&](int i, int j) {
      if (x.v[i] > x.v[j]) std::swap(x.v[i], x.v[j]), x.orientation = -x.orientation;
    };
    order(0, 1), order(1, 2), order(0, 1);
  }
  std::sort(triples.begin(), triples.end(),
            [](const Triple& a, const Triple& b) { return a.v != b.v ? a.v < b.v : a.triangle < b.triangle; });
  multiplicity.assign(triples.size(), 1);
  duplicate.assign(triples.size(), 0);
  for (size_t begin = 0, end = 0; begin < triples.size(); begin = end) {
    int32_t sum = 0;
    bool kept = false;
    for (; end < triples.size() && triples[end].v == triples[begin].v; ++end) {
      sum += triples[end].orientation;
      kept |= !dropped[triples[end].triangle];
    }
    for (size_t i = begin; i < end; ++i) {
      const uint32_t t = triples[i].triangle;
      multiplicity[t] = sum * triples[i].orientation;
      duplicate[t] = dropped[t] && (kept || i > begin);
    }
  }
}

void Context::setClosed() {
  struct Use {
    uint64_t edge;
    uint32_t triangle;
    int32_t direction;
  };
  std::vector<uint8_t> hasAreaOf(mesh.triangleCount()),
      onFlat(mesh.vertexCount(), 0);  // onFlat: corners of triangles that only their positions flatten
  std::vector<Use> uses;
  uses.reserve(mesh.triangles.size());
  for (uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    hasAreaOf[t] = hasArea(t);
    const auto cornerOf = [&](int i) { return weld[mesh.triangles[3 * size_t(t) + i % 3]]; };
    const bool flat = !hasAreaOf[t] && cornerOf(0) != cornerOf(1) && cornerOf(1) != cornerOf(2) && cornerOf(2) != cornerOf(0);
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = cornerOf(i), b = cornerOf(i + 1);
      if (flat) onFlat[a] = 1;
      if (a != b) uses.push_back({uint64_t(std::min(a, b)) << 32 | std::max(a, b), t, a < b ? 1 : -1});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.edge < b.edge; });
  for (size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    int32_t sum[2] = {0, 0}, withArea[2] = {0, 0};  // without and with duplicates
    for (; end < uses.size() && uses[end].edge == uses[begin].edge; ++end) {
      for (int h = isDuplicate(uses[end].triangle) ? 1 : 0; h < 2; ++h) {
        sum[h] += uses[end].direction;
        withArea[h] += hasAreaOf[uses[end].triangle] ? uses[end].direction : 0;
      }
    }
    const bool flat = onFlat[uses[begin].edge >> 32] && onFlat[uint32_t(uses[begin].edge)];
    for (int h = 0; h < 2; ++h) {
      mayBeOpen[h] |= sum[h] != 0 || withArea[h] != 0;
      mayBeClosed[h] &= sum[h] == 0 || flat;
    }
  }
}

bool Context::inBox(const Vec3& p) const {
  for (int d = 0; d < 3; ++d) {
    if (p[d] < planes[d].front() || p[d] > planes[d].back()) return false;
  }
  return true;
}

int Context::axialSide(size_t face) const {
  const int32_t t = cut.faceTriangle[face];
  return t < 0 ? 1 : turn(corner(t, 0), corner(t, 1), corner(t, 2), cut.faceAxis[face]);
}

int64_t Context::runAt(int64_t i, int64_t j, int64_t k) const {
  const size_t row = size_t(k * cut.grid.cells(1) + j);
  const auto first = cut.runBegin.begin() + cut.rowRunOffsets[row], last = cut.runBegin.begin() + cut.rowRunOffsets[row + 1];
  const auto after = std::upper_bound(first, last, i);
  if (after == first) return -1;
  const int64_t run = after - cut.runBegin.begin() - 1;
  return i < cut.runEnd[run] ? run : -1;
}

}  // namespace mandoline::validation
