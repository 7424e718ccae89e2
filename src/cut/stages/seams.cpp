#include "cut/stages/seams.h"

namespace mandoline::detail {
namespace {

class SeamFinder {
 public:
  SeamFinder(const CutBricks& cut, BrickId brick, BrickSeams& out)
      : input_(cut.surface.input),
        bricks_(cut.bricks),
        runs_(cut.runs),
        brick_(brick),
        box_(bricks_.boxes[brick]),
        cut_(cut.cuts[brick]),
        out_(out) {}

  void run() {
    for (const OpenFace& open : cut_.openFaces) join(open.component, box_.cellAt(open.cell));
    for (const BoundaryFace& face : cut_.boundaryFaces) findFace(face);
    for (const BoundaryLine& line : cut_.boundaryLines) findLine(line);
    countRows();
  }

 private:
  static uint32_t keyOf(uint32_t cell, int element) { return 32 * cell + uint32_t(element); }

  /// Of two cells the one below the plane comes first, so the grid-face belongs to that one.
  void findFace(const BoundaryFace& face) {
    const int axis = face.index >> 1, side = face.index & 1;
    Slab other = box_.cellAt(face.cell);
    other[size_t(axis)] += side == 1 ? 2 : -2;
    const auto brick = bricks_.findTouched(other);
    if (!brick) return join(cut_.boundaryHalves[face.halves.first].component, other);  // the grid-face is whole
    const bool isOwn = side == 1;
    const BrickId owner = isOwn ? brick_ : *brick;
    const uint32_t key = isOwn ? keyOf(face.cell, face.index) : keyOf(bricks_.boxes[owner].indexOf(other), cellFace(axis, 1));
    out_.triFaces.add(isOwn, {owner, key, face.triFaces});
    out_.pieces.add(isOwn, {owner, key, face.pieces});
    out_.halves.add(isOwn, {owner, key, face.halves});
  }

  void findLine(const BoundaryLine& line) {
    const Slab cell = box_.cellAt(line.cell), element = elementOf(cell, line.index);
    BrickId owner = brick_;
    uint32_t key = keyOf(line.cell, line.index);
    findCellAround(element, [&](const Slab& other) {
      if (other == cell) return true;
      const auto brick = input_.inGrid(other) ? bricks_.findTouched(other) : std::nullopt;
      if (!brick) return false;
      owner = *brick;
      key = keyOf(bricks_.boxes[owner].indexOf(other), indexIn(other, element));
      return true;
    });
    out_.vertices.add(owner == brick_, {owner, key, line.vertices});
  }

  /// The grid vertex or grid-edge of a cell, and its number there.
  static Slab elementOf(const Slab& cell, uint32_t index) {
    Slab element = cell;
    for (size_t d = 0; d < 3 && index < 8; ++d) element[d] += index >> d & 1 ? 1 : -1;
    if (index < 8) return element;
    const size_t along = size_t(index - 8) / 4;
    element[(along + 1) % 3] += index & 1 ? 1 : -1;
    element[(along + 2) % 3] += index & 2 ? 1 : -1;
    return element;
  }
  static int indexIn(const Slab& cell, const Slab& element) {
    const auto side = [&](size_t d) { return int(element[d] > cell[d]); };
    for (size_t along = 0; along < 3; ++along) {
      if (!onPlane(element[along])) return 8 + cellEdge(int(along), side((along + 1) % 3), side((along + 2) % 3));
    }
    return side(0) + 2 * side(1) + 4 * side(2);
  }

  /// Leaves out most of those that are known: runs along a surface are met again and again.
  void join(uint32_t component, const Slab& untouched) {
    constexpr size_t kLast = 16;
    const uint32_t run = runs_.at(untouched);
    const auto isSame = [&](const SeamJoin& join) { return join.component == component && join.run == run; };
    const auto last = out_.joins.rbegin(), past = last + ptrdiff_t(std::min(kLast, out_.joins.size()));
    if (std::none_of(last, past, isSame)) out_.joins.push_back({untouched, component, run});
  }

  void countRows() {
    out_.rows.resize(cut_.rows.size());
    for (size_t r = 0; r < cut_.rows.size(); ++r) out_.rows[r].cells = cut_.rows[r].pastCell - (r == 0 ? 0 : cut_.rows[r - 1].pastCell);
    const auto countOwn = [&](uint32_t BrickRow::*pastInRow, const SeamRanges& seams, uint32_t BrickCounts::*count) {
      forOwn(cut_, pastInRow, seams, [&](uint32_t row, uint32_t first, uint32_t past) { out_.rows[row].*count += past - first; });
    };
    countOwn(&BrickRow::pastVertex, out_.vertices, &BrickCounts::vertices);
    countOwn(&BrickRow::pastTriFace, out_.triFaces, &BrickCounts::triFaces);
    countOwn(&BrickRow::pastPiece, out_.pieces, &BrickCounts::pieces);
    if (bricks_.here.has(brick_)) countArrays();
  }

  /// What only the process that cuts the brick knows.
  void countArrays() {
    uint32_t cell = 0;
    for (size_t r = 0; r < cut_.rows.size(); ++r) {
      out_.rows[r].halfFaces = cut_.halfFaces.offsets[cut_.rows[r].pastCell] - cut_.halfFaces.offsets[cell];
      cell = cut_.rows[r].pastCell;
    }
    const FaceParents parents(input_, cut_.triangles, cut_.otherParents);
    const bool areSingle = parents.areSingle();
    forOwn(cut_, &BrickRow::pastTriFace, out_.triFaces, [&](uint32_t row, uint32_t first, uint32_t past) {
      BrickCounts& counts = out_.rows[row];
      counts.triLoops += cut_.triLoops.loopCount(first, past);
      counts.triLoopVertices += cut_.triLoops.vertexCount(first, past);
      if (areSingle) {
        counts.parents += past - first;
        return;
      }
      for (uint32_t i = first; i < past; ++i) parents.forEach({i}, [&](TriangleId, bool) { ++counts.parents; });
    });
    forOwn(cut_, &BrickRow::pastPiece, out_.pieces, [&](uint32_t row, uint32_t first, uint32_t past) {
      BrickCounts& counts = out_.rows[row];
      counts.loops += cut_.pieceLoops.loopCount(first, past);
      counts.loopVertices += cut_.pieceLoops.vertexCount(first, past);
    });
  }

  const Input& input_;
  const Bricks& bricks_;
  const UntouchedRuns& runs_;
  const BrickId brick_;
  const BrickBox& box_;
  const BrickCut& cut_;
  BrickSeams& out_;
};

/// Finds what a brick has of others in the lists of these.
void findThere(IdVector<BrickId, BrickSeams>& seams, BrickId brick) {
  for (SeamRanges BrickSeams::*kind : {&BrickSeams::triFaces, &BrickSeams::pieces, &BrickSeams::halves, &BrickSeams::vertices}) {
    for (SeamRange& other : (seams[brick].*kind).others) {
      const std::vector<SeamRange>& own = (seams[other.owner].*kind).own;
      const auto at =
          std::lower_bound(own.begin(), own.end(), other.key, [](const SeamRange& range, uint32_t key) { return range.key < key; });
      other.there = at->range.first;
    }
  }
}

}  // namespace

void BrickCounts::add(const BrickCounts& more) {
  cells += more.cells;
  halfFaces += more.halfFaces;
  triFaces += more.triFaces;
  triLoops += more.triLoops;
  triLoopVertices += more.triLoopVertices;
  parents += more.parents;
  pieces += more.pieces;
  loops += more.loops;
  loopVertices += more.loopVertices;
  vertices += more.vertices;
}

void findSeams(const CutBricks& cut, const KeptBricks* kept, IdVector<BrickId, BrickSeams>& seams, Run& run) {
  seams.resize(cut.cuts.size());
  const std::vector<uint32_t> order = BricksHere{{0}, {uint32_t(seams.size())}}.numbers(run.monitor.threads());
  const auto forFound = [&](const auto& f) {
    runItems(order, run.monitor, [&](size_t, uint32_t b) {
      if (!kept || !kept->isInner({b})) f(BrickId{b});
    });
  };
  forFound([&](BrickId b) { SeamFinder(cut, b, seams[b]).run(); });
  forFound([&](BrickId b) { findThere(seams, b); });
}

}  // namespace mandoline::detail
