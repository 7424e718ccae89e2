// Triangles of single faces, for operators that need only some.
#pragma once

#include "mandoline/cut_mesh.h"
#include "operators/triangulate/polygon_triangulator.h"

namespace mandoline::operators {

class FaceTriangulator {
 public:
  explicit FaceTriangulator(const CutMesh& cutMesh) : cutMesh_(cutMesh) {}
  /// Appends the face's triangles as triangulateFaces() gives them: 3 vertex ids each.
  void run(size_t face, std::vector<uint32_t>& triangles);

 private:
  const CutMesh& cutMesh_;
  PolygonTriangulator polygon_;
};

}  // namespace mandoline::operators
