// Where several processes have a part of the cells each: what they tell each other of polygons that change others.
#pragma once

#include <array>
#include <optional>

#include "base/function_ref.h"
#include "mandoline/cell_complex.h"

namespace mandoline::detail {

/// A polygon of a face, as all processes know it.
struct KnownPolygon {
  uint64_t face;  ///< by which polygons are in order
  std::array<double, 3> normal;
  std::vector<uint64_t> vertices;
  std::vector<std::array<double, 3>> positions;
};

/// As it is: for one process, which has all cells. Ids are those of the whole.
class PolygonSharing {
 public:
  virtual ~PolygonSharing() = default;

  virtual uint64_t vertexId(uint32_t vertex) const { return vertex; }
  virtual uint64_t faceId(uint32_t face) const { return face; }
  /// Whether this process tells of a face; each has one that does.
  virtual bool tellsOf(uint32_t /*face*/) const { return true; }
  virtual std::optional<uint32_t> vertexOf(uint64_t id) const { return uint32_t(id); }
  /// Adds a vertex that this process does not have.
  virtual uint32_t addVertex(uint64_t id, const std::array<double, 3>& /*position*/) { return uint32_t(id); }

  // Collective:
  /// Runs what may fail.
  virtual void together(FunctionRef<void()> work) { work(); }
  virtual double largest(double here) { return here; }
  /// Replaces them by those of all processes, in the order of their faces.
  virtual void gather(std::vector<KnownPolygon>& /*polygons*/) {}
};

}  // namespace mandoline::detail
