// Meshes that use some of the vertices of an array.
#pragma once

#include "mandoline/mesh.h"

namespace mandoline::operators {

/// Gathers triangles in a mesh, and adds the vertices of an array when a triangle first uses them.
class MeshWriter {
 public:
  /// Keeps references to both. `positions`: 3 per vertex.
  MeshWriter(const std::vector<double>& positions, Mesh& out) : positions_(positions), numbers_(positions.size() / 3, kUnused), out_(out) {}

  void add(const uint32_t* triangle, bool turned) {
    for (const size_t i : {size_t(0), size_t(turned ? 2 : 1), size_t(turned ? 1 : 2)}) out_.triangles.push_back(numberOf(triangle[i]));
  }
  /// Per vertex of the mesh: the array's.
  const std::vector<uint32_t>& used() const { return used_; }

 private:
  static constexpr uint32_t kUnused = ~0u;

  uint32_t numberOf(uint32_t v) {
    if (numbers_[v] == kUnused) {
      numbers_[v] = uint32_t(used_.size());
      used_.push_back(v);
      const auto first = positions_.begin() + 3 * std::ptrdiff_t(v);
      out_.positions.insert(out_.positions.end(), first, first + 3);
    }
    return numbers_[v];
  }

  const std::vector<double>& positions_;
  std::vector<uint32_t> numbers_;  // per vertex of the array: the mesh's
  std::vector<uint32_t> used_;
  Mesh& out_;
};

}  // namespace mandoline::operators
