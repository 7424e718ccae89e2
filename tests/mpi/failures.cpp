// What becomes of all processes if one of them fails anywhere in a distributed cut. Run by MPI in two or more processes:
//
//   mandoline-mpi-failures STEP
//
// lets one allocation after the other fail in a process, by STEP percent more of them each time, and has a mesh change, or end, while a
// process reads it. All have to report that alike, and none may wait for more than ten seconds. Where threads can't be started, the others
// do all. And gathering a mesh takes memory for it once.
#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <new>

#include "mandoline/distributed.h"
#include "mandoline/mesh_files.h"
#include "mesh/mesh_source.h"
#include "mpi/pack.h"
#include "mpi/sliced_mesh.h"
#include "ranks_here.h"
#include "shapes.h"

using namespace mandoline;

namespace {

/// Allocations of this process until one fails; negative where none does.
std::atomic<int64_t> allocationsLeft{-1};
bool failsFromThenOn = false;

/// Threads of this process that can still be started, negative where all can; and how many were not.
std::atomic<int> threadsLeft{-1}, threadsRefused{0};

bool failsNow() {
  if (allocationsLeft.load(std::memory_order_relaxed) < 0) return false;
  if (allocationsLeft.fetch_sub(1) > 0) return false;
  if (failsFromThenOn) allocationsLeft = 0;
  return true;
}

/// In all so far.
std::atomic<size_t> bytesAllocated{0};

void* allocate(size_t bytes) {
  bytesAllocated += bytes;
  void* const found = failsNow() ? nullptr : std::malloc(bytes > 0 ? bytes : 1);
  if (!found) throw std::bad_alloc();
  return found;
}
void* allocateAligned(size_t bytes, std::align_val_t alignment) {
  const size_t unit = size_t(alignment);
  bytesAllocated += bytes;
  void* const found = failsNow() ? nullptr : std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
  if (!found) throw std::bad_alloc();
  return found;
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*), void* argument) noexcept {
  if (threadsLeft >= 0 && threadsLeft-- <= 0) {
    threadsLeft = 0;
    ++threadsRefused;
    return EAGAIN;
  }
  const auto create = reinterpret_cast<decltype(&pthread_create)>(dlsym(RTLD_NEXT, "pthread_create"));
  return create(thread, attributes, start, argument);
}

void* operator new(size_t bytes) { return allocate(bytes); }
void* operator new[](size_t bytes) { return allocate(bytes); }
void* operator new(size_t bytes, std::align_val_t alignment) { return allocateAligned(bytes, alignment); }
void* operator new[](size_t bytes, std::align_val_t alignment) { return allocateAligned(bytes, alignment); }
void operator delete(void* at) noexcept { std::free(at); }
void operator delete[](void* at) noexcept { std::free(at); }
void operator delete(void* at, size_t) noexcept { std::free(at); }
void operator delete[](void* at, size_t) noexcept { std::free(at); }
void operator delete(void* at, std::align_val_t) noexcept { std::free(at); }
void operator delete[](void* at, std::align_val_t) noexcept { std::free(at); }
void operator delete(void* at, size_t, std::align_val_t) noexcept { std::free(at); }
void operator delete[](void* at, size_t, std::align_val_t) noexcept { std::free(at); }

namespace {

int all(int number, MPI_Op op) {
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_INT, op, MPI_COMM_WORLD);
  return number;
}

constexpr unsigned kSeconds = 10;
std::string current;  // what is tried

[[noreturn]] void onAlarm(int) {
  std::cerr << current << ": process " << rankHere() << " waits" << std::endl;
  _exit(1);
}

/// How a process ended what was tried.
struct Outcome {
  int status = 0, rank = -1;  // of a RankError
  bool isOther = false;       // another exception
  std::string message;
};

template <class Work>
Outcome outcomeOf(const Work& work) {
  Outcome outcome;
  try {
    work();
  } catch (const RankError& error) {
    outcome.status = int(error.error.status);
    outcome.rank = error.rank;
    allocationsLeft = -1;
    outcome.message = error.error.message;
  } catch (...) {
    outcome.isOther = true;
  }
  allocationsLeft = -1;
  return outcome;
}

size_t wrong = 0;

void require(bool holds, const Outcome& outcome) {
  if (holds) return;
  ++wrong;
  std::cerr << current << ": process " << rankHere() << (outcome.isOther ? " has another exception" : "") << ", status " << outcome.status
            << " of " << outcome.rank << ": " << outcome.message << std::endl;
}

Mesh sliceHere(const Mesh& mesh) {
  const auto some = [](const auto& numbers) {
    const auto at = [&](int rank) { return numbers.begin() + ptrdiff_t(numbers.size() / 3 * size_t(rank) / size_t(ranksHere()) * 3); };
    return std::vector(at(rankHere()), at(rankHere() + 1));
  };
  return {some(mesh.positions), some(mesh.triangles)};
}

enum class Given { whole, slices };

/// All that is collective.
void cutAll(const Mesh& mesh, const Grid& grid, Given given) {
  const int64_t left = allocationsLeft.exchange(-1);  // what follows is the caller's
  MeshInfo info;
  std::optional<DistributedCut> cut;
  std::shared_ptr<const Mesh> kept;
  if (given == Given::whole) kept = std::make_shared<const Mesh>(mesh);
  Mesh slice = sliceHere(mesh);
  Grid ofCut = grid;
  allocationsLeft = left;
  if (given == Given::whole)
    cut.emplace(MPI_COMM_WORLD, std::move(kept), std::move(ofCut), PrepareOptions{{1, {}}}, &info);
  else
    cut.emplace(MPI_COMM_WORLD, SlicedMesh(MPI_COMM_WORLD, std::move(slice)), std::move(ofCut), PrepareOptions{{1, {}}}, &info);
  const RankPiece piece = cut->piece();
  const std::vector<double> volumes = cut->regionVolumes(piece);
  cut->cellComplex(piece);
  cut->cellComplex(piece, 1, CoarsenOptions{{1, {}}});
  cut->gather();
}

/// How many allocations have failed.
size_t failAllocations(const std::string& name, double step, const std::function<void()>& work) {
  size_t tried = 0;
  for (const bool isLasting : {false, true}) {
    for (const int failing : {0, ranksHere() - 1}) {
      for (double at = 0;; at = std::floor(at * (1 + step / 100)) + 1) {
        current = name + ", " + (isLasting ? "from allocation " : "allocation ") + std::to_string(int64_t(at)) + " of process " +
                  std::to_string(failing);
        alarm(kSeconds);
        failsFromThenOn = isLasting;
        int64_t left = -1;
        if (rankHere() == failing) allocationsLeft = int64_t(at);
        const Outcome outcome = outcomeOf([&] {
          work();
          left = allocationsLeft;
        });
        const bool isOver = all(rankHere() == failing && left > 0, MPI_MAX) != 0;
        const bool hasThrown = outcome.rank >= 0 || outcome.isOther;
        const bool haveAny = all(hasThrown, MPI_MAX) != 0;
        if (haveAny) {  // else it has done without
          ++tried;
          const bool isSaid = outcome.rank == failing && outcome.status == int(Status::outOfMemory) && !outcome.message.empty();
          require(isSaid || (isLasting && outcome.isOther && rankHere() == failing), outcome);
        }
        if (isOver || all(wrong > 0, MPI_MAX) != 0) break;
      }
    }
  }
  return tried;
}

/// A mesh that is another one, or can't be read, from one reading on. Each reading is of all vertices, or all triangles.
class ChangingSource : public detail::MeshSource {
 public:
  enum class Change { moved, notFinite, corner, ended };

  ChangingSource(Mesh mesh, Change change, int from) : mesh_(std::move(mesh)), change_(change), left_(from) {
    vertices = mesh_.vertexCount();
    triangles = mesh_.triangleCount();
  }
  void readPositions(uint64_t first, std::span<double> positions) const override {
    begin(first);
    std::copy_n(mesh_.positions.begin() + ptrdiff_t(3 * first), positions.size(), positions.begin());
    if (!isOther_ || change_ == Change::corner) return;
    for (double& x : positions) x = change_ == Change::moved ? -x : NAN;
  }
  void readCorners(uint64_t first, std::span<uint32_t> corners) const override {
    begin(first);
    std::copy_n(mesh_.triangles.begin() + ptrdiff_t(3 * first), corners.size(), corners.begin());
    if (isOther_ && change_ == Change::corner) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
  bool hasChanged() const { return isOther_; }

 private:
  void begin(uint64_t first) const {
    if (first == 0) isOther_ = left_-- <= 0;
    if (isOther_ && change_ == Change::ended) throw FileError("mesh.ply: byte 9: can't be read");
  }

  const Mesh mesh_;
  const Change change_;
  mutable int left_;
  mutable bool isOther_ = false;
};

/// A process finds a longer or a shorter mesh than that of the slices.
size_t changeLengths(const Mesh& mesh) {
  size_t tried = 0;
  for (const int changing : {0, ranksHere() - 1}) {
    for (const bool isLonger : {false, true}) {
      current = std::string(isLonger ? "longer" : "shorter") + " mesh of process " + std::to_string(changing);
      alarm(kSeconds);
      const Mesh other = isLonger ? shapes::merged({mesh, mesh}) : shapes::cube(0, 1);
      const auto source =
          std::make_shared<const ChangingSource>(rankHere() == changing ? other : mesh, ChangingSource::Change::moved, 1000);
      const Outcome outcome = outcomeOf([&] { SlicedMesh(MPI_COMM_WORLD, sliceHere(mesh), source); });
      require(outcome.rank == changing && outcome.status == int(Status::badArgument), outcome);
      ++tried;
    }
  }
  return tried;
}

size_t changeMeshes(const Mesh& mesh, const Grid& grid) {
  using Change = ChangingSource::Change;
  size_t tried = 0;
  for (const Change change : {Change::moved, Change::notFinite, Change::corner, Change::ended}) {
    for (const int changing : {0, ranksHere() - 1}) {
      for (int from = 1;; ++from) {  // the first reading is that of the slices' vertices
        current =
            "change " + std::to_string(int(change)) + " before reading " + std::to_string(from) + " of process " + std::to_string(changing);
        alarm(kSeconds);
        const auto source = std::make_shared<const ChangingSource>(mesh, change, rankHere() == changing ? from : 1000);
        const Outcome outcome = outcomeOf([&] {
          MeshInfo info;
          DistributedCut(MPI_COMM_WORLD, SlicedMesh(MPI_COMM_WORLD, sliceHere(mesh), source), grid, PrepareOptions{{1, {}}}, &info);
        });
        if (all(source->hasChanged(), MPI_MAX) == 0) break;
        if (all(outcome.rank >= 0 || outcome.isOther, MPI_MAX) == 0 && change == Change::corner) continue;  // vertices are the same
        ++tried;
        const bool isSaid = outcome.message.find(change == Change::ended ? "can't be read" : "has changed") != std::string::npos;
        require(isSaid && outcome.rank == changing && outcome.status == int(Status::badArgument), outcome);
        if (all(wrong > 0, MPI_MAX) != 0) return tried;
      }
    }
  }
  return tried;
}

/// Of so many threads of each process some, or none, can be started in one of them. Gives how many could not.
size_t refuseThreads(const Mesh& mesh, const Grid& grid) {
  constexpr unsigned kThreads = 4;
  const auto cutByThreads = [&] {
    const DistributedCut cut(MPI_COMM_WORLD, std::make_shared<const Mesh>(mesh), grid, PrepareOptions{{kThreads, {}}});
    return detail::packed(cut.piece().cutMesh);
  };
  current = "threads";
  alarm(kSeconds);
  const std::vector<std::byte> expected = cutByThreads();
  for (const int failing : {0, ranksHere() - 1}) {
    for (int left = 0; left + 1 < int(kThreads); ++left) {
      current = std::to_string(left) + " threads of process " + std::to_string(failing);
      alarm(kSeconds);
      threadsRefused = 0;
      if (rankHere() == failing) threadsLeft = left;
      bool isSame = false;
      const Outcome outcome = outcomeOf([&] { isSame = cutByThreads() == expected; });
      threadsLeft = -1;
      require(isSame && (threadsRefused > 0) == (rankHere() == failing), outcome);
    }
  }
  return size_t(2 * (kThreads - 1));
}

/// Slices come to where they stay.
void gatherOnce(const Mesh& mesh) {
  detail::Communicator comm(MPI_COMM_WORLD, nullptr);
  for (const bool inAll : {false, true}) {
    current = std::string("gathering in ") + (inAll ? "all" : "the first");
    alarm(kSeconds);
    const SlicedMesh slices(MPI_COMM_WORLD, sliceHere(mesh));
    std::shared_ptr<const Mesh> whole;
    const size_t before = bytesAllocated;
    const Outcome outcome = outcomeOf([&] { whole = detail::gathered(comm, *slices.data(), inAll); });
    const size_t taken = bytesAllocated - before, bytes = sizeof(double) * mesh.positions.size() + sizeof(uint32_t) * mesh.triangles.size();
    const Mesh expected = inAll || rankHere() == 0 ? mesh : Mesh();
    const bool isWhole = whole && whole->positions == expected.positions && whole->triangles == expected.triangles;
    require(isWhole && taken < bytes + bytes / 10, outcome);
  }
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  std::signal(SIGALRM, onAlarm);
  const double step = argc > 1 ? std::atof(argv[1]) : 10;
  const Mesh ball = shapes::icosphere({0, 0, 0}, 1, 2), both = shapes::merged({ball, shapes::cube(0, 2)});
  Mesh open = shapes::merged({ball, shapes::cube(2, 3)});
  open.triangles.resize(open.triangles.size() - 3);
  size_t allocations = 0;
  for (const auto& [name, mesh] : {std::pair("closed", ball), {"open", open}, {"intersecting", both}}) {
    const Grid grid = Grid::around(mesh, 5);
    for (const Given given : {Given::whole, Given::slices}) {
      const std::string what = std::string(name) + (given == Given::slices ? " in slices" : "");
      allocations += failAllocations(what, step, [&, &m = mesh] { cutAll(m, grid, given); });
    }
  }
  const size_t changes =
      changeLengths(ball) + changeMeshes(shapes::merged({shapes::icosphere({0, 0, 0}, 1, 4), shapes::cube(1, 2)}), Grid::around(ball, 9));
  const size_t threads = refuseThreads(shapes::icosphere({0, 0, 0}, 1, 5), Grid::around(ball, 65));
  gatherOnce(shapes::icosphere({0, 0, 0}, 1, 5));
  alarm(0);
  const int anyWrong = all(int(wrong), MPI_MAX);
  if (rankHere() == 0)
    std::cout << allocations << " allocations and " << changes << " readings have failed, and " << threads << " times threads" << std::endl;
  MPI_Finalize();
  return anyWrong == 0 && allocations > 0 && changes > 0 ? 0 : 1;
}
