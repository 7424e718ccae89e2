#include <algorithm>

#include "base/keep_lowest.h"
#include "base/sort.h"
#include "mandoline/intersections.h"
#include "mesh/prepared.h"
#include "mesh/resolve/contacts.h"
#include "mesh/run_call.h"

namespace mandoline {
namespace {

using namespace detail;

/// A pair to list: one of kept triangles, or of their duplicates.
struct Listed {
  std::array<uint32_t, 2> triangles;
  const PairContact* contact;  ///< null for identical ones

  bool operator<(const Listed& other) const { return triangles < other.triangles; }
};

class Lister {
 public:
  Lister(const MeshView& mesh, const Prepared& prepared, size_t most)
      : mesh_(mesh), prepared_(prepared), scale_(prepared.shift), points_(prepared), most_(most) {}

  void list(const std::vector<PairContact>& contacts, MeshIntersections& result) {
    for (const PairContact& contact : contacts) addPairs(contact);
    for (size_t i = 0; i < prepared_.duplicates.size(); ++i) addIdentical(i);
    keepLowest(listed_, most_);
    detail::sortItems(listed_);
    for (const Listed& pair : listed_) {
      result.pairTriangles.insert(result.pairTriangles.end(), pair.triangles.begin(), pair.triangles.end());
      result.pairKinds.push_back(uint8_t(pair.contact ? pair.contact->kind() : IntersectionKind::identical));
      addPoints(pair, result.positions);
      result.pairPointOffsets.push_back(uint32_t(result.positions.size() / 3));
    }
  }

 private:
  void add(uint32_t s, uint32_t t, const PairContact* contact) {
    listed_.push_back({{std::min(s, t), std::max(s, t)}, contact});
    if (listed_.size() / 2 > most_) keepLowest(listed_, most_);
  }

  /// A pair, and those of the duplicates of both.
  void addPairs(const PairContact& contact) {
    const uint32_t s = contact.triangles[0], t = contact.triangles[1];
    const auto withDuplicates = [&](uint32_t of) {
      add(s, of, &contact);
      for (const Duplicate& d : prepared_.duplicatesOf(TriangleId{s})) add(d.triangle, of, &contact);
    };
    withDuplicates(t);
    for (const Duplicate& d : prepared_.duplicatesOf(TriangleId{t})) withDuplicates(d.triangle);
  }
  /// The pairs of a duplicate with the triangles before it that are the same.
  void addIdentical(size_t i) {
    const std::vector<Duplicate>& all = prepared_.duplicates;
    add(all[i].original, all[i].triangle, nullptr);
    for (size_t j = i; j-- > 0 && all[j].original == all[i].original;) add(all[j].triangle, all[i].triangle, nullptr);
  }

  void addPoints(const Listed& pair, std::vector<double>& out) {
    std::vector<uint32_t> corners;
    const auto& t = prepared_.triangles[pair.triangles[0]];
    if (pair.contact) {
      for (int i = 0; i < pair.contact->contact.count; ++i) corners.push_back(idOf(pair.contact->contact.corners[size_t(i)].key));
      if (corners.size() > 2) sortAround(t, corners);
    } else {
      corners.assign(t.begin(), t.end());
    }
    for (const uint32_t v : corners) {
      const Point p = points_.reference(v);
      for (size_t d = 0; d < 3; ++d) out.push_back(points_.isMade(v) ? scale_.world(p[d]) : mesh_.positions[3 * size_t(v) + d]);
    }
  }
  uint32_t idOf(const PointKey& key) {
    if (key.kind == PointKey::Kind::vertex) return key.ids[0];
    const uint32_t v = points_.add(key);
    points_.place(v, predicates_);
    return v;
  }
  /// Sorts the corners of a convex polygon counter-clockwise about a triangle's normal.
  void sortAround(const std::array<uint32_t, 3>& triangle, std::vector<uint32_t>& corners) {
    int axis = 0, turn = 0;
    while ((turn = points_.orient(triangle[0], triangle[1], triangle[2], axis, predicates_)) == 0) ++axis;
    detail::sortItems(std::span<uint32_t>(corners.data() + 1, corners.size() - 1),
                      [&](uint32_t a, uint32_t b) { return points_.orient(corners[0], a, b, axis, predicates_) == turn; });
  }

  const MeshView& mesh_;
  const Prepared& prepared_;
  Scale scale_;
  MeshPoints points_;
  Predicates predicates_;
  size_t most_;
  std::vector<Listed> listed_;
};

}  // namespace

MeshIntersections findIntersections(const MeshView& mesh, const IntersectionOptions& options) {
  return runCall("search for intersections", [&] {
    Monitor monitor(options, 2);
    const auto prepared =
        prepareMesh(mesh, {0, Intersections::assumeNone}, monitor, [&](const char* stage) { monitor.beginStage(stage, 0); });
    monitor.beginStage("intersections", 1);
    Predicates predicates;
    const Contacts contacts = findContacts(*prepared, findNear(SortedMesh(*prepared), monitor), monitor, predicates, options.maxPairs);
    MeshIntersections result;
    result.counts = contacts.counts;
    Lister(mesh, *prepared, options.maxPairs).list(contacts.pairs, result);
    return result;
  });
}

}  // namespace mandoline
