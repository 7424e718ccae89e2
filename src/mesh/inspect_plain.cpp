#include "mesh/inspect_plain.h"

#include <utility>

#include "base/position_table.h"
#include "mesh/inspect_arrays.h"

namespace mandoline::detail {
namespace {

/// The vertices that no triangle has, which bands leave out: adds them to the counts.
void addUnreferenced(const MeshView& mesh, MeshInfo& info) {
  std::vector<uint8_t> referenced(mesh.vertexCount(), 0);
  for (const uint32_t v : mesh.triangles) referenced[v] = 1;
  const auto at = [&](uint32_t v) { return mesh.positions.data() + 3 * size_t(v); };
  std::vector<uint32_t> others;
  for (uint32_t v = 0; v < referenced.size(); ++v) {
    if (referenced[v]) continue;
    ++info.unreferencedVertices;
    if (isFinite(mesh, v)) {
      others.push_back(v);
    } else {
      ++info.nonFiniteVertices;
    }
  }
  if (others.empty()) return;
  PositionTable places(others.size(), at);
  for (const uint32_t v : others) {
    uint32_t& place = places.find(at(v));
    info.weldedVertices += place != places.kFree;
    if (place == places.kFree) place = v;
  }
  std::vector<uint8_t> isShared(mesh.vertexCount(), 0);  // with one that is referenced, of those with a place
  for (uint32_t v = 0; v < referenced.size(); ++v) {
    if (!referenced[v]) continue;
    const uint32_t place = places.find(at(v));
    if (place != places.kFree) info.weldedVertices += !std::exchange(isShared[place], 1);
  }
}

}  // namespace

MeshInfo inspectPlain(const MeshView& mesh, const BandFindings& found, const PartCounts& parts) {
  MeshInfo info = inspectArrays(mesh);
  info.closed = found.edges.open == 0;
  info.oriented = found.edges.closed;
  info.openEdges = found.edges.open;
  info.inconsistentEdges = found.edges.inconsistent;
  info.components = size_t(parts.winding) + parts.parity + parts.open;
  info.weldedVertices = found.weldedVertices;
  addUnreferenced(mesh, info);
  return info;
}

}  // namespace mandoline::detail
