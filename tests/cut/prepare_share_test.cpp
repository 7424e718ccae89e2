#include "mandoline/prepare_share.h"

#include "case_list.h"
#include "catch.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

struct Prepared {
  std::vector<PrepareResult> results;
  std::vector<size_t> pairs;  // of each share
};

Prepared prepareInShares(const Mesh& mesh, uint32_t count, const PrepareOptions& options) {
  std::vector<PrepareShare> shares;
  Prepared out;
  std::vector<uint32_t> all;
  for (uint32_t i = 0; i < count; ++i) {
    shares.emplace_back(ShareOf{i, count}, options);
    const std::vector<uint32_t> pairs = shares.back().findPairs(mesh);
    out.pairs.push_back(pairs.size() / 2);
    all.insert(all.begin(), pairs.begin(), pairs.end());  // in another order than that of the shares
    shares.back().findEdges();
  }
  for (PrepareShare& share : shares) out.results.push_back(share.resolve(all));
  return out;
}

template <class Call>
Error failureOf(const Call& call) {
  try {
    call();
  } catch (const CallError& error) {
    return error.error;
  }
  return {};
}

PrepareOptions with(Intersections intersections, unsigned threads = 1) {
  PrepareOptions options;
  options.intersections = intersections;
  options.threads = threads;
  return options;
}

}  // namespace

TEST_CASE("What shares prepare is cut as what one process prepares, to the bit", "[shares]") {
  for (const NamedCase& one : casesAndSoups()) {
    CAPTURE(one.name, one.mesh.triangleCount());
    for (const Intersections intersections : {Intersections::resolve, Intersections::assumeNone}) {
      const PrepareResult alone = prepare(one.mesh, with(intersections));
      const CutResult expected = cut(alone.mesh, one.grid);
      for (const uint32_t count : {1u, 2u, 5u}) {
        CAPTURE(count);
        for (const PrepareResult& shared : prepareInShares(one.mesh, count, with(intersections, 1 + count % 3)).results) {
          CHECK(shared.stats.intersections.total() == alone.stats.intersections.total());
          CHECK(shared.stats.stages.size() == alone.stats.stages.size());
          const CutResult result = cut(shared.mesh, one.grid);
          REQUIRE(result.error.status == expected.error.status);
          CHECK(differences(result.mesh, expected.mesh) == std::vector<std::string>());
        }
      }
    }
  }
}

TEST_CASE("Each pair is found by one share", "[shares]") {
  Mesh mesh;
  for (int i = 0; i < 6; ++i) mesh = shapes::merged({mesh, shapes::icosphere({1.5 * i, 0, 0}, 1, 3)});
  const uint64_t total = prepare(mesh).stats.intersections.total();
  for (const uint32_t count : {2u, 3u, 6u}) {
    const Prepared shared = prepareInShares(mesh, count, {});
    size_t found = 0;
    for (const size_t pairs : shared.pairs) {
      CHECK(pairs > 0);
      found += pairs;
    }
    CHECK(found == total);
  }
}

TEST_CASE("A mesh whose triangles meet is refused by all shares, whoever found them", "[shares]") {
  const Mesh mesh = shapes::merged({shapes::icosphere({0, 0, 0}, 1, 3), shapes::icosphere({5, 5, 5}, 1, 2), shapes::cube(4.5, 6)});
  const Error expected = prepare(mesh, with(Intersections::refuse)).error;
  REQUIRE(expected.status == Status::selfIntersection);
  PrepareShare first({0, 2}, with(Intersections::refuse)), second({1, 2}, with(Intersections::refuse));
  std::vector<uint32_t> pairs = first.findPairs(mesh);
  const std::vector<uint32_t> others = second.findPairs(mesh);
  pairs.insert(pairs.end(), others.begin(), others.end());
  for (PrepareShare* share : {&first, &second}) {
    share->findEdges();
    const Error error = failureOf([&] { share->resolve(pairs); });
    CHECK(error.status == expected.status);
    CHECK(error.message == expected.message);
    CHECK(error.element == expected.element);
  }
}

TEST_CASE("Numbers that are no pairs of triangles are refused", "[shares]") {
  const Mesh mesh = shapes::cube(0, 1);
  for (const auto& [pairs, element] :
       {std::pair<std::vector<uint32_t>, int64_t>{{0}, 0}, {{0, 1, 2}, 2}, {{1, 0}, 0}, {{3, 3}, 0}, {{0, 1, 2, 12}, 2}}) {
    PrepareShare share({0, 1});
    share.findPairs(mesh);
    share.findEdges();
    const Error error = failureOf([&, &pairs = pairs] { share.resolve(pairs); });
    CHECK(error.status == Status::badArgument);
    CHECK(error.element == element);
  }
}

TEST_CASE("A bad mesh fails in the first step as prepare() does", "[shares]") {
  const Mesh mesh{{0, 0, 0, 1, 0, 0}, {0, 1, 7}};
  const Error expected = prepare(mesh).error;
  PrepareShare share({0, 2});
  const Error error = failureOf([&] { share.findPairs(mesh); });
  CHECK(error.status == expected.status);
  CHECK(error.message == expected.message);
}
