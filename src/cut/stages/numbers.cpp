#include "cut/stages/numbers.h"

#include <array>
#include <numeric>

#include "base/run_tasks.h"

namespace mandoline::detail {
namespace {

class Numberer {
 public:
  Numberer(const CutBricks& cut, Numbers& out) : cut_(cut), vertices_(cut.surface.vertices), cuts_(cut.cuts), seams_(cut.seams), out_(out) {
    out_.ofBrick.resize(cuts_.size());
    out_.faces.resize(cuts_.size());
  }

  /// Where the ranges of all rows begin: rows in order, and in each the bricks along x.
  void numberRows() {
    std::vector<Numbers::RowOfBrick> parts;
    std::vector<KeyedItem> order;
    uint32_t last = 0;
    for (const BrickId b : cuts_.ids()) {
      out_.rows.push_back({});
      out_.rows[b].resize(cuts_[b].rows.size());
      for (uint32_t r = 0; r < cuts_[b].rows.size(); ++r) {
        last = std::max(last, cuts_[b].rows[r].row);
        order.push_back({cuts_[b].rows[r].row, uint32_t(parts.size())});
        parts.push_back({b, r});
      }
    }
    sortByKey(order, last);
    out_.order.reserve(parts.size());
    for (const KeyedItem& at : order) {
      const auto& [brick, row] = out_.order.emplace_back(parts[at.item]);
      const BrickCounts& counts = seams_[brick].rows[row];
      out_.rows[brick][row] = out_.total;
      out_.total.add(counts);
      if (cut_.bricks.here.has(brick)) {
        out_.here.add(counts);
      } else if (brick < cut_.bricks.here.first) {
        out_.before.add(counts);
      }
      requireFew(vertices_.firstInTriangle.number, out_.total);
    }
  }

  void numberSurface(const UsedVertices& used, SurfaceNumbers* ofAll) {
    if (ofAll) {
      out_.ofSurface = std::move(ofAll->ofSurface);
      out_.ofSurface.resize(vertices_.size(), Numbers::kUnused);
      out_.surfaceVertices = ofAll->count;
      return;
    }
    out_.ofSurface.assign(vertices_.size(), Numbers::kUnused);
    uint32_t next = 0;
    uint32_t* const numbers = out_.ofSurface.data();
    for (uint32_t v = 0; v < used.size(); ++v) {
      const bool isUsed = used[v].load(std::memory_order_relaxed) != 0;
      numbers[v] = isUsed ? next : Numbers::kUnused;
      next += isUsed;
    }
    out_.surfaceVertices = next;
  }

  void numberOwn(BrickId brick) {
    const BrickCut& cut = cuts_[brick];
    out_.faces[brick].resize(cut.faceCount());
    out_.ofBrick[brick].assign(cut.vertices.slabs.size(), Numbers::kUnused);
    uint32_t* faces = out_.faces[brick].data();
    const auto forOwnOf = [&](const RowKind& kind, const auto& f) { forOwnNumbers(cut, seams_[brick], out_.rows[brick], kind, f); };
    forOwnOf(kTriFaceRows, [&](uint32_t first, uint32_t past, uint32_t face) { std::iota(faces + first, faces + past, face); });
    faces += cut.triangles.size();
    forOwnOf(kPieceRows,
             [&](uint32_t first, uint32_t past, uint32_t piece) { std::iota(faces + first, faces + past, out_.total.triFaces + piece); });
    forOwnOf(kVertexRows, [&](uint32_t first, uint32_t past, uint32_t vertex) {
      for (uint32_t i = first; i < past; ++i) set(brick, cut.lineVertices[i], out_.surfaceVertices + vertex++);
    });
  }

  /// What belongs to other bricks, once all have numbered their own. Vertices of the surface get their numbers from those.
  void numberOthers(BrickId brick) {
    const BrickCut& cut = cuts_[brick];
    forOthersOf(brick, kTriFaceRows, [&](uint32_t i, BrickId, uint32_t face) { out_.faces[brick][i] = face; });
    forOthersOf(brick, kPieceRows,
                [&](uint32_t i, BrickId, uint32_t piece) { out_.faces[brick][cut.triangles.size() + i] = out_.total.triFaces + piece; });
    forOthersOf(brick, kVertexRows, [&](uint32_t i, BrickId, uint32_t vertex) {
      if (cut.lineVertices[i] >= cut.vertices.firstOwn) set(brick, cut.lineVertices[i], out_.surfaceVertices + vertex);
    });
  }

  /// The vertices of the surface that get their numbers from bricks that are cut elsewhere.
  void numberSurfaceFromElsewhere(BrickId brick) {
    const BrickCut& cut = cuts_[brick];
    forOthersOf(brick, kVertexRows, [&](uint32_t i, BrickId owner, uint32_t vertex) {
      if (cut.lineVertices[i] < cut.vertices.firstOwn && !cut_.bricks.here.has(owner))
        set(brick, cut.lineVertices[i], out_.surfaceVertices + vertex);
    });
  }

 private:
  /// `total`, of which what other processes cut has no lengths of arrays.
  static void requireFew(uint64_t surfaceVertices, const BrickCounts& total) {
    const uint64_t entries = uint64_t(total.triLoopVertices) + total.loopVertices, faces = uint64_t(total.triFaces) + total.pieces;
    requireFewIds(std::max({entries, faces, uint64_t(total.halfFaces), surfaceVertices + total.vertices}));
  }

  /// Calls f(place, owner, number of that kind) for what a brick has of others.
  template <class F>
  void forOthersOf(BrickId brick, const RowKind& kind, const F& f) const {
    for (const SeamRange& other : (seams_[brick].*kind.seams).others) {
      const uint32_t number = numberAt(other.owner, kind, other.there);
      for (uint32_t i = 0; i < other.range.count; ++i) f(other.range.first + i, other.owner, number + i);
    }
  }

  /// The number of what a brick owns at a place of its list.
  uint32_t numberAt(BrickId owner, const RowKind& kind, uint32_t place) const {
    return cut_.bricks.here.has(owner) ? numberHere(owner, kind, place) : numberElsewhere(owner, kind, place);
  }
  uint32_t numberHere(BrickId owner, const RowKind& kind, uint32_t place) const {
    if (kind.seams == kVertexRows.seams) return out_.vertex(owner, cuts_[owner].lineVertices[place]) - out_.surfaceVertices;
    if (kind.seams == kTriFaceRows.seams) return out_.faces[owner][place];
    return out_.faces[owner][cuts_[owner].triangles.size() + place] - out_.total.triFaces;
  }
  uint32_t numberElsewhere(BrickId owner, const RowKind& kind, uint32_t place) const {
    const auto rows = cuts_[owner].rows;
    const auto row = std::upper_bound(rows.begin(), rows.end(), place, [&](uint32_t at, const BrickRow& r) { return at < r.*kind.past; });
    const uint32_t first = row == rows.begin() ? 0 : row[-1].*kind.past;
    const std::vector<SeamRange>& others = (seams_[owner].*kind.seams).others;
    auto other = std::lower_bound(others.begin(), others.end(), first, [](const SeamRange& r, uint32_t at) { return r.range.first < at; });
    uint32_t count = place - first;
    for (; other != others.end() && other->range.first < place; ++other) count -= other->range.count;
    return out_.rows[owner][size_t(row - rows.begin())].*kind.count + count;
  }

  void set(BrickId brick, VertexId v, uint32_t number) {
    const VertexId firstOwn = cuts_[brick].vertices.firstOwn;
    (v < firstOwn ? out_.ofSurface[v] : out_.ofBrick[brick][v.number - firstOwn.number]) = number;
  }

  const CutBricks& cut_;
  const CutVertices& vertices_;
  const IdVector<BrickId, BrickCut>& cuts_;
  const IdVector<BrickId, BrickSeams>& seams_;
  Numbers& out_;
};

}  // namespace

void requireFewIds(uint64_t count) {
  constexpr uint64_t kMost = uint64_t(1) << 31;
  if (count <= kMost) return;
  throw Failure{{Status::meshTooLarge, -1, -1, "The cut-mesh would have more than 2^31 vertices, loop entries or half-faces."}};
}

UsedVertices findUsed(const Surface& surface, const Bricks& bricks, const IdVector<BrickId, BrickCut>& cuts, Run& run) {
  const VertexId past = surface.vertices.firstInTriangle;
  UsedVertices used(past.number);
  runItems(bricks.here.numbers(), run.monitor, [&](size_t, uint32_t b) {
    for (const VertexId v : cuts[{b}].surfaceVertices) {
      if (v < past) used[v.number].store(1, std::memory_order_relaxed);
    }
  });
  return used;
}

Numbers makeNumbers(const CutBricks& cut, const BricksToNumber& bricks, const UsedVertices& used, SurfaceNumbers* ofAll, Run& run) {
  Numbers numbers;
  Numberer numberer(cut, numbers);
  const std::array<std::function<void()>, 2> both{[&] { numberer.numberRows(); }, [&] { numberer.numberSurface(used, ofAll); }};
  runTasks(both, run.monitor);
  runItems(bricks.own, run.monitor, [&](size_t, uint32_t b) { numberer.numberOwn({b}); });
  if (cut.bricks.here.isShare) {
    for (const BrickId b : cut.bricks.here.ids()) numberer.numberSurfaceFromElsewhere(b);
  }
  runItems(bricks.others, run.monitor, [&](size_t, uint32_t b) { numberer.numberOthers({b}); });
  return numbers;
}

}  // namespace mandoline::detail
