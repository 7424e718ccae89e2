// .vtu files taken apart again, and their cells as polygons.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "catch.h"
#include "mandoline/grid.h"

namespace vtu_files {

/// A VTU file taken apart again.
class Vtu {
 public:
  explicit Vtu(std::string text) : text_(std::move(text)) {
    data_ = text_.find("<AppendedData encoding=\"raw\">\n_");
    REQUIRE(data_ != std::string::npos);
    data_ += std::strlen("<AppendedData encoding=\"raw\">\n_");
  }

  bool has(const std::string& name) const { return text_.find("Name=\"" + name + "\"") < data_; }
  template <class Scalar>
  std::vector<Scalar> array(const std::string& name) const {
    CAPTURE(name);
    REQUIRE(has(name));
    const size_t offset = text_.find("offset=\"", text_.find("Name=\"" + name + "\"")) + 8;
    const size_t place = data_ + size_t(std::strtoull(text_.c_str() + offset, nullptr, 10));
    uint64_t size = 0;
    REQUIRE(place + sizeof size <= text_.size());
    std::memcpy(&size, text_.data() + place, sizeof size);
    REQUIRE(size % sizeof(Scalar) == 0);
    REQUIRE(place + sizeof size + size <= text_.size());
    std::vector<Scalar> values(size / sizeof(Scalar));
    std::memcpy(values.data(), text_.data() + place + sizeof size, size);
    return values;
  }

 private:
  std::string text_;
  size_t data_ = 0;
};

using Polygon = std::vector<int64_t>;

/// The polygon from its lowest vertex on.
inline Polygon fromLowest(Polygon polygon) {
  std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  return polygon;
}

/// Per cell its faces, counter-clockwise as seen from outside.
inline std::vector<std::vector<Polygon>> cellFaces(const Vtu& vtu) {
  constexpr int kHexahedronFaces[6][4] = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  const auto types = vtu.array<uint8_t>("types");
  const auto connectivity = vtu.array<int64_t>("connectivity"), offsets = vtu.array<int64_t>("offsets");
  const bool polyhedra = vtu.has("faces");
  const auto faces = polyhedra ? vtu.array<int64_t>("faces") : std::vector<int64_t>();
  const auto faceOffsets = polyhedra ? vtu.array<int64_t>("faceoffsets") : std::vector<int64_t>(types.size(), -1);
  std::vector<std::vector<Polygon>> cells(types.size());
  size_t next = 0;
  for (size_t c = 0; c < types.size(); ++c) {
    const size_t begin = c == 0 ? 0 : size_t(offsets[c - 1]), end = size_t(offsets[c]);
    if (types[c] == 12) {
      REQUIRE(end - begin == 8);
      REQUIRE(faceOffsets[c] == -1);
      for (const auto& face : kHexahedronFaces) {
        cells[c].emplace_back();
        for (const int i : face) cells[c].back().push_back(connectivity[begin + size_t(i)]);
      }
      continue;
    }
    REQUIRE(types[c] == 42);
    std::vector<int64_t> used;
    for (int64_t count = faces.at(next++); count > 0; --count) {
      const size_t size = size_t(faces.at(next++));
      cells[c].emplace_back(faces.begin() + int64_t(next), faces.begin() + int64_t(next + size));
      used.insert(used.end(), cells[c].back().begin(), cells[c].back().end());
      next += size;
    }
    REQUIRE(int64_t(next) == faceOffsets[c]);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<int64_t> listed(connectivity.begin() + int64_t(begin), connectivity.begin() + int64_t(end));
    std::sort(listed.begin(), listed.end());
    REQUIRE(listed == used);
  }
  return cells;
}

inline double signedVolume(const std::vector<Polygon>& faces, const std::vector<double>& positions) {
  const double* origin = &positions[size_t(3 * faces[0][0])];
  const auto relative = [&](int64_t v, int d) { return positions[size_t(3 * v + d)] - origin[d]; };
  double volume = 0;
  for (const Polygon& face : faces) {
    for (size_t i = 1; i + 1 < face.size(); ++i) {
      for (int d = 0; d < 3; ++d) {
        const int p = (d + 1) % 3, q = (d + 2) % 3;
        volume +=
            relative(face[0], d) * (relative(face[i], p) * relative(face[i + 1], q) - relative(face[i], q) * relative(face[i + 1], p)) / 6;
      }
    }
  }
  return volume;
}

/// Cells have the volumes that the file says, and match face by face: faces with one side only lie on the box.
inline void requireMatching(const Vtu& vtu, const mandoline::Grid& grid) {
  const auto positions = vtu.array<double>("Points");
  const auto volumes = vtu.array<double>("volume");
  const auto cells = cellFaces(vtu);
  REQUIRE(volumes.size() == cells.size());
  std::vector<Polygon> sides;
  for (size_t c = 0; c < cells.size(); ++c) {
    REQUIRE(std::fabs(signedVolume(cells[c], positions) - volumes[c]) < 1e-13);
    for (const Polygon& face : cells[c]) sides.push_back(fromLowest(face));
  }
  std::sort(sides.begin(), sides.end());
  size_t wrong = 0;
  for (const Polygon& side : sides) {
    const auto equal = std::equal_range(sides.begin(), sides.end(), side);
    const auto opposite = std::equal_range(sides.begin(), sides.end(), fromLowest(Polygon(side.rbegin(), side.rend())));
    bool onBox = false;
    for (size_t d = 0; d < 3; ++d) {
      for (const double end : {grid.planes[d].front(), grid.planes[d].back()}) {
        onBox |= std::all_of(side.begin(), side.end(), [&](int64_t v) { return positions[size_t(3 * v) + d] == end; });
      }
    }
    wrong += equal.second - equal.first != 1 || opposite.second - opposite.first != (onBox ? 0 : 1);
  }
  REQUIRE(wrong == 0);
}

}  // namespace vtu_files
