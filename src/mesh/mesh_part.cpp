#include "mesh/mesh_part.h"

#include <algorithm>
#include <functional>

#include "base/sort.h"
#include "mesh/failure.h"

namespace mandoline::detail {
namespace {

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

std::vector<uint32_t> unitedIds(std::span<const MeshPart> parts, std::vector<uint32_t> MeshPart::*member) {
  std::vector<uint32_t> ids;
  for (const MeshPart& part : parts) ids.insert(ids.end(), (part.*member).begin(), (part.*member).end());
  if (std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) != ids.end()) sortUnique(ids);
  ids.shrink_to_fit();
  return ids;
}

}  // namespace

size_t NamedMesh::indexOf(size_t id, const std::vector<uint32_t>& ids) {
  const auto at = std::lower_bound(ids.begin(), ids.end(), id);
  if (at == ids.end() || *at != id)
    throw Failure{{Status::internalError, -1, -1, "A process lacks a vertex or a triangle of the mesh that its cells name."}};
  return size_t(at - ids.begin());
}

std::vector<uint32_t> indicesAmong(const std::vector<uint32_t>& ascending, std::span<const uint32_t> ids) {
  const IndexOf indexOf(ascending);
  std::vector<uint32_t> indices;
  indices.reserve(ids.size());
  for (const uint32_t id : ids) indices.push_back(indexOf(id));
  return indices;
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
  part.positions.reserve(3 * part.vertices.size());
  for (const uint32_t v : part.vertices) {
    const double* p = mesh.vertex(v);
    part.positions.insert(part.positions.end(), p, p + 3);
  }
  const IndexOf indexOf(part.vertices);
  part.corners.reserve(3 * part.triangles.size());
  for (const uint32_t t : part.triangles) {
    for (size_t i = 0; i < 3; ++i) part.corners.push_back(indexOf(mesh.cornerId(t, i)));
  }
  return part;
}

bool hasAll(const MeshPart& part, const MeshPart& other) {
  const auto has = [](const std::vector<uint32_t>& ids, const std::vector<uint32_t>& others) {
    return std::includes(ids.begin(), ids.end(), others.begin(), others.end());
  };
  return has(part.vertices, other.vertices) && has(part.triangles, other.triangles);
}

MeshPart united(std::span<const MeshPart> parts) {
  MeshPart all{unitedIds(parts, &MeshPart::vertices), unitedIds(parts, &MeshPart::triangles), {}, {}};
  all.positions.resize(3 * all.vertices.size());
  all.corners.resize(3 * all.triangles.size());
  const IndexOf vertexOf(all.vertices), triangleOf(all.triangles);
  for (const MeshPart& part : parts) {
    for (size_t v = 0; v < part.vertices.size(); ++v)
      std::copy_n(&part.positions[3 * v], 3, &all.positions[3 * size_t(vertexOf(part.vertices[v]))]);
    for (size_t t = 0; t < part.triangles.size(); ++t) {
      const size_t to = 3 * size_t(triangleOf(part.triangles[t]));
      for (size_t i = 0; i < 3; ++i) all.corners[to + i] = vertexOf(part.vertices[part.corners[3 * t + i]]);
    }
  }
  return all;
}

}  // namespace mandoline::detail
