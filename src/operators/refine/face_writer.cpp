#include "operators/refine/face_writer.h"

#include "base/large_array.h"
#include "base/run_tasks.h"
#include "mesh/failure.h"

namespace mandoline::refining {
namespace {

/// Numbers of faces and what they have, or where that begins.
struct Counts {
  size_t faces = 0, loops = 0, corners = 0, parents = 0;

  Counts operator+(const Counts& c) const { return {faces + c.faces, loops + c.loops, corners + c.corners, parents + c.parents}; }
};
using Place = std::array<Counts, 2>;  // faces of cut-cells, and others

class FaceWriter {
 public:
  FaceWriter(const Assembled& assembled, const Sources& sources, detail::Monitor& monitor, CellComplex& cells, CutMesh& cutMesh)
      : assembled_(assembled), sources_(sources), monitor_(monitor), cells_(cells), cutMesh_(cutMesh) {}

  void run() {
    std::vector<std::vector<Place>> places;  // per level and chunk
    for (const LevelFaces& level : assembled_.levels) {
      places.push_back(detail::forChunks<Place>(level.faces.size(), monitor_, [&](Place& counts, size_t begin, size_t end) {
        LoopMaker loops(sources_, level);
        for (size_t f = begin; f < end; ++f) count(level.faces[f], loops, counts);
      }));
    }
    makeRoom(places);
    for (size_t l = 0; l < places.size(); ++l) {
      const LevelFaces& level = assembled_.levels[l];
      const auto write = [&](size_t chunk, size_t begin, size_t end) {
        LoopMaker loops(sources_, level);
        for (size_t f = begin; f < end; ++f) writeFace(level.faces[f], loops, places[l][chunk]);
      };
      detail::runChunks(level.faces.size(), places[l].size(), monitor_, write, kBlock);
    }
  }

 private:
  static constexpr size_t kBlock = 2048;

  bool isPlain(const LevelFace& face) const {
    const auto isCut = [&](int32_t cell) { return cell >= 0 && uint32_t(cell) < assembled_.cutCells; };
    return !isCut(face.cells[0]) && !isCut(face.cells[1]);
  }

  void count(const LevelFace& face, LoopMaker& loops, Place& place) const {
    Counts& counts = place[isPlain(face)];
    ++counts.faces;
    loops.forLoops(face, [&](std::span<const uint32_t> loop) {
      ++counts.loops;
      counts.corners += loop.size();
    });
    if (face.isWhole()) return;
    const std::vector<uint32_t>& offsets = sources_.parts[face.part].cutMesh().faceParentOffsets;
    counts.parents += offsets[face.face + 1] - offsets[face.face];
  }

  /// Turns counts into places.
  void makeRoom(std::vector<std::vector<Place>>& places) {
    Counts next, cut;
    for (const bool plain : {false, true}) {
      for (std::vector<Place>& level : places) {
        for (Place& place : level) {
          const Counts past = next + place[plain];
          place[plain] = std::exchange(next, past);
        }
      }
      if (!plain) cut = next;
    }
    if (next.corners >> 31 != 0) throw detail::Failure{{Status::meshTooLarge, -1, -1, "The faces have more than 2^31 corners."}};
    cells_.cutFaces = uint32_t(cut.faces);
    cells_.faceLoopOffsets.clear();
    cells_.loopOffsets.clear();
    const std::function<void()> tasks[] = {
        // memory takes longest
        [&] { detail::makeLarge(cells_.faceNormal, 3 * next.faces); },      [&] { detail::makeLarge(cells_.faceCentroid, 3 * next.faces); },
        [&] { detail::makeLarge(cells_.loopVertices, next.corners); },      [&] { detail::makeLarge(cells_.faceArea, next.faces); },
        [&] { detail::makeLarge(cells_.faceCells, 2 * next.faces); },       [&] { detail::makeLarge(cells_.loopOffsets, next.loops + 1); },
        [&] { detail::makeLarge(cells_.faceLoopOffsets, next.faces + 1); }, [&] { detail::makeLarge(cells_.faceTag, next.faces); },
    };
    detail::runTasks(tasks, monitor_);
    cutMesh_.faceTriangle.resize(cut.faces);
    cutMesh_.faceAxis.resize(cut.faces);
    cutMesh_.facePlane.resize(cut.faces);
    cutMesh_.faceParentOffsets.assign(cut.faces + 1, 0);
    cutMesh_.faceParents.resize(cut.parents);
    cutMesh_.faceParentSigns.resize(cut.parents);
  }

  void writeFace(const LevelFace& face, LoopMaker& loops, Place& place) {
    const bool plain = isPlain(face);
    Counts& at = place[plain];
    const size_t f = at.faces++;
    for (size_t s = 0; s < 2; ++s) cells_.faceCells[2 * f + s] = face.cells[s];
    loops.forLoops(face, [&](std::span<const uint32_t> loop) {
      std::copy(loop.begin(), loop.end(), cells_.loopVertices.begin() + std::ptrdiff_t(at.corners));
      at.corners += loop.size();
      cells_.loopOffsets[++at.loops] = uint32_t(at.corners);
    });
    cells_.faceLoopOffsets[f + 1] = uint32_t(at.loops);
    if (face.isWhole())
      writeWhole(face, f);
    else
      writePart(face, f);
    if (plain) return;
    writeOfCut(face, f, at.parents);
    cutMesh_.faceParentOffsets[f + 1] = uint32_t(at.parents);
  }

  FaceTag tagOf(const LevelFace& face, size_t axis) const {
    return face.cells[0] == -1 ? FaceTag(2 * axis) : face.cells[1] == -1 ? FaceTag(2 * axis + 1) : FaceTag::inner;
  }

  void writeWhole(const LevelFace& face, size_t f) {
    const size_t axis = face.side.axis;
    const Block low = sources_.leaves.corner(face.side.leaf), high = sources_.leaves.end(face.side.leaf);
    double area = 1;
    for (size_t d = 0; d < 3; ++d) {
      const std::vector<double>& planes = cutMesh_.grid.planes[d];
      const double lower = planes[size_t(low[d])], upper = planes[size_t(high[d])];
      cells_.faceNormal[3 * f + d] = d == axis;
      cells_.faceCentroid[3 * f + d] = d != axis ? lower / 2 + upper / 2 : face.side.side ? upper : lower;
      if (d != axis) area *= upper - lower;
    }
    cells_.faceArea[f] = area;
    cells_.faceTag[f] = tagOf(face, axis);
  }

  void writePart(const LevelFace& face, size_t f) {
    const Part& part = sources_.parts[face.part];
    const size_t g = face.face;
    cells_.faceArea[f] = part.measures.faceArea[g];
    for (size_t d = 0; d < 3; ++d) {
      cells_.faceNormal[3 * f + d] = part.measures.faceNormal[3 * g + d];
      cells_.faceCentroid[3 * f + d] = part.measures.faceCentroid[3 * g + d];
    }
    const CutMesh& from = part.cutMesh();
    cells_.faceTag[f] = from.faceTriangle[g] >= 0 ? FaceTag::surface : tagOf(face, size_t(from.faceAxis[g]));
  }

  void writeOfCut(const LevelFace& face, size_t f, size_t& parents) {
    if (face.isWhole()) {
      const Side& side = face.side;
      cutMesh_.faceTriangle[f] = -1;
      cutMesh_.faceAxis[f] = int8_t(side.axis);
      cutMesh_.facePlane[f] = (side.side ? sources_.leaves.end(side.leaf) : sources_.leaves.corner(side.leaf))[side.axis];
      return;
    }
    const Part& part = sources_.parts[face.part];
    const CutMesh& from = part.cutMesh();
    const size_t g = face.face;
    const int axis = from.faceAxis[g];
    cutMesh_.faceTriangle[f] = from.faceTriangle[g] >= 0 ? int32_t(part.triangle(from.faceTriangle[g])) : -1;
    cutMesh_.faceAxis[f] = int8_t(axis);
    cutMesh_.facePlane[f] = axis < 0 ? 0 : (from.facePlane[g] + part.first[size_t(axis)]) << part.level;
    for (uint32_t i = from.faceParentOffsets[g]; i < from.faceParentOffsets[g + 1]; ++i, ++parents) {
      cutMesh_.faceParents[parents] = part.triangle(int32_t(from.faceParents[i]));
      cutMesh_.faceParentSigns[parents] = from.faceParentSigns[i];
    }
  }

  const Assembled& assembled_;
  const Sources& sources_;
  detail::Monitor& monitor_;
  CellComplex& cells_;
  CutMesh& cutMesh_;
};

}  // namespace

void writeFaces(const Assembled& assembled, const Sources& sources, detail::Monitor& monitor, CellComplex& cells, CutMesh& cutMesh) {
  FaceWriter(assembled, sources, monitor, cells, cutMesh).run();
}

}  // namespace mandoline::refining
