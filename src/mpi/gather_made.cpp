#include "mpi/gather_made.h"

#include "cut/append.h"

namespace mandoline::detail {
namespace {

constexpr size_t kWords = 6;  // of a made vertex

std::vector<uint32_t> wordsOf(const CutMesh& part) {
  std::vector<uint32_t> words;
  for (size_t i = 0; i < part.madeVertices.size(); ++i) {
    words.insert(words.end(), {part.madeVertices[i], part.madeVertexKinds[i]});
    for (size_t k = 0; k < 4; ++k) words.push_back(uint32_t(part.madeVertexParents[4 * i + k]));
  }
  return words;
}

/// `all`: words of each process.
void joinWords(const std::vector<std::vector<uint32_t>>& all, CutResult& common) {
  std::vector<CutMesh> made(all.size());
  std::vector<const CutMesh*> parts;
  for (size_t rank = 0; rank < all.size(); ++rank) {
    for (size_t at = 0; at < all[rank].size(); at += kWords) {
      const uint32_t* from = &all[rank][at];
      made[rank].madeVertices.push_back(from[0]);
      made[rank].madeVertexKinds.push_back(uint8_t(from[1]));
      for (size_t k = 2; k < kWords; ++k) made[rank].madeVertexParents.push_back(int32_t(from[k]));
    }
    parts.push_back(&made[rank]);
  }
  joinMade(parts, common.mesh);
  common.stats.madeVertices = uint32_t(common.mesh.madeVertices.size());
}

}  // namespace

void gatherMade(Communicator& comm, const CutMesh& part, CutResult& common) {
  constexpr const char* kNoun = "cut";
  std::vector<uint32_t> words;
  comm.together(kNoun, [&] { words = wordsOf(part); });
  const std::vector<std::vector<uint32_t>> all = comm.gatherAll(words);
  comm.together(kNoun, [&] { joinWords(all, common); });
}

}  // namespace mandoline::detail
