#include <cmath>

#include "base/large_array.h"
#include "mandoline/merge.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"
#include "operators/cell_complex/half_faces.h"
#include "operators/degrees.h"
#include "operators/merge/face_joiner.h"
#include "operators/merge/merge_parts.h"
#include "operators/require_cut_mesh.h"

namespace mandoline {
namespace {

using merging::FaceJoiner;
using merging::Fate;
using merging::JoinedFaces;

/// How much of a cell's volume a fan of triangles may miss.
constexpr double kMostMissed = 0.1;

/// How often the angle is halved.
constexpr int kHalvings = 2;

class WallUniter {
 public:
  WallUniter(const CutMesh& cutMesh, const CellComplex& cells, const WallOptions& options)
      : cells_(cells), fates_(cells.faceCount(), Fate::stays), halvings_(cells.faceCount()), groups_(cells.faceCount()) {
    for (size_t f = 0; f < cells.faceCount(); ++f) {
      if (cells.faceTag[f] != FaceTag::surface) continue;
      fates_[f] = Fate::joins;
      const uint32_t first = cells.membersOfFace(f)[0];
      if (!options.triangleGroup.empty() && first < cutMesh.faceCount() && cutMesh.faceTriangle[first] >= 0)
        groups_[f] = options.triangleGroup[size_t(cutMesh.faceTriangle[first])];
    }
    for (int i = 0; i <= kHalvings; ++i) cosines_.push_back(operators::cosineOfDegrees(options.angle / double(1 << i)));
  }

  CellComplex run(detail::Monitor& monitor) {
    monitor.beginStage("walls", 0);
    const JoinedFaces faces = join(monitor);
    CellComplex result = copyOfCells();
    replaceFaces(cells_, faces, result, monitor);
    operators::gatherHalfFaces(result);
    return result;
  }

 private:
  JoinedFaces join(detail::Monitor& monitor) {
    FaceJoiner joiner(cells_, fates_);
    const auto joined = [&] { return joiner.join(fates_, [&](uint32_t f, uint32_t g) { return mayJoin(f, g); }); };
    JoinedFaces faces = joined();
    while (halveMissing(faces)) {
      monitor.report(0, 1);
      faces = joined();
    }
    return faces;
  }

  bool mayJoin(size_t f, size_t g) const {
    if (cells_.faceCells[2 * f] != cells_.faceCells[2 * g] || cells_.faceCells[2 * f + 1] != cells_.faceCells[2 * g + 1]) return false;
    if (groups_[f] != groups_[g] || halvings_[f] != halvings_[g]) return false;
    double cosine = 0;
    for (size_t d = 0; d < 3; ++d) cosine += cells_.faceNormal[3 * f + d] * cells_.faceNormal[3 * g + d];
    return cosine >= cosines_[halvings_[f]];
  }

  /// Halves the angle of members of faces that miss too much, or keeps them as they are. Whether there are any.
  bool halveMissing(const JoinedFaces& faces) {
    bool any = false;
    for (size_t f = 0; f < faces.members.size(); ++f) {
      if (faces.loops[f].empty() || !missesMuch(faces.members[f], faces.loops[f])) continue;
      any = true;
      for (const uint32_t m : faces.members[f]) {
        if (halvings_[m] == kHalvings)
          fates_[m] = Fate::stays;
        else
          ++halvings_[m];
      }
    }
    return any;
  }

  /// Whether a fan about the mean of the loop's vertices leaves out, or adds, much of the volume of a cell beside the face.
  bool missesMuch(std::span<const uint32_t> members, std::span<const uint32_t> loop) const {
    double middle[3] = {}, missed = 0;
    for (size_t d = 0; d < 3; ++d) {
      for (const uint32_t v : loop) middle[d] += cells_.positions[3 * size_t(v) + d] / double(loop.size());
      for (const size_t m : members)
        missed += cells_.faceArea[m] * cells_.faceNormal[3 * m + d] * (cells_.faceCentroid[3 * m + d] - middle[d]) / 3;
    }
    for (size_t side = 0; side < 2; ++side) {
      const int32_t cell = cells_.faceCells[2 * size_t(members[0]) + side];
      if (cell >= 0 && std::fabs(missed) > kMostMissed * cells_.cellVolume[size_t(cell)]) return true;
    }
    return false;
  }

  CellComplex copyOfCells() const {
    CellComplex to;
    to.cutVertices = cells_.cutVertices;
    to.cutCells = cells_.cutCells;
    using detail::copyLarge;
    copyLarge(cells_.positions, to.positions);
    copyLarge(cells_.cellCorner, to.cellCorner);
    copyLarge(cells_.cellLevel, to.cellLevel);
    copyLarge(cells_.cellCentre, to.cellCentre);
    copyLarge(cells_.cellRegion, to.cellRegion);
    copyLarge(cells_.cellVolume, to.cellVolume);
    copyLarge(cells_.cellCentroid, to.cellCentroid);
    copyLarge(cells_.cellMemberOffsets, to.cellMemberOffsets);
    copyLarge(cells_.cellMembers, to.cellMembers);
    to.madeFrom = cells_.madeFrom;
    return to;
  }

  const CellComplex& cells_;
  std::vector<Fate> fates_;        // per face
  std::vector<uint8_t> halvings_;  // per face: of the angle
  std::vector<uint32_t> groups_;   // per face
  std::vector<double> cosines_;    // per number of halvings
};

}  // namespace

CellComplex uniteWalls(const CutMesh& cutMesh, const CellComplex& cells, const WallOptions& options) {
  if (!(options.angle >= 0 && options.angle <= 90))
    throw CallError({Status::badOption, -1, -1, "The angle has to be from 0 to 90 degrees."});
  operators::requireNotEmpty(cutMesh);
  operators::requireCellsOf(cutMesh, cells);
  operators::requireLengths(cells);
  if (!options.triangleGroup.empty() && options.triangleGroup.size() != cutMesh.triangleCount)
    operators::refuse("There must be a group for each of the " + std::to_string(cutMesh.triangleCount) + " triangles.");
  return detail::runCall("uniting of walls", [&] {
    CellComplex united = operators::uniteWallsOf(cutMesh, cells, options);
    detail::Fingerprinter fingerprinter("united walls", cells.fingerprint);
    fingerprinter.add(options.angle);
    fingerprinter.add(options.triangleGroup);
    united.fingerprint = fingerprinter.get();
    return united;
  });
}

CellComplex operators::uniteWallsOf(const CutMesh& cutMesh, const CellComplex& cells, const WallOptions& options) {
  detail::Monitor monitor(options, 1);
  return WallUniter(cutMesh, cells, options).run(monitor);
}

}  // namespace mandoline
