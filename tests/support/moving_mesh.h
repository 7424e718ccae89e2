// Whether a surface that moves is cut again as it would be cut anew.
#pragma once

#include "mandoline/recut.h"
#include "same_bits.h"

/// A mesh at several times: as it is, with some vertices moved, with another one, again, as a whole, as it was at first, without a
/// triangle, and as it was at first.
inline std::vector<mandoline::Mesh> movingMesh(const mandoline::Mesh& mesh, uint32_t seed, double step) {
  using mandoline::Mesh;
  auto randomBelow = [state = seed](uint32_t most) mutable {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % most;
  };
  const auto moved = [&](Mesh moving, auto moves) {
    for (size_t v = 0; v < moving.vertexCount(); ++v) {
      if (moves(v)) moving.positions[3 * v + randomBelow(3)] += step * (double(randomBelow(5)) - 2);
    }
    return moving;
  };
  std::vector<Mesh> times{mesh};
  times.push_back(moved(times.back(), [&](size_t) { return randomBelow(8) == 0; }));
  const size_t one = randomBelow(uint32_t(std::max<size_t>(mesh.vertexCount(), 1)));
  times.push_back(moved(times.back(), [&](size_t v) { return v == one; }));
  times.push_back(times.back());
  times.push_back(moved(times.back(), [](size_t) { return true; }));
  times.push_back(mesh);
  times.push_back(mesh);
  for (int i = 0; i < 3 && !mesh.triangles.empty(); ++i) times.back().triangles.pop_back();
  times.push_back(mesh);
  return times;
}

/// Empty if a result is that of cut(), to the bit, or fails alike.
inline std::string brokenAgain(const mandoline::CutResult& again, const mandoline::CutResult& anew) {
  using namespace mandoline;
  if (again.error.status != anew.error.status || again.error.element != anew.error.element || again.error.message != anew.error.message)
    return "another error: " + again.error.message;
  for (const std::string& array : differences(again.mesh, anew.mesh)) return array + " differs";
  CutStats stats = again.stats;
  stats.stages = anew.stats.stages;
  stats.totalMs = anew.stats.totalMs;
  stats.exactFallbacks = anew.stats.exactFallbacks;
  return bytesOfFields(stats) == bytesOfFields(anew.stats) ? "" : "other counts";
}

/// Empty if that is so each time, of cut(), of recut(), and of both in turns. Adds the bricks that are kept.
inline std::string brokenRecut(const std::vector<mandoline::Mesh>& times, const mandoline::Grid& grid,
                               const mandoline::CutOptions& options = {}, size_t* kept = nullptr) {
  using namespace mandoline;
  Recutter recutter(grid, options), inPlace(grid, options), inTurns(grid, options);
  CutMesh last;
  for (size_t t = 0; t < times.size(); ++t) {
    const CutResult anew = cut(times[t], grid, options);
    CutResult again = recutter.cut(times[t], std::move(last));
    std::string broken = brokenAgain(again, anew);
    if (broken.empty()) broken = brokenAgain(inPlace.recut(times[t]), anew);
    if (broken.empty()) broken = brokenAgain(t % 3 == 2 ? inTurns.cut(times[t]) : inTurns.recut(times[t]), anew);
    if (!broken.empty()) return broken + " at time " + std::to_string(t);
    if (kept) *kept += recutter.counts().kept;
    last = std::move(again.mesh);
  }
  return "";
}
