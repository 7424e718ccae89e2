// A grid-face that one chain of cut-edges parts in two, as most are that are not whole: neither a graph nor numbers of its vertices are
// needed. Else see chains.h.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "base/appender.h"
#include "cut/stages/stencil.h"

namespace mandoline::detail {

struct OneChain {
  static constexpr size_t kMostEdges = 16;

  uint32_t first, last;  ///< where it meets the outline, ascending
  // Its other vertices, from the first end to the last, and back, with room for a block more.
  std::array<VertexId, kMostEdges + kAppendedBlock> inside{}, back{};
  std::array<bool, kMostEdges> runsToLast;  ///< per edge
  uint32_t between;                         ///< of the pieces: that with the part of the outline between the ends
  uint32_t other;                           ///< that with the rest; to the left of the way from the first end to the last

  /// False unless the edges are one chain between two vertices of the outline that meets it nowhere else, and each of the pieces has three
  /// vertices or more. Pieces are in the order of Chains.
  bool find(std::span<const VertexId> outline, std::span<const EdgeOnFace> edges) {
    return !edges.empty() && edges.size() <= kMostEdges && findEnds(outline, edges) && walk(outline, edges) &&
           areLarge(outline.size(), edges.size());
  }

  /// The same if it is between two vertices of the outline: those at these places, ascending.
  bool findBetween(std::array<uint32_t, 2> ends, std::span<const VertexId> outline, std::span<const EdgeOnFace> edges) {
    if (edges.empty() || edges.size() > kMostEdges) return false;
    setEnds(ends[0], ends[1]);
    return walk(outline, edges) && isInside(outline, edges.size() - 1) && areLarge(outline.size(), edges.size());
  }

  /// Calls add(from, count) for the parts of a piece's loop.
  template <class F>
  void forLoop(uint32_t piece, std::span<const VertexId> outline, size_t edges, const F& add) const {
    const VertexId* line = outline.data();
    if (piece == between) {
      add(line + first, last + 1 - first);
      add(back.data(), edges - 1);
    } else if (first > 0) {
      add(line, first + 1);
      add(inside.data(), edges - 1);
      add(line + last, outline.size() - last);
    } else {
      add(line + last, outline.size() - last);
      add(line, 1);
      add(inside.data(), edges - 1);
    }
  }

 private:
  bool findEnds(std::span<const VertexId> outline, std::span<const EdgeOnFace> edges) {
    uint64_t maybe = 0;  // a bit for each vertex of the outline, and a few others
    for (const VertexId v : outline) maybe |= bitOf(v);
    uint32_t found = 0, at[2];
    const auto note = [&](VertexId v) {
      if (!(maybe & bitOf(v))) return true;
      const auto place = std::find(outline.begin(), outline.end(), v);
      if (place == outline.end()) return true;
      if (found == 2) return false;
      at[found++] = uint32_t(place - outline.begin());
      return true;
    };
    for (const EdgeOnFace& e : edges) {
      if (!note(e.from) || !note(e.to)) return false;
    }
    if (found < 2 || at[0] == at[1]) return false;
    setEnds(std::min(at[0], at[1]), std::max(at[0], at[1]));
    return true;
  }
  void setEnds(uint32_t atFirst, uint32_t atLast) {
    first = atFirst;
    last = atLast;
    between = first > 0;
    other = 1 - between;
  }
  /// Whether each piece has three vertices or more.
  bool areLarge(size_t outline, size_t edges) const { return last - first + edges > 2 && outline - (last - first) + edges > 2; }
  /// Whether none of the vertices between the ends, which are so many, is on the outline.
  bool isInside(std::span<const VertexId> outline, size_t count) const {
    bool isOn = false;  // no branches on what can't be foretold
    for (size_t i = 0; i < count; ++i) {
      for (const VertexId v : outline) isOn |= v == inside[i];
    }
    return !isOn;
  }
  static uint64_t bitOf(VertexId v) { return uint64_t(1) << v.number % 64; }

  /// From the first end to the last. False unless it takes all edges and finds one at each vertex.
  bool walk(std::span<const VertexId> outline, std::span<const EdgeOnFace> edges) {
    VertexId at = outline[first];
    uint32_t rest = (uint32_t(1) << edges.size()) - 1;
    for (size_t step = 0; rest != 0; ++step) {
      uint32_t here = 0;
      for (uint32_t e = 0; e < edges.size(); ++e) here |= uint32_t(edges[e].from == at || edges[e].to == at) << e;
      here &= rest;
      if (here == 0 || (here & (here - 1)) != 0) return false;
      rest ^= here;
      const size_t e = size_t(std::countr_zero(here));
      runsToLast[e] = edges[e].from == at;
      at = runsToLast[e] ? edges[e].to : edges[e].from;
      inside[step] = at;
      back[(edges.size() + kMostEdges - 2 - step) % kMostEdges] = at;  // that of the last end, which comes last, is left over
    }
    return at == outline[last];
  }
};

}  // namespace mandoline::detail
