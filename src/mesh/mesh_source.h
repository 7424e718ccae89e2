// A mesh that is read in pieces, as often as need be: a file, or arrays.
#pragma once

#include <algorithm>
#include <memory>
#include <span>

#include "mandoline/cut_share.h"
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

/// Calls f(id, its three numbers) for a share of `count` items, ascending; read(first, numbers) reads some of them.
template <class Number, class Read, class F>
void forBlocks(uint64_t count, const ShareOf& shareOf, const Read& read, const F& f) {
  constexpr uint64_t kBlock = 1 << 14;
  std::vector<Number> block;
  for (uint64_t first = shareOf.begin(count); first < shareOf.end(count); first += kBlock) {
    block.resize(3 * size_t(std::min(kBlock, shareOf.end(count) - first)));
    read(first, std::span<Number>(block));
    for (size_t i = 0; i < block.size(); i += 3) f(uint32_t(first + i / 3), &block[i]);
  }
}
/// Calls f(id, p) for each vertex; p has three coordinates.
template <class F>
void forPositions(const MeshSource& mesh, const F& f, const ShareOf& shareOf = {}) {
  const auto read = [&](uint64_t first, std::span<double> positions) { mesh.readPositions(first, positions); };
  forBlocks<double>(mesh.vertices, shareOf, read, f);
}
/// Calls f(id, v) for each triangle; v has three ids of vertices.
template <class F>
void forCorners(const MeshSource& mesh, const F& f, const ShareOf& shareOf = {}) {
  const auto read = [&](uint64_t first, std::span<uint32_t> corners) { mesh.readCorners(first, corners); };
  forBlocks<uint32_t>(mesh.triangles, shareOf, read, f);
}
/// A share of the vertices, and of the triangles.
inline Mesh readShare(const MeshSource& mesh, const ShareOf& shareOf = {}) {
  Mesh share;
  share.positions.reserve(3 * size_t(shareOf.end(mesh.vertices) - shareOf.begin(mesh.vertices)));
  share.triangles.reserve(3 * size_t(shareOf.end(mesh.triangles) - shareOf.begin(mesh.triangles)));
  forPositions(
      mesh, [&](uint32_t, const double* p) { share.positions.insert(share.positions.end(), p, p + 3); }, shareOf);
  forCorners(
      mesh, [&](uint32_t, const uint32_t* v) { share.triangles.insert(share.triangles.end(), v, v + 3); }, shareOf);
  return share;
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
