#include "operators/slice/outline_writer.h"

namespace mandoline::operators {

void OutlineWriter::run(const std::vector<RegionArc>& arcs, const Points& points, Outlines& outlines) {
  points_ = &points;
  outlines_ = &outlines;
  tracer_.start(points.seen());
  outputPoint_.assign(points.size(), kNone);
  joints_.assign(points.size(), {});
  for (size_t begin = 0, end; begin < arcs.size(); begin = end) {
    end = begin + 1;
    while (end < arcs.size() && arcs[end].region == arcs[begin].region) ++end;
    const std::span<const RegionArc> region = std::span(arcs).subspan(begin, end - begin);
    addPolygons(region);
    addSlits(region);
  }
}

/// The place of a point in the outlines.
uint32_t OutlineWriter::outputPoint(uint32_t point) {
  uint32_t& place = outputPoint_[point];
  if (place == kNone) {
    place = uint32_t(outlines_->positions.size() / 3);
    for (const double x : (*points_)[point]) outlines_->positions.push_back(space_.world(x));
  }
  return place;
}

void OutlineWriter::addPolygons(std::span<const RegionArc> arcs) {
  for (uint32_t a = 0; a < arcs.size(); ++a) {
    if (!arcs[a].isSlit) tracer_.add(a, arcs[a].start, arcs[a].end);
  }
  const detail::Csr<uint32_t>& loops = tracer_.run();
  const detail::Csr<uint32_t>& polygons = nesting_.run(loops, points_->seen());
  findCorners(arcs);
  for (size_t p = 0; p < polygons.size(); ++p) {
    if (corners_[polygons[p][0]].size() < 3) continue;  // there and back along one line
    for (const uint32_t l : polygons[p]) {
      if (corners_[l].size() < 3) continue;
      for (const uint32_t point : corners_[l]) outlines_->loopPoints.push_back(outputPoint(point));
      outlines_->loopOffsets.push_back(uint32_t(outlines_->loopPoints.size()));
    }
    outlines_->polygonLoopOffsets.push_back(uint32_t(outlines_->loopOffsets.size() - 1));
    outlines_->polygonRegion.push_back(arcs[0].region);
  }
}

/// The points of the traced loops where one line ends and another starts.
void OutlineWriter::findCorners(std::span<const RegionArc> arcs) {
  corners_.offsets.assign(1, 0);
  corners_.items.clear();
  for (size_t l = 0; l < tracer_.segments().size(); ++l) {
    const std::span<const uint32_t> loop = tracer_.segments()[l];
    for (size_t i = 0; i < loop.size(); ++i) {
      const RegionArc &before = arcs[loop[i > 0 ? i - 1 : loop.size() - 1]], &after = arcs[loop[i]];
      if (before.line != after.line) corners_.items.push_back(after.start);
    }
    corners_.offsets.push_back(uint32_t(corners_.items.size()));
  }
}

void OutlineWriter::addSlits(std::span<const RegionArc> arcs) {
  used_.assign(arcs.size(), 0);
  for (uint32_t a = 0; a < arcs.size(); ++a) {
    if (!arcs[a].isSlit) continue;
    Joint &start = joints_[arcs[a].start], &end = joints_[arcs[a].end];
    start.next = a;
    ++start.starting;
    end.previous = a;
    ++end.ending;
  }
  for (const bool closed : {false, true}) {  // first those that have ends; the others are closed, and start in a corner
    for (uint32_t a = 0; a < arcs.size(); ++a) {
      if (!arcs[a].isSlit || used_[a]) continue;
      const Joint& joint = joints_[arcs[a].start];
      if (!joint.goesOn() || (closed && arcs[joint.previous].line != arcs[a].line)) addSlit(arcs, a);
    }
  }
  for (const RegionArc& arc : arcs) joints_[arc.start] = joints_[arc.end] = {};
}

/// Adds the slit that starts with an arc.
void OutlineWriter::addSlit(std::span<const RegionArc> arcs, uint32_t first) {
  std::vector<uint32_t>& result = outlines_->slitPoints;
  result.push_back(outputPoint(arcs[first].start));
  for (uint32_t a = first;;) {
    used_[a] = 1;
    const Joint& joint = joints_[arcs[a].end];
    const bool goesOn = joint.goesOn() && !used_[joint.next];
    if (!goesOn || arcs[joint.next].line != arcs[a].line) result.push_back(outputPoint(arcs[a].end));
    if (!goesOn) break;
    a = joint.next;
  }
  outlines_->slitOffsets.push_back(uint32_t(result.size()));
  outlines_->slitRegion.push_back(arcs[first].region);
}

}  // namespace mandoline::operators
