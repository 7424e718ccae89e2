// Ids of one kind and the arrays that go by them.
#include <type_traits>

#include "base/csr.h"
#include "catch.h"
#include "cut/ids.h"

using namespace mandoline::detail;

namespace {

template <class Array, class Index>
concept HasItemAt = requires(const Array& array, Index index) {
  array[index];
};

using PerVertex = IdVector<VertexId, int>;
using PerCell = Csr<int, CellId>;

static_assert(HasItemAt<PerVertex, VertexId> && !HasItemAt<PerVertex, TriEdgeId> && !HasItemAt<PerVertex, size_t>);
static_assert(HasItemAt<PerCell, CellId> && !HasItemAt<PerCell, GridCellId> && !HasItemAt<PerCell, size_t>);
static_assert(!std::is_convertible_v<TriEdgeId, TriangleId> && !std::is_convertible_v<uint32_t, TriangleId>);
static_assert(sizeof(VertexId) == sizeof(uint32_t) && std::is_trivially_copyable_v<VertexId>);

template <class Group>
std::vector<std::vector<int>> listOf(const Csr<int, Group>& csr) {
  std::vector<std::vector<int>> groups;
  for (const auto group : csr.groups(0, csr.size())) groups.push_back({group.begin(), group.end()});
  return groups;
}

}  // namespace

TEST_CASE("Ids in a row are looped over in order", "[base]") {
  std::vector<uint32_t> numbers;
  for (const FaceId f : Ids<FaceId>(2, 5)) numbers.push_back(f.number);
  for (const FaceId f : Ids<FaceId>(FaceId{7}, FaceId{7})) numbers.push_back(f.number);
  for (const FaceId f : IdVector<FaceId, int>(2).ids()) numbers.push_back(f.number);
  CHECK(numbers == std::vector<uint32_t>{2, 3, 4, 0, 1});
}

TEST_CASE("Groups of chunks are joined in order, empty ones too", "[base]") {
  const PerCell first{{0, 2, 2}, {1, 2}}, second{{0, 0, 1, 3}, {3, 4, 5}};
  PerCell joined;
  joined.append(first);
  joined.append(PerCell());
  joined.append(second, [](int item) { return 10 * item; });
  CHECK(listOf(joined) == std::vector<std::vector<int>>{{1, 2}, {}, {}, {30}, {40, 50}});
  CHECK(joined[CellId{4}].size() == 2);
}

TEST_CASE("A group is what was appended since the last one ended", "[base]") {
  Csr<int> csr;
  csr.items = {1, 2};
  csr.endGroup();
  csr.endGroup();
  csr.items.push_back(3);
  csr.endGroup();
  CHECK(listOf(csr) == std::vector<std::vector<int>>{{1, 2}, {}, {3}});
}

TEST_CASE("Items are grouped by id in the order in which they come", "[base]") {
  const std::vector<CellId> cells = {{2}, {0}, {2}, {0}, {2}};
  const PerCell csr = groupBy<int, CellId>(
      4, cells.size(), [&](size_t i) { return cells[i]; }, [](size_t i) { return int(i); });
  CHECK(listOf(csr) == std::vector<std::vector<int>>{{1, 3}, {}, {0, 2, 4}, {}});
}
