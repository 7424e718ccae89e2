#include "cut/stages/kept_rows.h"

#include <array>
#include <numeric>

namespace mandoline::detail {
namespace {

constexpr std::array kAllCounts{&BrickCounts::cells,        &BrickCounts::halfFaces,       &BrickCounts::triFaces, &BrickCounts::triLoops,
                                &BrickCounts::parents,      &BrickCounts::triLoopVertices, &BrickCounts::pieces,   &BrickCounts::loops,
                                &BrickCounts::loopVertices, &BrickCounts::vertices};

class RowFinder {
 public:
  RowFinder(const VerticesBefore& before, const KeptBricks& kept, const CutBricks& cut, const Numbers& numbers)
      : before_(before), kept_(kept), cut_(cut), numbers_(numbers) {
    out_.total = numbers.total;
    out_.totalBefore = before.numbers.total;
  }

  KeptRows run() {
    for (const auto& [brick, row] : numbers_.order) {
      if (kept_.isInner(brick))
        add({numbers_.rows[brick][row], before_.numbers.rows[kept_.before[brick]][row], cut_.seams[brick].rows[row]});
    }
    findFacesNow();
    return std::move(out_);
  }

 private:
  void add(const KeptRows::Run& row) {
    if (out_.runs.empty() || !follows(row, out_.runs.back())) return out_.runs.push_back(row);
    out_.runs.back().count.add(row.count);
  }
  static bool follows(const KeptRows::Run& row, const KeptRows::Run& last) {
    return std::all_of(kAllCounts.begin(), kAllCounts.end(), [&](auto kind) {
      return last.now.*kind + last.count.*kind == row.now.*kind && last.before.*kind + last.count.*kind == row.before.*kind;
    });
  }

  void findFacesNow() {
    const BrickCounts& before = out_.totalBefore;
    out_.facesNow = out_.ofFaces(&BrickCounts::triFaces, &BrickCounts::pieces).numbersNow(size_t(before.triFaces) + before.pieces);
    for (const BrickId b : cut_.bricks.ids()) {
      if (kept_.has(b) && !kept_.isInner(b)) addFacesOf(b);
    }
  }
  /// Cells of inner bricks beside a kept one have faces of it.
  void addFacesOf(BrickId brick) {
    const BrickCut& cut = cut_.cuts[brick];
    const BrickId was = kept_.before[brick];
    const uint32_t* now = numbers_.faces[brick].data();
    const auto addKind = [&](const RowKind& kind, uint32_t firstOfKind) {
      forOwnNumbers(cut, before_.seams[was], before_.numbers.rows[was], kind, [&](uint32_t first, uint32_t past, uint32_t number) {
        std::copy(now + first, now + past, out_.facesNow.get() + firstOfKind + number);
      });
    };
    addKind(kTriFaceRows, 0);
    now += cut.triangles.size();
    addKind(kPieceRows, out_.totalBefore.triFaces);
  }

  const VerticesBefore& before_;
  const KeptBricks& kept_;
  const CutBricks& cut_;
  const Numbers& numbers_;
  KeptRows out_;
};

}  // namespace

KeptRuns KeptRows::of(uint32_t BrickCounts::*kind) const {
  KeptRuns result;
  result.runs.reserve(runs.size());
  for (const Run& run : runs) result.runs.push_back({run.now.*kind, run.before.*kind, run.count.*kind});
  return result;
}

KeptRuns KeptRows::ofFaces(uint32_t BrickCounts::*ofTriFaces, uint32_t BrickCounts::*ofPieces) const {
  KeptRuns result = of(ofTriFaces);
  for (KeptRuns::Run run : of(ofPieces).runs) {
    run.first += total.*ofTriFaces;
    run.before += totalBefore.*ofTriFaces;
    result.runs.push_back(run);
  }
  return result;
}

KeptRows findKeptRows(const VerticesBefore& before, const KeptBricks& kept, const CutBricks& cut, const Numbers& numbers) {
  return RowFinder(before, kept, cut, numbers).run();
}

}  // namespace mandoline::detail
