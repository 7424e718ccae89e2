#include "mpi/sliced_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/position_table.h"
#include "mesh/fingerprints.h"
#include "mpi/find_corners.h"
#include "mpi/pack.h"

namespace mandoline::detail {
namespace {

std::vector<uint64_t> sumsBefore(const std::vector<uint64_t>& counts) {
  std::vector<uint64_t> sums{0};
  for (const uint64_t count : counts) sums.push_back(sums.back() + count);
  return sums;
}

/// In the order of the triangles, which tells 0 from -0.
MeshBox boxOfAll(Communicator& comm, const MeshPart& part) {
  constexpr size_t kWords = 9;  // of each process: least, greatest, and whether they are known
  std::vector<uint64_t> words;
  MeshBox here;
  comm.together(kSlicing, [&] {
    words.assign(kWords * size_t(comm.size()), 0);
    here = boxOf(MeshView(part.positions, part.corners));
  });
  uint64_t* own = &words[kWords * size_t(comm.rank())];
  for (size_t i = 0; i < part.positions.size(); ++i) own[6 + i % 3] |= uint64_t(std::isfinite(part.positions[i]));
  for (size_t d = 0; d < 3; ++d) own[d] = std::bit_cast<uint64_t>(here.min[d]), own[3 + d] = std::bit_cast<uint64_t>(here.max[d]);
  comm.reduce(words, MPI_SUM);
  MeshBox box;
  std::array<bool, 3> isFirst{true, true, true};
  for (size_t at = 0; at < words.size(); at += kWords) {
    for (size_t d = 0; d < 3; ++d) {
      if (words[at + 6 + d] == 0) continue;
      const double low = std::bit_cast<double>(words[at + d]), high = std::bit_cast<double>(words[at + 3 + d]);
      box.min[d] = isFirst[d] ? low : std::min(box.min[d], low);
      box.max[d] = isFirst[d] ? high : std::max(box.max[d], high);
      isFirst[d] = false;
    }
  }
  return box;
}

/// Of a fingerprint.
struct Sum {
  uint64_t state = 0;
  uint32_t odd = 0, hasOdd = 0;  // a number that waits for the next
};

}  // namespace

std::shared_ptr<const SlicedMeshData> sliced(Communicator& comm, std::shared_ptr<const Mesh> slice,
                                             std::shared_ptr<const MeshSource> whole) {
  const std::vector<uint64_t> vertices = comm.gatherAll(uint64_t(slice->vertexCount())),
                              triangles = comm.gatherAll(uint64_t(slice->triangleCount()));
  std::shared_ptr<SlicedMeshData> mesh;
  comm.together(kSlicing, [&] {
    mesh = std::make_shared<SlicedMeshData>();
    mesh->whole = std::move(whole);
    mesh->slice = std::move(slice);
    mesh->firstVertex = sumsBefore(vertices);
    mesh->firstTriangle = sumsBefore(triangles);
  });
  findCorners(comm, *mesh);
  if (mesh->isFit) mesh->box = boxOfAll(comm, mesh->part);
  mesh->bytesSent = comm.bytesSent();
  return mesh;
}

Mesh sliceOf(const MeshView& mesh, const ShareOf& shareOf) {
  const auto some = [&](const auto& numbers, size_t count, size_t items) {
    const size_t begin = shareOf.begin(count), end = shareOf.end(count);
    const bool isLast = shareOf.index + 1 == shareOf.count;  // with what is left where a length is wrong
    return std::vector(numbers.begin() + ptrdiff_t(begin * items), isLast ? numbers.end() : numbers.begin() + ptrdiff_t(end * items));
  };
  return {some(mesh.positions, mesh.vertexCount(), 3), some(mesh.triangles, mesh.triangleCount(), 3)};
}

MeshSums sumsOf(Communicator& comm, const SlicedMeshData& mesh) {
  Fingerprinter first("mesh");
  first.add(3 * mesh.vertices());
  Sum sum{first.state()};
  comm.addInOrder(kSlicing, std::span(&sum, 1), [&] {
    Fingerprinter fingerprinter = Fingerprinter::goingOn(sum.state);
    for (const double x : mesh.slice->positions) fingerprinter.add(x);
    sum.state = fingerprinter.state();
  });
  MeshSums sums{sum.state, {}};
  Fingerprinter second = Fingerprinter::goingOn(sum.state);
  second.add(3 * mesh.triangles());
  sum.state = second.state();
  comm.addInOrder(kSlicing, std::span(&sum, 1), [&] {
    Fingerprinter fingerprinter = Fingerprinter::goingOn(sum.state);
    for (const uint32_t v : mesh.slice->triangles) {
      if (sum.hasOdd != 0) fingerprinter.add(uint64_t(sum.odd) << 32 | v);
      sum.odd = v;
      sum.hasOdd ^= 1;
    }
    sum.state = fingerprinter.state();
  });
  Fingerprinter last = Fingerprinter::goingOn(sum.state);
  if (sum.hasOdd != 0) last.add(uint64_t(sum.odd));
  sums.whole = last.get();
  return sums;
}

double largestCoordinate(Communicator& comm, const SlicedMeshData& mesh) {
  double largest = 0;
  for (const double x : mesh.part.positions) largest = std::max(largest, std::isfinite(x) ? std::fabs(x) : INFINITY);
  return comm.reduce(largest, MPI_MAX);
}

void inspectArrays(Communicator& comm, const SlicedMeshData& mesh, const MeshPart& surface, MeshInfo& info) {
  info.min = mesh.box.min;
  info.max = mesh.box.max;
  info.vertices = mesh.vertices();
  info.triangles = mesh.triangles();
  std::vector<double> others;
  uint64_t counts[2] = {};  // of those without triangles: all, and not finite
  comm.together(kSlicing, [&] {
    for (size_t v = 0; v < mesh.isReferenced.size(); ++v) {
      if (mesh.isReferenced[v]) continue;
      const double* p = &mesh.slice->positions[3 * v];
      const bool isFinite = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
      ++counts[0];
      counts[1] += !isFinite;
      if (isFinite) others.insert(others.end(), p, p + 3);
    }
  });
  info.unreferencedVertices = comm.reduce(counts[0], MPI_SUM);
  info.nonFiniteVertices = comm.reduce(counts[1], MPI_SUM);
  if (info.unreferencedVertices == info.nonFiniteVertices) return;
  std::vector<std::vector<double>> forEach;
  comm.together(kSlicing, [&] { forEach.assign(size_t(comm.size()), others); });
  const std::vector<std::vector<double>> told = comm.exchangeAll(forEach);
  std::vector<uint8_t> isShared;  // per place whether a vertex that a triangle has is there, too
  comm.together(kSlicing, [&] {
    std::vector<double> all;
    for (const std::vector<double>& some : told) all.insert(all.end(), some.begin(), some.end());
    const auto at = [&](uint32_t v) { return &all[3 * size_t(v)]; };
    const std::vector<uint32_t> lowest = lowestAtPosition(all.size() / 3, at, [](uint32_t) { return true; });
    isShared.assign(lowest.size(), 0);
    const std::vector<uint32_t> here = lowestAt(all, surface);
    for (uint32_t v = 0; v < lowest.size(); ++v) {
      info.weldedVertices += lowest[v] != v;
      isShared[v] = lowest[v] == v && here[v] != ~0u;
    }
  });
  comm.uniteFlags(isShared);
  info.weldedVertices += size_t(std::count(isShared.begin(), isShared.end(), 1));
}

std::shared_ptr<const Mesh> gathered(Communicator& comm, const SlicedMeshData& mesh, bool inAll) {
  std::shared_ptr<Mesh> whole;
  comm.together(kSlicing, [&] {
    whole = std::make_shared<Mesh>();
    if (mesh.whole && (inAll || comm.rank() == 0)) *whole = readShare(*mesh.whole);
  });
  if (mesh.whole) return whole;
  whole->positions = comm.gather(mesh.slice->positions, inAll);
  whole->triangles = comm.gather(mesh.slice->triangles, inAll);
  return whole;
}

}  // namespace mandoline::detail

namespace mandoline {

SlicedMesh::SlicedMesh(MPI_Comm comm_, Mesh slice, std::shared_ptr<const detail::MeshSource> whole) {
  detail::Communicator comm(comm_, nullptr);
  std::shared_ptr<const Mesh> kept;
  comm.together(detail::kSlicing, [&] { kept = std::make_shared<const Mesh>(std::move(slice)); });
  data_ = detail::sliced(comm, std::move(kept), std::move(whole));
}
uint64_t SlicedMesh::vertexCount() const { return data_->vertices(); }
uint64_t SlicedMesh::triangleCount() const { return data_->triangles(); }
MeshBox SlicedMesh::box() const { return data_->box; }

}  // namespace mandoline
