// A part of a prepared mesh by itself, so that a cut of a few triangles costs what these cost.
#pragma once

#include <span>

#include "mesh/prepared.h"

namespace mandoline::detail {

/// Some triangles, and all else that they are made of and name: their tri-edges, where others meet them, their duplicates. Its ids are in
/// the order of the whole mesh's, so all that goes by ids comes out the same; what is said of the whole, that it is closed, say, is said of
/// the whole still.
struct Excerpt {
  Prepared mesh;
  std::vector<uint32_t> triangles;  ///< per triangle its id in the whole mesh, ascending
  std::vector<uint32_t> vertices;   ///< per tri-vertex and made vertex, likewise
  std::vector<uint32_t> edges;      ///< per tri-edge, likewise

  /// `kept`: ids of kept triangles, ascending.
  Excerpt(const Prepared& whole, std::span<const uint32_t> kept);

  /// The triangles that an error names here become those of the whole mesh.
  void nameByWhole(Error& error) const {
    for (int64_t* triangle : {&error.element, &error.element2}) {
      if (*triangle >= 0) *triangle = triangles[size_t(*triangle)];
    }
  }
};

}  // namespace mandoline::detail
