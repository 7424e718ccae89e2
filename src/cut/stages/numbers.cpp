#include "cut/stages/numbers.h"

#include <atomic>
#include <numeric>

namespace mandoline::detail {
namespace {

class Numberer {
 public:
  Numberer(const Surface& surface, const IdVector<BrickId, BrickCut>& cuts, const IdVector<BrickId, BrickSeams>& seams, Numbers& out)
      : vertices_(surface.vertices), cuts_(cuts), seams_(seams), out_(out), isUsed_(vertices_.firstInTriangle.number) {
    out_.ofSurface.assign(vertices_.size(), Numbers::kUnused);
    out_.ofBrick.resize(cuts.size());
    out_.faces.resize(cuts.size());
  }

  /// Where the ranges of all rows begin: rows in order, and in each the bricks along x.
  void numberRows() {
    struct Part {
      BrickId brick;
      uint32_t row;
    };
    std::vector<Part> parts;
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
    uint64_t entries = 0, halfFaces = 0, vertices = vertices_.firstInTriangle.number;
    for (const KeyedItem& at : order) {
      const auto& [brick, row] = parts[at.item];
      const BrickCounts& counts = seams_[brick].rows[row];
      out_.rows[brick][row] = out_.total;
      out_.total.add(counts);
      entries += uint64_t(counts.triLoopVertices) + counts.loopVertices;
      halfFaces += counts.halfFaces;
      vertices += counts.vertices;
      constexpr uint64_t kMost = uint64_t(1) << 31;
      if (std::max({entries, halfFaces, vertices}) > kMost) {
        throw Failure{{Status::meshTooLarge, -1, -1, "The cut-mesh would have more than 2^31 vertices, loop entries or half-faces."}};
      }
    }
  }

  /// Notes which vertices of the mesh and its edges the loops of a brick have.
  void noteUsed(BrickId brick) {
    for (const auto* loops : {&cuts_[brick].triLoops, &cuts_[brick].loops}) {
      for (const VertexId v : loops->items) {
        if (v < vertices_.firstInTriangle) isUsed_[v.number].store(1, std::memory_order_relaxed);
      }
    }
  }
  void numberSurface() {
    for (uint32_t v = 0; v < isUsed_.size(); ++v) {
      if (isUsed_[v].load(std::memory_order_relaxed)) out_.ofSurface[{v}] = out_.surfaceVertices++;
    }
  }

  void numberOwn(BrickId brick) {
    const BrickCut& cut = cuts_[brick];
    const BrickSeams& seams = seams_[brick];
    std::vector<BrickCounts> next = out_.rows[brick];
    std::vector<uint32_t>& faces = out_.faces[brick];
    faces.resize(cut.faceCount());
    forOwn(cut, &BrickRow::pastTriFace, seams.triFaces, [&](uint32_t row, uint32_t first, uint32_t past) {
      for (uint32_t i = first; i < past; ++i) faces[cut.triOrder[i].number] = next[row].triFaces++;
    });
    const uint32_t triFaces = uint32_t(cut.triangles.size());
    forOwn(cut, &BrickRow::pastPiece, seams.pieces, [&](uint32_t row, uint32_t first, uint32_t past) {
      for (uint32_t piece = first; piece < past; ++piece) faces[triFaces + piece] = out_.total.triFaces + next[row].pieces++;
    });
    out_.ofBrick[brick].assign(cut.vertices.slabs.size(), Numbers::kUnused);
    forOwn(cut, &BrickRow::pastVertex, seams.vertices, [&](uint32_t row, uint32_t first, uint32_t past) {
      for (uint32_t i = first; i < past; ++i) set(brick, cut.lineVertices[i], out_.surfaceVertices + next[row].vertices++);
    });
  }

  /// Looks up the numbers of what belongs to other bricks.
  void numberOthers(BrickId brick) {
    const BrickCut& cut = cuts_[brick];
    forOthers(seams_, brick, &BrickSeams::triFaces, [&](const SeamRange& other, uint32_t first) {
      for (uint32_t i = 0; i < other.range.count; ++i) {
        const FaceId mine = cut.triOrder[other.range.first + i], theirs = cuts_[other.owner].triOrder[first + i];
        out_.faces[brick][mine.number] = out_.faces[other.owner][theirs.number];
      }
    });
    const size_t triFaces = cut.triangles.size();
    forOthers(seams_, brick, &BrickSeams::pieces, [&](const SeamRange& other, uint32_t first) {
      const uint32_t* theirs = &out_.faces[other.owner][cuts_[other.owner].triangles.size() + first];
      std::copy_n(theirs, other.range.count, &out_.faces[brick][triFaces + other.range.first]);
    });
    forOthers(seams_, brick, &BrickSeams::vertices, [&](const SeamRange& other, uint32_t first) {
      for (uint32_t i = 0; i < other.range.count; ++i) {
        const VertexId v = cut.lineVertices[other.range.first + i];
        if (v >= cut.vertices.firstOwn) set(brick, v, out_.vertex(other.owner, cuts_[other.owner].lineVertices[first + i]));
      }
    });
  }

 private:
  void set(BrickId brick, VertexId v, uint32_t number) {
    const VertexId firstOwn = cuts_[brick].vertices.firstOwn;
    (v < firstOwn ? out_.ofSurface[v] : out_.ofBrick[brick][v.number - firstOwn.number]) = number;
  }

  const CutVertices& vertices_;
  const IdVector<BrickId, BrickCut>& cuts_;
  const IdVector<BrickId, BrickSeams>& seams_;
  Numbers& out_;
  std::vector<std::atomic<uint8_t>> isUsed_;  // per vertex of the mesh and its edges; several bricks may have it
};

}  // namespace

Numbers makeNumbers(const Surface& surface, const IdVector<BrickId, BrickCut>& cuts, const IdVector<BrickId, BrickSeams>& seams, Run& run) {
  Numbers numbers;
  Numberer numberer(surface, cuts, seams, numbers);
  std::vector<uint32_t> order(cuts.size());
  std::iota(order.begin(), order.end(), 0u);
  numberer.numberRows();
  runItems(order, run.monitor, [&](size_t, uint32_t b) { numberer.noteUsed({b}); });
  numberer.numberSurface();
  runItems(order, run.monitor, [&](size_t, uint32_t b) { numberer.numberOwn({b}); });
  runItems(order, run.monitor, [&](size_t, uint32_t b) { numberer.numberOthers({b}); });
  return numbers;
}

}  // namespace mandoline::detail
