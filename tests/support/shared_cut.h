// A cut in several shares, as processes without memory in common make it.
#pragma once

#include "mandoline/cut_share.h"

inline mandoline::CutResult cutInShares(const mandoline::PreparedMesh& mesh, const mandoline::Grid& grid, uint32_t count,
                                        const mandoline::RunOptions& options = {}, mandoline::detail::TakeExcerpt* takeExcerpt = nullptr) {
  using namespace mandoline;
  std::vector<CutShare> shares;
  std::vector<std::vector<uint32_t>> summaries;
  for (uint32_t i = 0; i < count; ++i) {
    shares.emplace_back(mesh, grid, ShareOf{i, count}, options, takeExcerpt);
    summaries.push_back(shares.back().summary());
  }
  std::vector<CutPart> parts;
  for (CutShare& share : shares) parts.push_back(share.part(summaries, options));
  return shares.front().join(std::move(parts));
}
