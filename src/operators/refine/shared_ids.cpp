#include "operators/refine/shared_ids.h"

#include "base/exact.h"
#include "base/sort.h"
#include "mesh/failure.h"

namespace mandoline::refining {
namespace {

/// What tells a vertex from all others. One on several planes has several keys, since larger blocks may not know all of its planes.
struct Key {
  uint64_t a, b, c;
  uint32_t instance;

  bool isSame(const Key& k) const { return a == k.a && b == k.b && c == k.c; }
  bool operator<(const Key& k) const {
    if (a != k.a) return a < k.a;
    if (b != k.b) return b < k.b;
    return c != k.c ? c < k.c : instance < k.instance;
  }
};

enum class Kind : uint64_t { triVertex, made, onLine, onEdge, inTriangle, gridVertex };

using detail::Expansion;

uint64_t both(uint64_t a, uint64_t b) { return a << 32 | b; }

/// The keys of a part's vertices.
class KeyMaker {
 public:
  KeyMaker(const MeshView& mesh, const Part& part, uint32_t firstInstance, std::vector<Key>& keys)
      : mesh_(mesh), part_(part), cutMesh_(part.cutMesh()), first_(firstInstance), keys_(keys) {}

  void run() {
    size_t made = 0;
    for (uint32_t v = 0; v < cutMesh_.vertexCount(); ++v) {
      const bool isMade = made < cutMesh_.madeVertices.size() && cutMesh_.madeVertices[made] == v;
      if (cutMesh_.vertexMask[v] != 0) addKeys(v, isMade ? std::optional<size_t>(made) : std::nullopt);
      made += isMade;
    }
  }

 private:
  bool isOn(uint32_t v, int d) const { return cutMesh_.vertexMask[v] >> d & 1; }
  uint64_t plane(uint32_t v, int d) const {
    return uint64_t(cutMesh_.vertexCell[3 * size_t(v) + size_t(d)] + part_.first[size_t(d)]) << part_.level;
  }

  void add(uint32_t v, Kind kind, uint64_t a, uint64_t b, uint64_t rest = 0) {
    keys_.push_back({a, b, uint64_t(kind) | rest << 3, first_ + v});
  }
  /// The crossings of a line with planes that it does not lie in. `along(d)`: whether it runs along those of axis d.
  template <class Along>
  void addCrossings(uint32_t v, Kind kind, uint64_t line, const Along& along) {
    for (int d = 0; d < 3; ++d) {
      if (isOn(v, d) && !along(d)) add(v, kind, line, plane(v, d), uint64_t(d));
    }
  }

  double coordinate(uint32_t triVertex, int d) const { return mesh_.positions[3 * size_t(triVertex) + size_t(d)]; }
  Expansion difference(uint32_t to, uint32_t from, int d) const { return Expansion::difference(coordinate(to, d), coordinate(from, d)); }
  Expansion normal(uint32_t triangle, int d) const {
    const uint32_t* t = &mesh_.triangles[3 * size_t(triangle)];
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    return difference(t[1], t[0], e) * difference(t[2], t[0], f) - difference(t[1], t[0], f) * difference(t[2], t[0], e);
  }

  void addKeys(uint32_t v, std::optional<size_t> made) {
    const int32_t* parents = &cutMesh_.vertexParents[2 * size_t(v)];
    if (cutMesh_.vertexMask[v] == 7) add(v, Kind::gridVertex, both(plane(v, 0), plane(v, 1)), plane(v, 2));
    if (cutMesh_.vertexTriVertex[v] >= 0)
      add(v, Kind::triVertex, part_.triVertex(cutMesh_.vertexTriVertex[v]), 0);
    else if (made)
      addMade(v, *made);
    else if (parents[1] >= 0)
      addOnEdge(v, part_.triVertex(parents[0]), part_.triVertex(parents[1]));
    else if (parents[0] >= 0)
      addInTriangle(v, part_.triangle(parents[0]));
  }

  void addOnEdge(uint32_t v, uint32_t a, uint32_t b) {
    addCrossings(v, Kind::onEdge, both(a, b), [&](int d) { return coordinate(a, d) == coordinate(b, d); });
  }

  void addOnLine(uint32_t v, uint32_t a, uint32_t b) {
    addCrossings(v, Kind::onLine, both(a, b), [&](int d) {
      const int e = (d + 1) % 3, f = (d + 2) % 3;
      return (normal(a, e) * normal(b, f) - normal(a, f) * normal(b, e)).sign() == 0;
    });
  }

  void addInTriangle(uint32_t v, uint32_t triangle) {
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3, f = (d + 2) % 3;  // the grid line along d
      if (isOn(v, e) && isOn(v, f) && normal(triangle, d).sign() != 0)
        add(v, Kind::inTriangle, triangle, both(plane(v, e), plane(v, f)), uint64_t(d));
    }
  }

  void addMade(uint32_t v, size_t made) {
    const auto kind = MadeVertex(cutMesh_.madeVertexKinds[made]);
    const int32_t* parents = &cutMesh_.madeVertexParents[4 * made];
    const auto triangle = [&](size_t i) { return part_.triangle(parents[i]); };
    const auto vertex = [&](size_t i) { return part_.triVertex(parents[i]); };
    switch (kind) {
      case MadeVertex::edgeTriangle:
        return add(v, Kind::made, both(vertex(0), vertex(1)), triangle(2), uint64_t(kind));
      case MadeVertex::edgeEdge:
        return add(v, Kind::made, both(vertex(0), vertex(1)), both(vertex(2), vertex(3)), uint64_t(kind));
      case MadeVertex::triangles:
        return add(v, Kind::made, both(triangle(0), triangle(1)), triangle(2), uint64_t(kind));
      case MadeVertex::trianglesPlane:
        return addOnLine(v, triangle(0), triangle(1));
    }
  }

  const MeshView& mesh_;
  const Part& part_;
  const CutMesh& cutMesh_;
  const uint32_t first_;
  std::vector<Key>& keys_;
};

}  // namespace

SharedIds::SharedIds(const MeshView& mesh, const Parts& parts, const OctreeCells& leaves, detail::Monitor& monitor)
    : gridCells_(leaves.gridCells), gridVertices_(numberOf(gridCells_) + 1, leaves.cellCount()) {
  unite(mesh, parts, monitor);
  numberGridVertices(parts, leaves);
}

void SharedIds::unite(const MeshView& mesh, const Parts& parts, detail::Monitor& monitor) {
  size_t count = 0;
  for (size_t p = 0; p < parts.size(); ++p) {
    firstVertices_.push_back(count);
    count += parts[p].cutMesh().vertexCount();
    if (count >> 31 != 0) throw detail::Failure{{Status::meshTooLarge, -1, -1, "The parts of the grid have more than 2^31 vertices."}};
  }
  const auto made = [&](std::vector<Key>& keys, size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) KeyMaker(mesh, parts[p], uint32_t(firstVertices_[p]), keys).run();
  };
  std::vector<Key> keys;
  for (std::vector<Key>& chunk : detail::forChunks<std::vector<Key>>(parts.size(), monitor, made, 1)) {
    keys.insert(keys.end(), chunk.begin(), chunk.end());
    chunk = {};
  }
  detail::sortItems(keys);
  detail::DisjointSets sets(count);
  for (size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].isSame(keys[i - 1])) sets.unite(keys[i].instance, keys[i - 1].instance);
  }
  ids_.resize(count);
  for (uint32_t p = 0, i = 0; p < parts.size(); ++p) {
    for (uint32_t v = 0; v < parts[p].cutMesh().vertexCount(); ++v, ++i) {
      const uint32_t root = sets.find(i);
      ids_[i] = root == i ? uint32_t(sources_.size()) : ids_[root];
      if (root == i) sources_.push_back({p, v});
    }
  }
}

void SharedIds::numberGridVertices(const Parts& parts, const OctreeCells& leaves) {
  for (size_t leaf = 0; leaf < leaves.cellCount(); ++leaf) {
    const Block low = leaves.corner(leaf), high = leaves.end(leaf);
    for (int i = 0; i < 8; ++i) gridVertices_.insert(numberOf({(i & 1 ? high : low)[0], (i & 2 ? high : low)[1], (i & 4 ? high : low)[2]}));
  }
  const auto forCut = [&](const auto& visit) {
    for (size_t p = 0, i = 0; p < parts.size(); ++p) {
      const CutMesh& cutMesh = parts[p].cutMesh();
      for (size_t v = 0; v < cutMesh.vertexCount(); ++v, ++i) {
        if (cutMesh.vertexMask[v] != 7) continue;
        Block at;
        for (size_t d = 0; d < 3; ++d) at[d] = (cutMesh.vertexCell[3 * v + d] + parts[p].first[d]) << parts[p].level;
        visit(numberOf(at), ids_[i]);
      }
    }
  };
  forCut([&](uint64_t number, uint32_t) { gridVertices_.insert(number); });
  gridVertices_.rank();
  gridIds_.assign(gridVertices_.size(), kNone);
  forCut([&](uint64_t number, uint32_t id) { gridIds_[gridVertices_.rankOf(number)] = id; });
  size_t rank = 0;
  gridVertices_.forEach([&](uint64_t number) {
    uint32_t& id = gridIds_[rank++];
    if (id != kNone) return;
    id = uint32_t(size());
    numbers_.push_back(number);
  });
}

uint64_t SharedIds::numberOf(const Block& at) const {
  const uint64_t nx = uint64_t(gridCells_[0]) + 1, ny = uint64_t(gridCells_[1]) + 1;
  return (uint64_t(at[2]) * ny + uint64_t(at[1])) * nx + uint64_t(at[0]);
}

SharedIds::Source SharedIds::sourceOf(uint32_t id) const {
  if (id < sources_.size()) return {sources_[id].part, sources_[id].vertex, {}};
  const uint64_t number = numbers_[id - sources_.size()], nx = uint64_t(gridCells_[0]) + 1, ny = uint64_t(gridCells_[1]) + 1;
  return {kNone, 0, {int32_t(number % nx), int32_t(number / nx % ny), int32_t(number / nx / ny)}};
}

}  // namespace mandoline::refining
