// Parts of a mesh that can't meet themselves, found without comparing triangles.
//
// A chart is a set of triangles that an axial projection lays out side by side. Each triangle keeps its orientation. The outline, which is
// all sides but those that two triangles of the chart traverse in opposite directions, goes once around a centre, and each of its sides
// goes counter-clockwise. So every ray from the centre meets the outline once: it does not touch itself, and its winding number about any
// other point, which is how many triangles cover that, is 1 or 0. (Volino and Magnenat-Thalmann 1994, "Efficient self-collision detection
// on smoothly discretized surface animations using geometrical shape regularity", look for such parts, too.)
#pragma once

#include <atomic>
#include <span>

#include "base/csr.h"
#include "base/parallel.h"
#include "mesh/resolve/sorted_mesh.h"

namespace mandoline::detail {

struct Charts {
  size_t count;
  std::vector<uint32_t> chartOf;  ///< each triangle; numbered in the order of their first ones
  Csr<uint32_t> triangles;        ///< of each chart, ascending
};

/// Finds charts on several threads. Two triangles of one have nothing in common but shared vertices and whole shared sides. They end with
/// ranges of triangles, so that they are the same for any number of threads.
class ChartFinder {
 public:
  /// Any thread may call this, once: from then on there is something to do.
  void begin(const SortedMesh& mesh);
  /// Looks at ranges until no other is left; does nothing if the mesh is not there yet. The thread that began has to call it.
  void help();
  /// Once all calls have returned.
  Charts take();

 private:
  /// The charts of the triangles of a range, which are near each other.
  std::span<uint32_t> rangeOf(size_t r);

  const SortedMesh* mesh_ = nullptr;
  Charts charts_{0, {}, {}};
  std::vector<std::vector<uint32_t>> ends_;  // per range: where the triangles of each chart end
  std::atomic<size_t> next_{0};
  std::atomic<bool> hasBegun_{false};
};

/// All at once.
Charts findCharts(const SortedMesh& mesh, Monitor& monitor);

}  // namespace mandoline::detail
