// Meshes in the grid of 8 x 9 x 7 unit cells that are hard where seams between bricks pass through them.
#pragma once

#include "checked_cut.h"
#include "shapes.h"

inline mandoline::Grid seamGrid() { return unitGrid(8, 9, 7); }

inline std::vector<mandoline::Mesh> seamMeshes() {
  using namespace shapes;
  const Point c = {4, 4, 4};  // on seams of all sizes up to 4
  return {
      // bubbles, a tunnel, overlapping boxes, rings that cross, sheets, twins, and what reaches far beyond the grid
      merged({octahedron(c, 1.5), flipped(octahedron(c, 0.75)), octahedron({4, 4, 4.25}, 0.125)}),
      merged({box({1.5, 1.5, 1.5}, {6.5, 6.5, 6.5}), flipped(box({3.75, 3.75, 1.5}, {4.25, 4.25, 6.5}))}),
      merged({box({1.5, 1.5, 1.5}, {4, 5.5, 5.5}), box({4, 2.5, 2.5}, {6.5, 6.5, 6.5}), cube(3.5, 4.5)}),
      merged({torus({3.9, 4.2, 4.1}, 2.5, 0.8, 12, 8), torus({4.4, 4, 4.1}, 2.5, 0.8, 8, 12), icosphere(c, 2, 1)}),
      merged({fan({4, 4, 1.5}, 5, {{1, 0}, {0.75, 0.75}, {-0.75, 0.75}, {-1, 0}, {0, -1}}), moebius(c, 2.5, 1.25, 18),
              quad({1.5, 1.5, 4}, {6.5, 1.5, 4}, {6.5, 6.5, 4}, {1.5, 6.5, 4})}),
      merged({cube(2.5, 5.5), cube(2.5, 5.5), flipped(cube(3, 4))}),
      merged({cube(-20, 30), flipped(cube(-3, 4)), box({3, 3, -9}, {4, 4, 17})}),
  };
}
