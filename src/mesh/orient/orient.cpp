#include "mandoline/orient.h"

#include "mesh/orient/nesting.h"
#include "mesh/orient/parts.h"
#include "mesh/orient/volumes.h"
#include "mesh/prepared.h"
#include "mesh/run_call.h"

namespace mandoline {
namespace {

using namespace detail;

/// Turns all triangles of some parts once more.
void turn(Parts& parts, const std::vector<uint8_t>& isTurned) {
  for (uint32_t t = 0; t < parts.partOf.size(); ++t) {
    if (parts.has(t)) parts.turned[t] ^= isTurned[parts.of(t)];
  }
}

/// Parts most of whose triangles are turned.
std::vector<uint8_t> mostlyTurned(const Parts& parts) {
  std::vector<int64_t> excess(parts.count(), 0);  // of turned triangles over others
  for (uint32_t t = 0; t < parts.partOf.size(); ++t) {
    if (parts.has(t)) excess[parts.of(t)] += parts.turned[t] ? 1 : -1;
  }
  std::vector<uint8_t> mostly;
  for (const int64_t e : excess) mostly.push_back(e > 0);
  return mostly;
}

/// Decides which way each part faces, and turns its triangles so.
std::vector<Facing> face(const WeldedMesh& mesh, Parts& parts, const Shells& shells, Monitor& monitor, Predicates& predicates) {
  const std::vector<int> volumes = volumeSigns(mesh, parts, predicates);
  const Nesting nesting = findNesting(mesh, parts, shells, monitor, predicates);
  std::vector<uint8_t> isTurned = mostlyTurned(parts);
  std::vector<Facing> facing(parts.count(), Facing::unknown);
  for (size_t p = 0; p < parts.count(); ++p) {
    const int32_t shell = shells.shellOf[p];
    const bool isOneOfSeveral = shell >= 0 && !shells.isSingle[size_t(shell)];
    const int faces = isOneOfSeveral ? nesting.facing[p] : volumes[p];
    if (!parts.orientable[p]) {
      facing[p] = Facing::nonOrientable;
    } else if (faces != 0) {
      facing[p] = nesting.isInside[p] ? Facing::inward : Facing::outward;
      isTurned[p] = (faces < 0) != (nesting.isInside[p] != 0);
    }
  }
  turn(parts, isTurned);
  return facing;
}

OrientedMesh result(const MeshView& mesh, Parts&& parts, std::vector<Facing>&& facing) {
  OrientedMesh oriented;
  oriented.mesh.positions.assign(mesh.positions.begin(), mesh.positions.end());
  oriented.mesh.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  for (uint32_t t = 0; t < parts.turned.size(); ++t) {
    if (!parts.turned[t]) continue;
    oriented.turnedTriangles.push_back(t);
    std::swap(oriented.mesh.triangles[3 * size_t(t) + 1], oriented.mesh.triangles[3 * size_t(t) + 2]);
  }
  oriented.trianglePart = std::move(parts.partOf);
  oriented.partFacing = std::move(facing);
  return oriented;
}

}  // namespace

OrientedMesh orient(const MeshView& mesh, const RunOptions& options) {
  return runCall("orientation", [&] {
    Monitor monitor(options, 2);
    const auto prepared =
        prepareMesh(mesh, {0, Intersections::assumeNone, {}}, monitor, [&](const char* stage) { monitor.beginStage(stage, 0); });
    monitor.beginStage("orient", 1);
    std::vector<EdgeUse> uses = edgeUses(prepared->triangles);
    Parts parts = findParts(prepared->triangles, uses);
    const Shells shells = findShells(parts, uses);
    Predicates predicates;
    std::vector<Facing> facing = face(*prepared, parts, shells, monitor, predicates);
    return result(mesh, std::move(parts), std::move(facing));
  });
}

}  // namespace mandoline
