#include "mandoline/orient.h"

#include "mesh/orient/nesting.h"
#include "mesh/orient/patches.h"
#include "mesh/orient/volumes.h"
#include "mesh/prepared.h"
#include "mesh/run_call.h"

namespace mandoline {
namespace {

using namespace detail;

/// Turns all triangles of some patches once more.
void turn(Patches& patches, const std::vector<uint8_t>& isTurned) {
  for (uint32_t t = 0; t < patches.patchOf.size(); ++t) {
    if (patches.has(t)) patches.turned[t] ^= isTurned[patches.of(t)];
  }
}

/// Patches most of whose triangles are turned.
std::vector<uint8_t> mostlyTurned(const Patches& patches) {
  std::vector<int64_t> excess(patches.count(), 0);  // of turned triangles over others
  for (uint32_t t = 0; t < patches.patchOf.size(); ++t) {
    if (patches.has(t)) excess[patches.of(t)] += patches.turned[t] ? 1 : -1;
  }
  std::vector<uint8_t> mostly;
  for (const int64_t e : excess) mostly.push_back(e > 0);
  return mostly;
}

/// Decides which way each patch faces, and turns its triangles so.
std::vector<Facing> face(const WeldedMesh& mesh, Patches& patches, const Shells& shells, Monitor& monitor, Predicates& predicates) {
  const std::vector<int> volumes = volumeSigns(mesh, patches, predicates);
  const Nesting nesting = findNesting(mesh, patches, shells, monitor, predicates);
  std::vector<uint8_t> isTurned = mostlyTurned(patches);
  std::vector<Facing> facing(patches.count(), Facing::unknown);
  for (size_t p = 0; p < patches.count(); ++p) {
    const int32_t shell = shells.shellOf[p];
    const bool isOneOfSeveral = shell >= 0 && !shells.isSingle[size_t(shell)];
    const int faces = isOneOfSeveral ? nesting.facing[p] : volumes[p];
    if (!patches.orientable[p]) {
      facing[p] = Facing::nonOrientable;
    } else if (faces != 0) {
      facing[p] = nesting.isInside[p] ? Facing::inward : Facing::outward;
      isTurned[p] = (faces < 0) != (nesting.isInside[p] != 0);
    }
  }
  turn(patches, isTurned);
  return facing;
}

OrientedMesh result(const MeshView& mesh, Patches&& patches, std::vector<Facing>&& facing) {
  OrientedMesh oriented;
  oriented.mesh.positions.assign(mesh.positions.begin(), mesh.positions.end());
  oriented.mesh.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  for (uint32_t t = 0; t < patches.turned.size(); ++t) {
    if (!patches.turned[t]) continue;
    oriented.turnedTriangles.push_back(t);
    std::swap(oriented.mesh.triangles[3 * size_t(t) + 1], oriented.mesh.triangles[3 * size_t(t) + 2]);
  }
  oriented.trianglePatch = std::move(patches.patchOf);
  oriented.patchFacing = std::move(facing);
  return oriented;
}

}  // namespace

OrientedMesh orient(const MeshView& mesh, const RunOptions& options) {
  return runCall("orientation", [&] {
    Monitor monitor(options, 2);
    const auto prepared =
        prepareMesh(mesh, {0, Intersections::assumeNone}, monitor, [&](const char* stage) { monitor.beginStage(stage, 0); });
    monitor.beginStage("orient", 1);
    std::vector<EdgeUse> uses = edgeUses(prepared->triangles, prepared->points.size());
    Patches patches = findPatches(prepared->triangles, uses);
    const Shells shells = findShells(patches, uses);
    Predicates predicates;
    std::vector<Facing> facing = face(*prepared, patches, shells, monitor, predicates);
    return result(mesh, std::move(patches), std::move(facing));
  });
}

}  // namespace mandoline
