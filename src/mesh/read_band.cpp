#include "mesh/mesh_band.h"
#include "mesh/places.h"

namespace mandoline::detail {
namespace {

class BandReader {
 public:
  BandReader(const MeshSource& mesh, const Scale& scale, const Band& band) : mesh_(mesh), scale_(scale), band_(band) {}

  BandTriangles read() {
    findHeights();
    findWithin();
    findBeside();
    takeTriangles();
    takeVertices();
    findLowest(out_);
    findLowestElsewhere();
    return std::move(out_);
  }

 private:
  // Of each vertex: whether it is not above the band and not below; has a triangle within, any triangle, one within at its position;
  // and is taken.
  static constexpr uint8_t kNotAbove = 1, kNotBelow = 2, kInBand = 3, kWithin = 4, kReferenced = 8, kAtWithin = 16, kTaken = 32;

  void findHeights() {
    flags_.reserve(mesh_.vertices);
    uint32_t ignored = 0;
    forPositions(mesh_, [&](uint32_t, const double* p) {
      const double height = scale_.scaled(p[2], ignored);
      flags_.push_back(uint8_t((height <= band_.high ? kNotAbove : 0) | (height >= band_.low ? kNotBelow : 0)));
    });
  }

  /// As Band::reaches().
  bool isWithin(const uint32_t* v) const { return ((flags_[v[0]] | flags_[v[1]] | flags_[v[2]]) & kInBand) == kInBand; }
  void mark(const uint32_t* v, uint8_t flag) {
    for (size_t i = 0; i < 3; ++i) flags_[v[i]] |= flag;
  }

  void findWithin() {
    forCorners(mesh_, [&](uint32_t, const uint32_t* v) {
      const bool within = isWithin(v);
      within_ += within;
      mark(v, within ? kWithin | kReferenced : kReferenced);
    });
  }

  /// All triangles at vertices in the band are within it.
  void findBeside() {
    std::vector<double> outside;
    const auto isOutside = [&](uint32_t v, uint8_t flag) { return (flags_[v] & kInBand) != kInBand && (flags_[v] & flag) != 0; };
    forPositions(mesh_, [&](uint32_t v, const double* p) {
      if (isOutside(v, kWithin)) outside.insert(outside.end(), p, p + 3);
    });
    if (outside.empty()) return;
    FirstAt places(outside);
    forPositions(mesh_, [&](uint32_t v, const double* p) {
      if (isOutside(v, kReferenced) && places.has(p)) flags_[v] |= kAtWithin;
    });
  }

  void takeTriangles() {
    const size_t room = within_ + within_ / 64;  // for those beside, mostly
    out_.part.triangles.reserve(room);
    out_.part.corners.reserve(3 * room);
    out_.isWithin.reserve(room);
    forCorners(mesh_, [&](uint32_t t, const uint32_t* v) {
      const bool within = isWithin(v);
      if (!within && ((flags_[v[0]] | flags_[v[1]] | flags_[v[2]]) & kAtWithin) == 0) return;
      out_.part.triangles.push_back(t);
      out_.part.corners.insert(out_.part.corners.end(), v, v + 3);
      out_.isWithin.push_back(within);
      mark(v, kTaken);
    });
  }

  void takeVertices() {
    MeshPart& part = out_.part;
    part.vertices.reserve(size_t(std::count_if(flags_.begin(), flags_.end(), [](uint8_t flags) { return (flags & kTaken) != 0; })));
    part.positions.reserve(3 * part.vertices.capacity());
    forPositions(mesh_, [&](uint32_t v, const double* p) {
      if ((flags_[v] & kTaken) == 0) return;
      part.vertices.push_back(v);
      part.positions.insert(part.positions.end(), p, p + 3);
    });
    const RankedSet ids = rankedIds(part.vertices);
    for (uint32_t& corner : part.corners) corner = ids.rankOf(corner);
  }

  void findLowestElsewhere() {
    const MeshPart& part = out_.part;
    std::vector<double> asked;
    for (size_t v = 0; v < part.vertices.size(); ++v) {
      const double* p = &part.positions[3 * v];
      if (!out_.isComplete[v] && out_.lowest[v] == part.vertices[v]) asked.insert(asked.end(), p, p + 3);
    }
    if (asked.empty()) return;
    FirstAt places(asked);
    forPositions(mesh_, [&](uint32_t v, const double* p) {
      if ((flags_[v] & kReferenced) != 0) places.add(v, p);
    });
    takeLowest(asked, places.first(), out_);
  }

  const MeshSource& mesh_;
  const Scale& scale_;
  const Band& band_;
  std::vector<uint8_t> flags_;
  size_t within_ = 0;  // triangles
  BandTriangles out_;
};

}  // namespace

BandTriangles readBand(const MeshSource& mesh, const Scale& scale, const Band& band) { return BandReader(mesh, scale, band).read(); }

}  // namespace mandoline::detail
