#include "cut/stages/write_brick.h"

#include <algorithm>
#include <numeric>

namespace mandoline::detail {
namespace {

class FaceWriter {
 public:
  FaceWriter(const CutState& state, BrickId brick, CutMesh& out)
      : state_(state),
        numbers_(state.numbers),
        brick_(brick),
        cut_(state.cuts[brick]),
        parents_(state.surface.input, cut_.triangles, cut_.otherParents),
        at_(numbers_.rows[brick]),
        out_(out) {
    const std::vector<uint32_t>& own = numbers_.ofBrick[brick];
    vertices_.reserve(own.size() + cut_.surfaceVertices.size());
    vertices_.assign(own.begin(), own.end());
    vertices_.resize(own.size() + cut_.surfaceVertices.size());
    std::transform(cut_.surfaceVertices.begin(), cut_.surfaceVertices.end(), vertices_.begin() + ptrdiff_t(own.size()),
                   [&](VertexId v) { return numbers_.ofSurface[v]; });
    for (BrickCounts& at : at_) {  // pieces come after all tri-cut-faces
      at.loops += numbers_.total.triLoops;
      at.loopVertices += numbers_.total.triLoopVertices;
    }
  }

  void run() {
    const BrickSeams& seams = state_.seams[brick_];
    forOwn(cut_, &BrickRow::pastTriFace, seams.triFaces, [&](uint32_t row, uint32_t first, uint32_t past) {
      const uint32_t f = placeOf(first);
      copyTriangles(first, past, &out_.faceTriangle[f]);
      writeLoops(cut_.triLoops, {first, past}, f, {at_[row].triLoops, at_[row].triLoopVertices});
      if (parents_.areSingle()) {
        writeSingleParents(first, past, f, at_[row].parents);
      } else {
        writeParents(first, past, f, at_[row].parents);
      }
      writePlanes(first, past, f);
    });
    forOwn(cut_, &BrickRow::pastPiece, seams.pieces, [&](uint32_t row, uint32_t first, uint32_t past) {
      const uint32_t f = placeOf(uint32_t(cut_.triangles.size()) + first);
      for (uint32_t i = first; i < past; ++i) writePlane(cut_.pieces[i], f + i - first);
      writeLoops(cut_.pieceLoops, {first, past}, f, {at_[row].loops, at_[row].loopVertices});
    });
  }

 private:
  uint32_t placeOf(uint32_t face) const { return numbers_.placeHere(numbers_.faces[brick_][face]); }

  void writePlane(const AxialPlane& plane, uint32_t f) {
    out_.faceAxis[f] = int8_t(plane.axis);
    out_.facePlane[f] = plane.plane;
  }
  /// Of tri-cut-faces.
  void writePlanes(uint32_t first, uint32_t past, uint32_t f) {
    const auto inPlane = cut_.triFacesInPlane;
    auto at = std::lower_bound(inPlane.begin(), inPlane.end(), first, [](const InPlane& face, uint32_t i) { return face.face < i; });
    for (; at != inPlane.end() && at->face < past; ++at) writePlane(at->plane, f + at->face - first);
  }

  /// Where loops and their vertices go.
  struct LoopsAt {
    uint32_t &loops, &vertices;
  };

  /// Those of faces first .. past - 1; `f` is the first one's place.
  void writeLoops(const FaceLoops& from, const IdRange& faces, uint32_t f, const LoopsAt& to) {
    const uint32_t first = uint32_t(faces.begin), past = uint32_t(faces.end), firstLoop = from.firstLoop(first),
                   loopCount = from.loopCount(first, past), vertexCount = from.vertexCount(first, past);
    const uint32_t* offsets = &from.loops.offsets[firstLoop];
    const uint32_t firstVertex = offsets[0], loopShift = to.loops - firstLoop, shift = to.vertices - firstVertex;
    uint32_t* loops = &out_.faceLoopOffsets[f];
    if (from.offsets.empty()) {
      std::iota(loops, loops + (past - first), to.loops);
    } else {
      for (uint32_t i = first; i < past; ++i) *loops++ = from.firstLoop(i) + loopShift;
    }
    std::transform(offsets, offsets + loopCount, out_.loopOffsets.begin() + to.loops, [=](uint32_t offset) { return offset + shift; });
    const uint32_t* places = from.loops.items.data() + firstVertex;
    const uint32_t* vertices = vertices_.data();
    std::transform(places, places + vertexCount, out_.loopVertices.begin() + to.vertices, [=](uint32_t place) { return vertices[place]; });
    to.loops += loopCount;
    to.vertices += vertexCount;
  }

  template <class Number>
  void copyTriangles(uint32_t first, uint32_t past, Number* to) const {
    const TriangleId* triangles = cut_.triangles.data();
    std::transform(triangles + first, triangles + past, to, [](TriangleId t) { return Number(t.number); });
  }

  /// Whose signs are 1, as they all are at first.
  void writeSingleParents(uint32_t first, uint32_t past, uint32_t f, uint32_t& at) {
    const uint32_t count = past - first;
    std::iota(&out_.faceParentOffsets[f], &out_.faceParentOffsets[f] + count, at);
    copyTriangles(first, past, &out_.faceParents[at]);
    at += count;
  }

  /// The triangles that faces are pieces of, in each ascending.
  void writeParents(uint32_t first, uint32_t past, uint32_t f, uint32_t& at) {
    const auto write = [&](uint32_t place, uint32_t triangle, int8_t sign) {
      out_.faceParents[place] = triangle;
      out_.faceParentSigns[place] = sign;
    };
    for (uint32_t i = first; i < past; ++i, ++f) {
      const uint32_t firstOfFace = out_.faceParentOffsets[f] = at;
      parents_.forEach({i}, [&](TriangleId t, bool sameWay) {
        uint32_t place = at++;
        for (; place > firstOfFace && out_.faceParents[place - 1] > t.number; --place)
          write(place, out_.faceParents[place - 1], out_.faceParentSigns[place - 1]);
        write(place, t.number, sameWay ? 1 : -1);
      });
    }
  }

  const CutState& state_;
  const Numbers& numbers_;
  const BrickId brick_;
  const BrickCut& cut_;
  const FaceParents parents_;
  std::vector<BrickCounts> at_;     // per row: where what comes next goes
  std::vector<uint32_t> vertices_;  // per place in loops: the vertex's number
  CutMesh& out_;
};

}  // namespace

void writeFaces(const CutState& state, BrickId brick, CutMesh& out) { FaceWriter(state, brick, out).run(); }

void writeCells(const CutState& state, BrickId brick, CutMesh& out) {
  const Numbers& numbers = state.numbers;
  const BrickCut& cut = state.cuts[brick];
  const BrickBox& box = state.bricks.boxes[brick];
  const uint32_t* faces = numbers.faces[brick].data();
  const auto offsets = cut.halfFaces.offsets;
  const HalfFace* halfFaces = cut.halfFaces.items.data();
  CellId cell{0};
  for (uint32_t row = 0; row < cut.rows.size(); ++row) {
    const uint32_t past = cut.rows[row].pastCell;
    if (cell.number == past) continue;
    const uint32_t at = numbers.rows[brick][row].halfFaces, shift = at - offsets[cell.number];
    uint32_t c = numbers.rows[brick][row].cells - numbers.before.cells;
    std::transform(halfFaces + offsets[cell.number], halfFaces + offsets[past], out.cellHalfFaces.begin() + at,
                   [=](HalfFace h) { return HalfFace({faces[h.face().number]}, h.side()).number; });
    std::transform(&offsets[cell.number], &offsets[past], out.cellHalfFaceOffsets.begin() + c, [=](uint32_t o) { return o + shift; });
    const uint32_t firstIndex = cut.gridCells[cell];
    const Slab first = box.cellAt(firstIndex);  // the others lie beside it, along x
    int32_t* gridCells = &out.cellGridCell[3 * size_t(c)];
    for (; cell.number < past; ++cell.number, ++c) {
      *gridCells++ = (first[0] >> 1) + int32_t(cut.gridCells[cell] - firstIndex);
      *gridCells++ = first[1] >> 1;
      *gridCells++ = first[2] >> 1;
    }
  }
}

void writeRegions(const CutState& state, BrickId brick, CutMesh& out) {
  const Numbers& numbers = state.numbers;
  const BrickCut& cut = state.cuts[brick];
  const uint32_t* regions = state.regions.ofComponents[brick].data();
  CellId cell{0};
  for (uint32_t row = 0; row < cut.rows.size(); ++row) {
    uint32_t c = numbers.rows[brick][row].cells - numbers.before.cells;
    for (; cell.number < cut.rows[row].pastCell; ++cell.number) out.cellRegion[c++] = regions[cut.components[cell]];
  }
}

}  // namespace mandoline::detail
