// A mesh that is read in pieces, as often as need be: a file, or arrays.
#pragma once

#include <algorithm>
#include <memory>
#include <span>

#include "mandoline/mesh.h"

namespace mandoline::detail {

struct MeshSource {
  uint64_t vertices = 0, triangles = 0;

  virtual ~MeshSource() = default;
  /// 3 of each vertex from one on.
  virtual void readPositions(uint64_t first, std::span<double> positions) const = 0;
  /// 3 of each triangle from one on: ids of vertices.
  virtual void readCorners(uint64_t first, std::span<uint32_t> corners) const = 0;
};

/// Calls f(id, p) for each vertex, ascending; p has three coordinates.
template <class F>
void forPositions(const MeshSource& mesh, const F& f) {
  constexpr uint64_t kBlock = 1 << 14;
  std::vector<double> block;
  for (uint64_t first = 0; first < mesh.vertices; first += kBlock) {
    block.resize(3 * size_t(std::min(kBlock, mesh.vertices - first)));
    mesh.readPositions(first, block);
    for (size_t i = 0; i < block.size(); i += 3) f(uint32_t(first + i / 3), &block[i]);
  }
}
/// Calls f(id, v) for each triangle, ascending; v has three ids of vertices.
template <class F>
void forCorners(const MeshSource& mesh, const F& f) {
  constexpr uint64_t kBlock = 1 << 14;
  std::vector<uint32_t> block;
  for (uint64_t first = 0; first < mesh.triangles; first += kBlock) {
    block.resize(3 * size_t(std::min(kBlock, mesh.triangles - first)));
    mesh.readCorners(first, block);
    for (size_t i = 0; i < block.size(); i += 3) f(uint32_t(first + i / 3), &block[i]);
  }
}
inline Mesh readAll(const MeshSource& mesh) {
  Mesh all;
  all.positions.resize(3 * size_t(mesh.vertices));
  all.triangles.resize(3 * size_t(mesh.triangles));
  mesh.readPositions(0, all.positions);
  mesh.readCorners(0, all.triangles);
  return all;
}

/// Arrays, all of which can be followed.
class ArraySource : public MeshSource {
 public:
  explicit ArraySource(std::shared_ptr<const Mesh> mesh) : mesh_(std::move(mesh)) {
    vertices = mesh_->vertexCount();
    triangles = mesh_->triangleCount();
  }
  void readPositions(uint64_t first, std::span<double> positions) const override {
    std::copy_n(mesh_->positions.begin() + ptrdiff_t(3 * first), positions.size(), positions.begin());
  }
  void readCorners(uint64_t first, std::span<uint32_t> corners) const override {
    std::copy_n(mesh_->triangles.begin() + ptrdiff_t(3 * first), corners.size(), corners.begin());
  }

 private:
  std::shared_ptr<const Mesh> mesh_;
};

}  // namespace mandoline::detail
