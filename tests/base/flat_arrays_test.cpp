// Ids of one kind and the arrays that go by them; memory for arrays.
#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <string>
#include <thread>
#include <type_traits>

#include "base/arena.h"
#include "base/csr.h"
#include "base/group_numbers.h"
#include "catch.h"
#include "cut/ids.h"
#include "mandoline/cut.h"

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

TEST_CASE("Numbers are grouped alike by any number of threads, and those without a group are left out", "[base]") {
  constexpr size_t kCount = 20000, kGroups = 7;
  const auto groupOf = [](size_t i) { return i % 3 == 0 ? kNoGroup : uint32_t(i * i % kGroups); };
  std::vector<uint32_t> grouped;
  for (uint32_t i = 0; i < kCount; ++i) {
    if (groupOf(i) != kNoGroup) grouped.push_back(i);
  }
  const auto expected = groupBy<uint32_t>(
      kGroups, grouped.size(), [&](size_t i) { return groupOf(grouped[i]); }, [&](size_t i) { return grouped[i]; });
  for (const unsigned threads : {1u, 2u, 3u}) {
    mandoline::CutOptions options;
    options.threads = threads;
    Monitor monitor(options, 1);
    const auto found = groupNumbers(kGroups, kCount, monitor, groupOf);
    CHECK(found.offsets == expected.offsets);
    CHECK(found.items == expected.items);
    CHECK(groupNumbers(kGroups, 0, monitor, groupOf).offsets == std::vector<uint32_t>(kGroups + 1, 0));
  }
}

TEST_CASE("An arena keeps what was copied into it, also where it is moved", "[base]") {
  Arena arena;
  std::vector<std::vector<uint32_t>> originals;
  std::vector<std::span<const uint32_t>> copies;
  // From none to more than one block has, so that small ones lie between large ones.
  for (const size_t size : {0u, 1u, 3u, 1000u, 20'000u, 5u, 600'000u, 0u, 7u, 1'500'000u, 2u, 30'000u}) {
    originals.emplace_back();
    for (size_t i = 0; i < size; ++i) originals.back().push_back(uint32_t(31 * size + i));
    copies.push_back(arena.copy(originals.back()));
  }
  const std::array<double, 2> doubles = {0.5, -2};
  const auto aligned = arena.copy(std::span<const double>(doubles));
  CHECK(reinterpret_cast<uintptr_t>(aligned.data()) % alignof(double) == 0);
  const Arena moved = std::move(arena);
  for (size_t i = 0; i < originals.size(); ++i)
    CHECK(std::equal(copies[i].begin(), copies[i].end(), originals[i].begin(), originals[i].end()));
  CHECK((aligned[0] == 0.5 && aligned[1] == -2));
}

TEST_CASE("An arena makes arrays that are written in place", "[base]") {
  Arena arena;
  CHECK(arena.make<uint32_t>(0, [](std::span<uint32_t>) { FAIL("there is nothing to write"); }).empty());
  const auto made = arena.make<uint32_t>(5, [](std::span<uint32_t> items) { std::iota(items.begin(), items.end(), 7u); });
  const std::array<uint32_t, 2> more = {1, 2};
  arena.copy(std::span<const uint32_t>(more));
  CHECK(std::vector<uint32_t>(made.begin(), made.end()) == std::vector<uint32_t>{7, 8, 9, 10, 11});
}

TEST_CASE("An array that is lengthened in its room keeps what it has, and one that is too long is cut", "[base]") {
  constexpr size_t kLong = 300000;  // several steps
  std::vector<int> items = {1, 2, 3};
  reserveUntouched(items, kLong);
  const int* const room = items.data();
  resizeInRoom(items, kLong);
  CHECK((items.data() == room && items.size() == kLong));
  CHECK((items[0] == 1 && items[2] == 3));
  CHECK(std::count(items.begin() + 3, items.end(), 0) == ptrdiff_t(kLong - 3));
  resizeInRoom(items, 2);
  CHECK(items == std::vector<int>{1, 2});
}

TEST_CASE("Getting pages changes nothing that is there", "[base]") {
  std::vector<uint32_t> numbers(3'000'000);
  for (size_t i = 0; i < numbers.size(); ++i) numbers[i] = uint32_t(i);
  for (const size_t first : {0u, 1u, 1000u, 524'289u}) {
    for (const size_t count : {0u, 1u, 5000u, 700'000u, 2'000'000u}) getPages(numbers.data() + first, 4 * count);
  }
  bool areSame = true;
  for (size_t i = 0; i < numbers.size(); ++i) areSame &= numbers[i] == uint32_t(i);
  CHECK(areSame);

  std::vector<int8_t> made, same;
  makeLarge(made, 5'000'001, -1);
  CHECK((made.size() == 5'000'001 && std::all_of(made.begin(), made.end(), [](int8_t x) { return x == -1; })));
  copyLarge(made, same);
  CHECK((same == made));
}

TEST_CASE("Large arrays begin where large pages do, if there are such, also once they have grown", "[base]") {
  LargeVector<uint64_t> items;
  for (uint64_t i = 0; i < 1'000'000; ++i) items.push_back(i * i);
  CHECK(reinterpret_cast<uintptr_t>(items.data()) % (kHasLargePages ? kPageAlignment : alignof(uint64_t)) == 0);
  LargeVector<uint64_t> copy = items;
  items = {};
  bool isSame = true;
  for (uint64_t i = 0; i < copy.size(); ++i) isSame = isSame && copy[i] == i * i;
  CHECK(isSame);
}

// What watches memory has a heap of its own.
#ifdef __has_feature
#define MANDOLINE_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer))
#else
#define MANDOLINE_SANITIZED 0
#endif
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !MANDOLINE_SANITIZED

namespace {

/// The flags of the mapping in which an address lies: "hg" is among them where large pages are preferred.
std::string mappingFlags(const void* address) {
  std::ifstream file("/proc/self/smaps");
  const auto at = reinterpret_cast<uintptr_t>(address);
  bool isThere = false;
  for (std::string line; std::getline(file, line);) {
    uintptr_t begin = 0, end = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &begin, &end) == 2) isThere = begin <= at && at < end;
    if (isThere && line.starts_with("VmFlags:")) return line + " ";
  }
  return "";
}

/// Of an array that is made once there is room, in its middle.
std::string flagsInRoom() {
  makeRoomInHeap();
  const std::vector<char> array(size_t(12) << 20, 'x');
  return mappingFlags(array.data() + array.size() / 2);
}

}  // namespace

TEST_CASE("Arrays lie in large pages of the heap once there is room, on any thread", "[base]") {
  std::string here = flagsInRoom(), there;
  if (here.empty()) return;  // the system doesn't tell
  std::thread([&] { there = flagsInRoom(); }).join();
  CHECK(here.find(" hg ") != here.npos);
  CHECK(there.find(" hg ") != there.npos);
}

TEST_CASE("The first arrays of a new thread lie in large pages, too", "[base]") {
  std::string flags;
  std::thread([&] {
    const HeapBegin begin = makeRoomInNewHeap();
    const std::vector<char> array(size_t(1) << 18, 'x');
    flags = mappingFlags(array.data() + array.size() / 2);
  }).join();
  if (flags.empty()) return;  // the system doesn't tell
  CHECK(flags.find(" hg ") != flags.npos);
}

#endif
