// Where thousands of faces share a vertex, all their boxes overlap. So faces that share it are compared by their directions from it, and
// with all other faces by place.
#pragma once

#include "base/function_ref.h"
#include "operators/validate/grid_cell.h"

namespace mandoline::validation {

/// The vertices that many tri-faces of a grid cell share.
class Hubs {
 public:
  struct At {
    uint32_t vertex, item;
    auto operator<=>(const At&) const = default;
  };
  struct Hub {
    uint32_t vertex;
    std::span<const At> faces;  ///< by place in cell.faces
    std::span<const At> edges;  ///< by place in the list
  };

  void find(const GridCell& cell, const std::vector<Edge>& edges);
  const std::vector<Hub>& all() const { return hubs_; }
  /// The hub at a vertex, or null.
  const Hub* at(uint32_t vertex) const;

 private:
  std::vector<At> faces_, edges_;
  std::vector<Hub> hubs_;
};

/// Boxes of things with vertices, in one tree for each hub.
class HubTree {
 public:
  using VerticesOf = detail::FunctionRef<std::span<const uint32_t>(uint32_t)>;

  /// Starts anew.
  void clear() { placed_.clear(); }
  void add(const detail::BoxTree::Item& item) { placed_.push_back({nullptr, item}); }
  /// Of the things added.
  void build(const Hubs& hubs, VerticesOf verticesOf);
  /// Calls f(id) for things whose boxes overlap the given one, but not for those known to share a hub with the vertices.
  void forOverlapping(const detail::Box& box, std::span<const uint32_t> vertices, detail::FunctionRef<void(uint32_t)> f) const;

 private:
  struct Tree {
    std::vector<uint32_t> common;  // hubs that all its things have
    detail::BoxTree boxes;
  };
  struct Placed {
    const Hubs::Hub* hub;
    detail::BoxTree::Item item;
  };
  std::vector<Placed> placed_;
  std::vector<Tree> trees_;
  size_t used_ = 0;  // of the trees
};

/// Bounds of the directions in which vertices are seen from a point, each divided by its largest component, and of those between them.
detail::Box directionsOf(const Vec3& from, std::span<const Vec3> points, const Vec3& margin);

}  // namespace mandoline::validation
