#include "operators/triangulate/polygon_triangulator.h"

namespace mandoline::operators {

void PolygonTriangulator::startLoop() {
  closeLoop();
  chains_.loopFirst.push_back(uint32_t(chains_.corners.size()));
}

void PolygonTriangulator::addCorner(uint32_t vertex, const PlanePoint& at) {
  const uint32_t i = uint32_t(chains_.corners.size());
  chains_.corners.push_back({at, vertex, i - 1, i + 1});
}

void PolygonTriangulator::run(std::vector<uint32_t>& triangles) {
  closeLoop();
  if (chains_.corners.size() >= 3) {
    if (chains_.loopFirst.size() > 1) joiner_.run(chains_);
    clipper_.run(chains_, triangles);
  }
  chains_.corners.clear();
  chains_.loopFirst.clear();
}

void PolygonTriangulator::closeLoop() {
  std::vector<uint32_t>& firsts = chains_.loopFirst;
  if (firsts.empty()) return;
  if (firsts.back() == chains_.corners.size()) return firsts.pop_back();
  chains_.link(uint32_t(chains_.corners.size()) - 1, firsts.back());
}

}  // namespace mandoline::operators
