#include "mesh/mesh_part.h"

#include <algorithm>

#include "mesh/failure.h"

namespace mandoline::detail {
namespace {

RankedSet unitedIds(std::span<const MeshPart> parts, std::vector<uint32_t> MeshPart::*member) {
  std::vector<uint32_t> ids;
  for (const MeshPart& part : parts) ids.insert(ids.end(), (part.*member).begin(), (part.*member).end());
  return rankedIds(ids);
}

}  // namespace

RankedSet rankedIds(std::span<const uint32_t> ids) {
  const uint64_t limit = ids.empty() ? 0 : uint64_t(*std::max_element(ids.begin(), ids.end())) + 1;
  RankedSet set(limit, ids.size() + 1);
  for (const uint32_t id : ids) set.insert(id);
  set.rank();
  return set;
}

std::vector<uint32_t> idsOf(const RankedSet& set) {
  std::vector<uint32_t> ids;
  ids.reserve(set.size());
  set.forEach([&](uint64_t id) { ids.push_back(uint32_t(id)); });
  return ids;
}

NamedMesh::NamedMesh(const MeshPart& part)
    : positions_(part.positions),
      corners_(part.corners),
      ids_(&part.vertices),
      vertices_(rankedIds(part.vertices)),
      triangles_(rankedIds(part.triangles)) {}

size_t NamedMesh::indexOf(size_t id, const RankedSet& ids) {
  const uint32_t index = ids.rankOf(id);
  if (index == RankedSet::kNone)
    throw Failure{{Status::internalError, -1, -1, "A process lacks a vertex or a triangle of the mesh that its cells name."}};
  return index;
}

MeshPart takePart(const NamedMesh& mesh, std::vector<uint32_t> triangles, std::vector<uint32_t> vertices) {
  MeshPart part;
  part.triangles = idsOf(rankedIds(triangles));
  triangles = {};
  part.corners.reserve(3 * part.triangles.size());
  for (const uint32_t t : part.triangles) {
    for (size_t i = 0; i < 3; ++i) part.corners.push_back(mesh.cornerId(t, i));
  }
  vertices.insert(vertices.end(), part.corners.begin(), part.corners.end());
  const RankedSet set = rankedIds(vertices);
  vertices = {};
  part.vertices = idsOf(set);
  part.positions.reserve(3 * part.vertices.size());
  for (const uint32_t v : part.vertices) {
    const double* p = mesh.vertex(v);
    part.positions.insert(part.positions.end(), p, p + 3);
  }
  for (uint32_t& corner : part.corners) corner = set.rankOf(corner);
  return part;
}

MeshPart takeFlagged(const MeshPart& part, const std::vector<uint8_t>& takesTriangle, std::vector<uint8_t> takesVertex) {
  MeshPart taken;
  taken.triangles.reserve(size_t(std::count_if(takesTriangle.begin(), takesTriangle.end(), [](uint8_t takes) { return takes != 0; })));
  taken.corners.reserve(3 * taken.triangles.capacity());
  for (size_t t = 0; t < takesTriangle.size(); ++t) {
    if (!takesTriangle[t]) continue;
    taken.triangles.push_back(part.triangles[t]);
    for (size_t i = 0; i < 3; ++i) takesVertex[taken.corners.emplace_back(part.corners[3 * t + i])] = 1;
  }
  std::vector<uint32_t> numbers(takesVertex.size());
  for (size_t v = 0; v < takesVertex.size(); ++v) {
    if (!takesVertex[v]) continue;
    numbers[v] = uint32_t(taken.vertices.size());
    taken.vertices.push_back(part.vertices[v]);
    taken.positions.insert(taken.positions.end(), &part.positions[3 * v], &part.positions[3 * v] + 3);
  }
  for (uint32_t& corner : taken.corners) corner = numbers[corner];
  return taken;
}

bool hasAll(const MeshPart& part, const MeshPart& other) {
  const auto has = [](const std::vector<uint32_t>& ids, const std::vector<uint32_t>& others) {
    return std::includes(ids.begin(), ids.end(), others.begin(), others.end());
  };
  return has(part.vertices, other.vertices) && has(part.triangles, other.triangles);
}

MeshPart united(std::span<const MeshPart> parts) {
  const RankedSet vertices = unitedIds(parts, &MeshPart::vertices), triangles = unitedIds(parts, &MeshPart::triangles);
  MeshPart all{idsOf(vertices), idsOf(triangles), {}, {}};
  all.positions.resize(3 * all.vertices.size());
  all.corners.resize(3 * all.triangles.size());
  for (const MeshPart& part : parts) {
    for (size_t v = 0; v < part.vertices.size(); ++v)
      std::copy_n(&part.positions[3 * v], 3, &all.positions[3 * size_t(vertices.rankOf(part.vertices[v]))]);
    for (size_t t = 0; t < part.triangles.size(); ++t) {
      const size_t to = 3 * size_t(triangles.rankOf(part.triangles[t]));
      for (size_t i = 0; i < 3; ++i) all.corners[to + i] = vertices.rankOf(part.vertices[part.corners[3 * t + i]]);
    }
  }
  return all;
}

}  // namespace mandoline::detail
