#include "io/output_buffer.h"
#include "mesh/read/polygons.h"

namespace mandoline {
namespace detail {
namespace {

/// Per face the region that lists it: the one behind the face, which an outward oriented surface encloses, or the one in front where the
/// grid ends behind it. regionCount for faces that are not of the surface.
std::vector<uint32_t> listingRegions(const CutMesh& cutMesh) {
  std::vector<uint32_t> behind(cutMesh.faceCount(), cutMesh.regionCount), inFront = behind;
  for (size_t c = 0; c < cutMesh.cellCount(); ++c) {
    for (const uint32_t h : cutMesh.halfFaces(c)) (h % 2 == 0 ? behind : inFront)[h / 2] = cutMesh.cellRegion[c];
  }
  for (size_t f = 0; f < cutMesh.faceCount(); ++f) {
    if (behind[f] == cutMesh.regionCount) behind[f] = inFront[f];
    if (cutMesh.faceTriangle[f] < 0) behind[f] = cutMesh.regionCount;
  }
  return behind;
}

/// Faces of the surface, by region.
struct Groups {
  std::vector<uint32_t> offsets, faces;
};
Groups groupFaces(const CutMesh& cutMesh) {
  const std::vector<uint32_t> regions = listingRegions(cutMesh);
  Groups groups;
  groups.offsets.assign(cutMesh.regionCount + 2, 0);
  for (const uint32_t r : regions) ++groups.offsets[r + 1];
  for (size_t r = 0; r <= cutMesh.regionCount; ++r) groups.offsets[r + 1] += groups.offsets[r];
  groups.faces.resize(regions.size());
  std::vector<uint32_t> next = groups.offsets;
  for (uint32_t f = 0; f < regions.size(); ++f) groups.faces[next[regions[f]]++] = f;
  return groups;
}

class ObjWriter {
 public:
  ObjWriter(const Sink& sink, const CutMesh& cutMesh) : out_(sink), cutMesh_(cutMesh), polygons_(cutMesh), number_(cutMesh.vertexCount()) {}

  void write() {
    const Groups groups = groupFaces(cutMesh_);
    for (uint32_t r = 0; r < cutMesh_.regionCount; ++r) {
      if (groups.offsets[r] == groups.offsets[r + 1]) continue;
      out_.text("g region_");
      out_.number(r);
      out_.character('\n');
      for (uint32_t i = groups.offsets[r]; i < groups.offsets[r + 1]; ++i) {
        polygons_.forEach(groups.faces[i], [&](std::span<const uint32_t> polygon) { writePolygon(polygon); });
      }
    }
    out_.flush();
  }

 private:
  /// Vertices are written where they are first used.
  void writePolygon(std::span<const uint32_t> polygon) {
    for (const uint32_t v : polygon) {
      if (number_[v] == 0) writeVertex(v);
    }
    out_.character('f');
    for (const uint32_t v : polygon) {
      out_.character(' ');
      out_.number(number_[v]);
    }
    out_.character('\n');
  }

  void writeVertex(uint32_t v) {
    number_[v] = ++written_;
    out_.character('v');
    for (int d = 0; d < 3; ++d) {
      out_.character(' ');
      out_.number(cutMesh_.positions[3 * size_t(v) + d]);
    }
    out_.character('\n');
  }

  OutputBuffer out_;
  const CutMesh& cutMesh_;
  Polygons polygons_;
  std::vector<uint32_t> number_;  // per vertex: its number in the file, from 1; 0 if not written yet
  uint32_t written_ = 0;
};

}  // namespace
}  // namespace detail

void writeObj(const Sink& sink, const CutMesh& cutMesh) { detail::ObjWriter(sink, cutMesh).write(); }

}  // namespace mandoline
