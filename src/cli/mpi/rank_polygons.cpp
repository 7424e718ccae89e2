#include "cli/mpi/rank_polygons.h"

#include <algorithm>

namespace mandoline::cli {

using detail::KnownPolygon;

RankPolygons::RankPolygons(detail::Communicator& comm, RankComplex& complex) : comm_(comm), complex_(complex) {
  comm_.together(kNoun, [&] {
    for (uint32_t v = 0; v < complex_.vertexIds.size(); ++v) {
      if (complex_.vertexIds[v] != RankComplex::kNoId) vertices_.push_back({complex_.vertexIds[v], v});
    }
  });
}

bool RankPolygons::tellsOf(uint32_t face) const {
  const int32_t a = complex_.cells.faceCells[2 * size_t(face)], b = complex_.cells.faceCells[2 * size_t(face) + 1];
  return complex_.cellRanks[size_t(a < 0 ? b : a)] == comm_.rank();
}

std::optional<uint32_t> RankPolygons::vertexOf(uint64_t id) const {
  const auto at = std::lower_bound(vertices_.begin(), vertices_.end(), Named{id, 0});
  return at != vertices_.end() && at->first == id ? std::optional(at->second) : std::nullopt;
}

uint32_t RankPolygons::addVertex(uint64_t id, const std::array<double, 3>& position) {
  const Named added{id, uint32_t(complex_.vertexIds.size())};
  complex_.vertexIds.push_back(id);
  complex_.cells.positions.insert(complex_.cells.positions.end(), position.begin(), position.end());
  vertices_.insert(std::lower_bound(vertices_.begin(), vertices_.end(), added), added);
  return added.second;
}

void RankPolygons::gather(std::vector<KnownPolygon>& polygons) {
  std::vector<uint64_t> names;  // per polygon: the face, how many vertices, and these
  std::vector<double> numbers;  // per polygon: the normal, and the positions
  together([&] {
    for (const KnownPolygon& polygon : polygons) {
      names.insert(names.end(), {polygon.face, polygon.vertices.size()});
      names.insert(names.end(), polygon.vertices.begin(), polygon.vertices.end());
      numbers.insert(numbers.end(), polygon.normal.begin(), polygon.normal.end());
      for (const std::array<double, 3>& position : polygon.positions) numbers.insert(numbers.end(), position.begin(), position.end());
    }
  });
  names = comm_.gather(names, true);
  numbers = comm_.gather(numbers, true);
  together([&] {
    polygons.clear();
    const double* number = numbers.data();
    const auto point = [&] {
      number += 3;
      return std::array{number[-3], number[-2], number[-1]};
    };
    for (size_t at = 0; at < names.size(); at += 2 + polygons.back().vertices.size()) {
      KnownPolygon& polygon = polygons.emplace_back(KnownPolygon{names[at], point(), {}, {}});
      const auto first = names.begin() + ptrdiff_t(at) + 2;
      polygon.vertices.assign(first, first + ptrdiff_t(names[at + 1]));
      for (size_t i = 0; i < polygon.vertices.size(); ++i) polygon.positions.push_back(point());
    }
    std::stable_sort(polygons.begin(), polygons.end(), [](const KnownPolygon& a, const KnownPolygon& b) { return a.face < b.face; });
  });
}

}  // namespace mandoline::cli
