// Triangles of single faces, for operators that need only some.
#pragma once

#include "mandoline/cut_mesh.h"
#include "operators/triangulate/polygon_triangulator.h"

namespace mandoline::operators {

class FaceTriangulator {
 public:
  /// `positions`: 3 per vertex, kept as a reference.
  explicit FaceTriangulator(const std::vector<double>& positions) : positions_(positions) {}
  /// Appends the face's triangles as triangulateFaces() gives them: 3 vertex ids each.
  void run(const Face& face, std::vector<uint32_t>& triangles);
  /// The same, oriented out of the cell on side 0 or 1 of the face.
  void runOutwards(const Face& face, uint32_t side, std::vector<uint32_t>& triangles);

 private:
  const std::vector<double>& positions_;
  PolygonTriangulator polygon_;
};

}  // namespace mandoline::operators
