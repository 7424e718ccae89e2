#include "mpi/find_corners.h"

#include <algorithm>

#include "mandoline/status.h"

namespace mandoline::detail {
namespace {

using IdList = std::vector<uint32_t>;

/// Finds the vertices of a slice's triangles, of which other processes have some.
class CornerFinder {
 public:
  CornerFinder(Communicator& comm, SlicedMeshData& mesh) : comm_(comm), mesh_(mesh), own_(size_t(comm.rank())) {}

  void find() {
    bool isFit = false;
    comm_.together(kSlicing, [&] {
      isFit = areFit();
      if (isFit) listCorners();
    });
    mesh_.isFit = comm_.reduce(int(isFit), MPI_MIN) != 0;
    if (!mesh_.isFit) return;
    if (mesh_.whole) {
      readCorners();
    } else {
      askForCorners();
    }
  }

 private:
  void readCorners() {
    MeshPart& part = mesh_.part;
    std::vector<uint8_t> isReferenced;
    comm_.together(kSlicing, [&] {
      if (mesh_.whole->vertices != mesh_.vertices() || mesh_.whole->triangles != mesh_.triangles())
        throw CallError({Status::badArgument, -1, -1, "What a process can read of the mesh is not that of the slices."});
      isReferenced.resize(size_t(mesh_.vertices()));
      for (const uint32_t v : part.vertices) isReferenced[v] = 1;
      part.positions.reserve(3 * part.vertices.size());
      forPositions(*mesh_.whole, [&](uint32_t v, const double* p) {
        if (isReferenced[v] != 0) part.positions.insert(part.positions.end(), p, p + 3);
      });
    });
    comm_.uniteFlags(isReferenced);
    const auto at = [&](uint64_t vertex) { return isReferenced.begin() + ptrdiff_t(vertex); };
    std::copy(at(mesh_.firstVertex[own_]), at(mesh_.firstVertex[own_ + 1]), mesh_.isReferenced.begin());
  }

  void askForCorners() {
    std::vector<IdList> asked;
    comm_.together(kSlicing, [&] {
      asked.resize(size_t(comm_.size()));
      listAsked(asked);
    });
    std::vector<IdList> told = comm_.exchangeAll(asked);
    std::vector<std::vector<double>> positions;
    comm_.together(kSlicing, [&] {
      positions.resize(told.size());
      for (size_t rank = 0; rank < told.size(); ++rank) positions[rank] = positionsOf(told[rank]);
    });
    positions = comm_.exchangeAll(positions);
    comm_.together(kSlicing, [&] { takeCorners(positions); });
  }

  bool areFit() const {
    constexpr uint64_t kMost = uint64_t(1) << 31;
    const Mesh& slice = *mesh_.slice;
    if (slice.positions.size() % 3 != 0 || slice.triangles.size() % 3 != 0) return false;
    if (mesh_.triangles() == 0 || mesh_.triangles() >= kMost || mesh_.vertices() >= kMost) return false;
    return std::all_of(slice.triangles.begin(), slice.triangles.end(), [&](uint32_t v) { return v < mesh_.vertices(); });
  }

  void listCorners() {
    mesh_.isReferenced.assign(mesh_.slice->vertexCount(), 0);
    const IdList& corners = mesh_.slice->triangles;
    const RankedSet vertices = rankedIds(corners);
    MeshPart& part = mesh_.part;
    part.vertices = idsOf(vertices);
    part.corners.reserve(corners.size());
    for (const uint32_t v : corners) part.corners.push_back(vertices.rankOf(v));
    for (size_t t = 0; t < corners.size() / 3; ++t) part.triangles.push_back(uint32_t(mesh_.firstTriangle[own_] + t));
  }

  void listAsked(std::vector<IdList>& asked) {
    size_t rank = 0;
    for (const uint32_t v : mesh_.part.vertices) {
      while (v >= mesh_.firstVertex[rank + 1]) ++rank;
      if (rank != own_) asked[rank].push_back(v);
    }
  }

  /// Of a vertex of the slice that a triangle has.
  const double* positionOf(uint32_t v) {
    const size_t at = size_t(v - mesh_.firstVertex[own_]);
    mesh_.isReferenced[at] = 1;
    return &mesh_.slice->positions[3 * at];
  }

  std::vector<double> positionsOf(const IdList& vertices) {
    std::vector<double> positions;
    positions.reserve(3 * vertices.size());
    for (const uint32_t v : vertices) {
      const double* p = positionOf(v);
      positions.insert(positions.end(), p, p + 3);
    }
    return positions;
  }

  /// Those of other processes come in the order in which they are asked for.
  void takeCorners(const std::vector<std::vector<double>>& told) {
    MeshPart& part = mesh_.part;
    std::vector<size_t> at(told.size(), 0);
    size_t rank = 0;
    part.positions.reserve(3 * part.vertices.size());
    for (const uint32_t v : part.vertices) {
      while (v >= mesh_.firstVertex[rank + 1]) ++rank;
      const double* p = rank == own_ ? positionOf(v) : &told[rank][at[rank]];
      at[rank] += 3;
      part.positions.insert(part.positions.end(), p, p + 3);
    }
  }

  Communicator& comm_;
  SlicedMeshData& mesh_;
  const size_t own_;  // this process's rank
};

}  // namespace

void findCorners(Communicator& comm, SlicedMeshData& mesh) { CornerFinder(comm, mesh).find(); }

}  // namespace mandoline::detail
