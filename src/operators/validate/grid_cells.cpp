// Gathers the cut-cells of each grid cell, with their faces in its own coordinates, for the checks that work by grid cell.
#include "operators/validate/grid_cells.h"

#include <algorithm>

namespace mandoline::validation {

void GridCell::gather(size_t group) {
  for (const Face& face : faces) local_[face.id] = -1;
  faces.clear(), cornerVertex.clear(), cornerNext.clear(), corners.clear();
  cells = {context.cellOrder.data() + context.groupOffsets[group], context.groupOffsets[group + 1] - context.groupOffsets[group]};
  for (int d = 0; d < 3; ++d) {
    index[d] = context.gridCellOf(cells[0])[d];
    low[d] = context.planes[d][index[d]];
    size[d] = context.planes[d][index[d] + 1] - low[d];
    noise[d] = std::max(context.rounding[d] / size[d], kRounding);
  }
  for (const uint32_t c : cells) {
    for (const uint32_t h : context.cut.halfFaces(c)) {
      Face& face = local_[h / 2] >= 0 ? faces[local_[h / 2]] : addFace(h / 2);
      if (face.owner[h % 2] < 0) face.owner[h % 2] = int32_t(c);
    }
  }
}

GridCell::Face& GridCell::addFace(uint32_t id) {
  local_[id] = int32_t(faces.size());
  const uint32_t firstCorner = uint32_t(corners.size());
  faces.push_back(
      {id, {-1, -1}, firstCorner, firstCorner, -1, {{INFINITY, INFINITY, INFINITY}}, {{-INFINITY, -INFINITY, -INFINITY}}, 0, 0, {}, {}});
  Face& face = faces.back();
  const int axis = context.cut.faceAxis[id];
  if (axis >= 0) face.side = 2 * axis + (context.cut.facePlane[id] == index[axis] ? 0 : 1);
  context.forLoops(id, [&](std::span<const uint32_t> loop) { addLoop(face, loop); });
  face.lastCorner = uint32_t(corners.size());
  return face;
}

void GridCell::addLoop(Face& face, std::span<const uint32_t> loop) {
  const size_t first = corners.size();
  for (size_t i = 0; i < loop.size(); ++i) {
    const Vec3 q = local(context.vertex(loop[i]));
    for (int d = 0; d < 3; ++d) face.low[d] = std::min(face.low[d], q[d]), face.high[d] = std::max(face.high[d], q[d]);
    corners.push_back(q);
    cornerVertex.push_back(loop[i]);
    cornerNext.push_back(uint32_t(i + 1 < loop.size() ? first + i + 1 : first));
  }
  // A fan from the loop's first corner.
  for (size_t i = first; i < corners.size(); ++i) {
    const Vec3 &a = corners[first], &b = corners[i], &c = corners[cornerNext[i]];
    const Vec3 twice = cross(b - a, c - a);
    face.area = face.area + 0.5 * twice;
    face.volume += dot(a, twice) / 6;
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3, f = (d + 2) % 3;
      const double areaNoise = noise[e] * std::fabs(c[f] - b[f]) + noise[f] * std::fabs(c[e] - b[e]) + noise[e] * noise[f];
      face.areaNoise[d] += areaNoise;
      face.volumeNoise += noise[d] * (std::fabs(twice[d]) / 2 + areaNoise);
    }
  }
}

void checkGridCells(const Context& context, std::vector<Check>& checks, std::vector<double>& cellVolumes, std::vector<Sample>& samples) {
  cellVolumes.assign(context.cut.cellCount(), 0);
  GridCell cell(context);
  Sets shells;
  EdgeCheck edgeCheck;
  ConformingCheck conformingCheck;
  CrossingCheck crossingCheck;
  ShellCheck shellCheck;
  LineCheck lineCheck(context);
  for (size_t group = 0; group < context.groupCount(); ++group) {
    cell.gather(group);
    shells.reset(2 * cell.faces.size());
    edgeCheck.run(cell, shells);
    conformingCheck.run(cell, edgeCheck.edges());
    crossingCheck.run(cell, edgeCheck.edges());
    shellCheck.run(cell, shells, cellVolumes);
    lineCheck.run(cell, samples);
  }
  edgeCheck.finish(checks);
  conformingCheck.finish(checks);
  crossingCheck.finish(checks);
  shellCheck.finish(checks);
  lineCheck.finish(checks);
}

}  // namespace mandoline::validation
