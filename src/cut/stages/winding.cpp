#include "cut/stages/winding.h"

#include "base/sort.h"

namespace mandoline::detail {
namespace {

/// The region that holds the point of windingBeside(), at the lowest corner of the grid.
uint32_t regionAtLowestCorner(const IdVector<BrickId, BrickCut>& cuts, const Regions& regions) {
  if (!cuts.empty() && cuts.front().componentAtCorner) return regions.ofComponents.front()[*cuts.front().componentAtCorner];
  return regions.runRegion[0];
}

/// Disjoint sets of regions whose winding numbers are known relative to each other.
class WindingSets {
 public:
  explicit WindingSets(uint32_t count) : parent_(count), toParent_(count, 0) {
    for (uint32_t r = 0; r < count; ++r) parent_[r] = r;
  }

  uint32_t find(uint32_t r) {
    uint32_t root = r;
    int32_t sum = 0;
    for (; parent_[root] != root; root = parent_[root]) sum += toParent_[root];
    for (uint32_t at = r; at != root;) {
      const uint32_t up = parent_[at];
      const int32_t step = toParent_[at];
      parent_[at] = root;
      toParent_[at] = sum;
      sum -= step;
      at = up;
    }
    return root;
  }
  /// The winding number of r less that of its root; call find(r) before.
  int32_t toRoot(uint32_t r) const { return toParent_[r]; }

  /// Says that r has `step` more than s; false if that contradicts what was said before.
  bool setMore(uint32_t r, uint32_t s, int32_t step, const Counted& counted) {
    const uint32_t rootR = find(r), rootS = find(s);
    if (rootR == rootS) return counted.areEqual(toRoot(r), toRoot(s) + step);
    toParent_[rootR] = toRoot(s) + step - toRoot(r);
    parent_[rootR] = rootS;
    return true;
  }

 private:
  std::vector<uint32_t> parent_;
  std::vector<int32_t> toParent_;  // winding number less the parent's; 0 of a root
};

/// What a tri-cut-face says of the regions on its sides.
struct Statement {
  TriangleId triangle;
  Slab cell;  ///< a grid cell that has the face
  uint32_t behind, inFront;
  int32_t step;
  std::optional<TriangleId> other;  ///< another triangle in the cell
};

/// All of them, by triangles and then by grid cells.
std::vector<Statement> listStatements(const CutBricks& all, const Regions& regions, size_t kind) {
  const std::vector<Counted> counted = countedOf(*all.surface.input.mesh);
  std::vector<Statement> statements;
  for (const BrickId b : all.cuts.ids()) {
    const BrickCut& cut = all.cuts[b];
    const FaceSteps steps(all.surface.input, {all.surface.input, cut.triangles, cut.otherParents}, counted);
    IdVector<FaceId, std::array<CellId, 2>> sides(cut.triangles.size(), {FaceSides::kNone, FaceSides::kNone});
    for (const CellId c : cut.gridCells.ids()) {
      for (const HalfFace h : cut.halfFaces[c]) {
        if (cut.isTri(h.face())) sides[h.face()][h.side()] = c;
      }
    }
    const auto add = [&](FaceId f, CellId cell, uint32_t behind, uint32_t inFront) {
      Statement statement{cut.triangles[f], all.bricks.boxes[b].cellAt(cut.gridCells[cell]), behind, inFront, steps.at(f)[kind], {}};
      for (const HalfFace h : cut.halfFaces[cell]) {
        if (cut.isTri(h.face()) && cut.triangles[h.face()] != statement.triangle) statement.other = cut.triangles[h.face()];
      }
      statements.push_back(statement);
    };
    const auto& ofComponents = regions.ofComponents[b];
    for (const FaceId f : cut.triangles.ids()) {
      const auto& [behind, inFront] = sides[f];
      if (behind == FaceSides::kNone || inFront == FaceSides::kNone) continue;  // on the boundary of the brick
      add(f, behind, ofComponents[cut.components[behind]], ofComponents[cut.components[inFront]]);
    }
    all.forHalves(b, [&](const BoundaryHalf& below, BrickId owner, const BoundaryHalf& above) {
      const HalfFace h = above.halfFace;  // as the cell below sees it
      if (!above.isTri) return;
      uint32_t behind = regions.ofComponents[owner][below.component], inFront = ofComponents[above.component];
      if (h.side() == 1) std::swap(behind, inFront);
      add(h.face(), sides[h.face()][1 - h.side()], behind, inFront);
    });
  }
  sortItems(statements, [](const Statement& a, const Statement& b) { return std::tie(a.triangle, a.cell) < std::tie(b.triangle, b.cell); });
  return statements;
}

/// Where steps contradict each other, finds the first face that does, to blame its triangle, if all is known here.
[[noreturn]] void failAtFirst(const CutBricks& all, const Regions& regions, size_t kind) {
  const Counted counted = countedOf(*all.surface.input.mesh)[kind];
  WindingSets sets(regions.count);
  const bool isAllHere = all.bricks.here.size() == all.bricks.size();
  for (const Statement& s : isAllHere ? listStatements(all, regions, kind) : std::vector<Statement>()) {
    if (!sets.setMore(s.behind, s.inFront, s.step, counted)) all.surface.vertices.failSelfIntersection(s.triangle, s.other);
  }
  all.surface.vertices.failSelfIntersection({}, {});
}

/// Per region the winding number of the counted triangles of a kind.
std::vector<int32_t> windingOf(const CutBricks& cut, const Regions& regions, size_t kind) {
  const Input& input = cut.surface.input;
  const Counted counted = countedOf(*input.mesh)[kind];
  WindingSets sets(regions.count);
  const auto set = [&](uint32_t behind, uint32_t inFront, int32_t step) {
    if (!sets.setMore(behind, inFront, step, counted)) failAtFirst(cut, regions, kind);
  };
  for (const BrickId b : cut.cuts.ids()) {
    for (const WindingStep& s : cut.cuts[b].steps) {
      set(regions.ofComponents[b][s.behind], regions.ofComponents[b][s.inFront], s.steps[kind]);
    }
    cut.forHalves(b, [&](const BoundaryHalf& below, BrickId owner, const BoundaryHalf& above) {
      if (!below.isTri) return;
      uint32_t behind = regions.ofComponents[owner][below.component], inFront = regions.ofComponents[b][above.component];
      if (below.halfFace.side() == 1) std::swap(behind, inFront);
      set(behind, inFront, below.steps[kind]);
    });
  }
  const uint32_t anchor = regionAtLowestCorner(cut.cuts, regions), root = sets.find(anchor);
  const int32_t shift = input.cornerWinding[kind] - sets.toRoot(anchor);
  std::vector<int32_t> winding(regions.count);
  for (uint32_t r = 0; r < regions.count; ++r) winding[r] = sets.find(r) == root ? shift + sets.toRoot(r) : 0;
  return winding;
}

}  // namespace

void findWinding(const CutBricks& cut, Regions& regions) {
  const Prepared& mesh = *cut.surface.input.mesh;
  const PartCounts& parts = mesh.parts.counts;
  regions.hasWinding = mesh.closed;
  if (mesh.closed) {
    regions.winding = windingOf(cut, regions, 0);
    return;
  }
  if (parts.winding > 0) regions.partWinding = windingOf(cut, regions, 0);
  if (parts.winding + parts.parity == 0) return;
  for (const int32_t crossings : windingOf(cut, regions, parts.winding > 0 ? 1 : 0)) {
    regions.parity.push_back(uint8_t(crossings & 1));
  }
}

}  // namespace mandoline::detail
