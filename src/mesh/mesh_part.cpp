#include "mesh/mesh_part.h"

#include <algorithm>

#include "base/sort.h"
#include "mesh/failure.h"

namespace mandoline::detail {
namespace {

std::vector<uint32_t> unitedIds(const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
  std::vector<uint32_t> ids;
  ids.reserve(a.size() + b.size());
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(ids));
  return ids;
}

/// Where ids are among ascending ones.
class IndexOf {
 public:
  explicit IndexOf(const std::vector<uint32_t>& ids) : ids_(ids) {
    constexpr size_t kSparse = 8;  // a table would be mostly empty
    if (ids.empty() || ids.back() / kSparse > ids.size()) return;
    table_.resize(size_t(ids.back()) + 1);
    for (size_t i = 0; i < ids.size(); ++i) table_[ids[i]] = uint32_t(i);
  }

  uint32_t operator()(uint32_t id) const {
    return !table_.empty() ? table_[id] : uint32_t(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin());
  }

 private:
  const std::vector<uint32_t>& ids_;
  std::vector<uint32_t> table_;
};

/// Adds the vertices and triangles of which only the ids are known yet. Both functions give the mesh that has an id.
template <class MeshOfVertex, class MeshOfTriangle>
void fill(const MeshOfVertex& meshOfVertex, const MeshOfTriangle& meshOfTriangle, MeshPart& part) {
  part.positions.reserve(3 * part.vertices.size());
  for (const uint32_t v : part.vertices) {
    const double* p = meshOfVertex(v).vertex(v);
    part.positions.insert(part.positions.end(), p, p + 3);
  }
  const IndexOf indexOf(part.vertices);
  part.corners.reserve(3 * part.triangles.size());
  for (const uint32_t t : part.triangles) {
    const NamedMesh& mesh = meshOfTriangle(t);
    for (size_t i = 0; i < 3; ++i) part.corners.push_back(indexOf(mesh.cornerId(t, i)));
  }
}

bool hasId(const std::vector<uint32_t>& ids, uint32_t id) { return std::binary_search(ids.begin(), ids.end(), id); }

}  // namespace

size_t NamedMesh::indexOf(size_t id, const std::vector<uint32_t>& ids) {
  const auto at = std::lower_bound(ids.begin(), ids.end(), id);
  if (at == ids.end() || *at != id)
    throw Failure{{Status::internalError, -1, -1, "A process lacks a vertex or a triangle of the mesh that its cells name."}};
  return size_t(at - ids.begin());
}

MeshPart takePart(const NamedMesh& mesh, std::vector<uint32_t> triangles, std::vector<uint32_t> vertices) {
  MeshPart part{std::move(vertices), std::move(triangles), {}, {}};
  sortUnique(part.triangles);
  part.vertices.reserve(part.vertices.size() + 3 * part.triangles.size());
  for (const uint32_t t : part.triangles) {
    for (size_t i = 0; i < 3; ++i) part.vertices.push_back(mesh.cornerId(t, i));
  }
  sortUnique(part.vertices);
  part.vertices.shrink_to_fit();
  const auto only = [&](uint32_t) -> const NamedMesh& { return mesh; };
  fill(only, only, part);
  return part;
}

MeshPart united(const MeshPart& a, const MeshPart& b) {
  MeshPart part{unitedIds(a.vertices, b.vertices), unitedIds(a.triangles, b.triangles), {}, {}};
  const NamedMesh first(a), second(b);
  fill([&](uint32_t v) -> const NamedMesh& { return hasId(a.vertices, v) ? first : second; },
       [&](uint32_t t) -> const NamedMesh& { return hasId(a.triangles, t) ? first : second; }, part);
  return part;
}

}  // namespace mandoline::detail
