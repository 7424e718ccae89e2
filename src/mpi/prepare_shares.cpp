#include "mpi/prepare_shares.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"
#include "mpi/pack.h"
#include "mpi/sliced_mesh.h"

namespace mandoline::detail {
namespace {

constexpr const char* kPreparation = "preparation";

class SharesPreparer {
 public:
  SharesPreparer(Communicator& comm, const SlicedMeshData& mesh, const MeshFacts& facts, const Grid& grid, const PrepareOptions& options)
      : comm_(comm), mesh_(mesh), maker_(facts, grid, {uint32_t(comm.rank()), uint32_t(comm.size())}, options), scale_(facts.shift) {}

  std::unique_ptr<ShareInput> run(MeshInfo* info) {
    std::vector<uint64_t> work;
    if (!allGoOn([&] { return maker_.begin(mesh_.part, work); })) return nullptr;
    comm_.reduce(work, MPI_SUM);
    comm_.together(kPreparation, [&] { maker_.makeBands(work); });
    BandTriangles triangles = gather();
    if (!allGoOn([&] { return maker_.prepare(std::move(triangles)); }) || !findWhole()) return nullptr;
    joinParts(info != nullptr);
    comm_.reduce(all_.cornerWinding, MPI_SUM);
    uniteTriangles();
    uniteCrossings();
    if (info) inspectMesh(*info);
    std::unique_ptr<ShareInput> input;
    comm_.together(kPreparation, [&] { input = maker_.take(all_); });
    return input;
  }

 private:
  template <class Body>
  bool allGoOn(const Body& body) {
    bool goesOn = false;
    comm_.together(kPreparation, [&] { goesOn = body(); });
    return comm_.reduce(int(goesOn), MPI_MIN) != 0;
  }

  /// In the first process.
  void inspectMesh(MeshInfo& info) {
    MeshInfo found;
    if (whole_.edges.haveAtMostTwo) {
      found = inspectPlain(inspectArrays(comm_, mesh_, maker_.surface()), whole_, maker_.partCounts());
    } else {
      const std::shared_ptr<const Mesh> mesh = gathered(comm_, mesh_, false);
      comm_.together(kPreparation, [&] {
        if (comm_.rank() == 0) found = inspect(*mesh);
      });
    }
    if (comm_.rank() == 0) info = std::move(found);
  }

  /// Parts for others, and those that come from them, as one.
  MeshPart exchange(const std::vector<MeshPart>& parts, MeshPart own) {
    std::vector<Communicator::Bytes> bytes(size_t(comm_.size()));
    comm_.together(kPreparation, [&] {
      for (size_t rank = 0; rank < parts.size(); ++rank) {
        if (!parts[rank].triangles.empty()) bytes[rank] = packed(parts[rank]);
      }
    });
    bytes = comm_.exchangeAll(bytes);
    MeshPart all;
    comm_.together(kPreparation, [&] {
      std::vector<MeshPart> told{std::move(own)};
      for (const Communicator::Bytes& some : bytes) {
        if (!some.empty()) told.push_back(unpacked<MeshPart>(some));
      }
      all = united(told);
    });
    return all;
  }

  /// For each process what it asks of the others, and gives of what it has to those who ask.
  using Positions = std::vector<std::vector<double>>;
  Positions ask(const MeshPart& part, const std::vector<uint8_t>& isAsked) {
    Positions asked;
    comm_.together(kPreparation,
                   [&] { asked = positionsElsewhere(part, heightsOf(part, scale_), isAsked, BandFinder(maker_.bands()), maker_.band()); });
    return asked;
  }

  /// What this process's band has of the mesh.
  BandTriangles gather() {
    if (!mesh_.whole) return gatherFromOthers();
    BandTriangles triangles;
    comm_.together(kPreparation, [&] { triangles = readBand(*mesh_.whole, scale_, maker_.band()); });
    return triangles;
  }

  BandTriangles gatherFromOthers() {
    const size_t count = size_t(comm_.size());
    std::vector<MeshPart> parts;
    comm_.together(kPreparation, [&] { parts = trianglesOfBands(mesh_.part, heightsOf(mesh_.part, scale_), BandFinder(maker_.bands())); });
    const MeshPart within = exchange(parts, {});
    Positions told = comm_.exchangeAll(ask(within, std::vector<uint8_t>(within.vertices.size(), 1)));
    comm_.together(kPreparation, [&] {
      const std::vector<double> heights = heightsOf(within, scale_);
      for (size_t rank = 0; rank < count; ++rank) parts[rank] = trianglesAt(told[rank], within, heights, maker_.bands()[rank]);
    });
    BandTriangles triangles;
    triangles.part = exchange(parts, within);
    std::vector<uint8_t> isFar;  // per vertex
    comm_.together(kPreparation, [&] {
      const std::vector<uint32_t>& ids = within.triangles;
      for (const uint32_t t : triangles.part.triangles) triangles.isWithin.push_back(std::binary_search(ids.begin(), ids.end(), t));
      findLowest(triangles);
      for (const uint8_t flag : triangles.isComplete) isFar.push_back(!flag);
    });
    const Positions asked = ask(triangles.part, isFar);
    told = comm_.exchangeAll(asked);
    std::vector<std::vector<uint32_t>> lowest(count);
    comm_.together(kPreparation, [&] {
      for (size_t rank = 0; rank < count; ++rank) lowest[rank] = lowestAt(told[rank], within);
    });
    lowest = comm_.exchangeAll(lowest);
    comm_.together(kPreparation, [&] {
      for (size_t rank = 0; rank < count; ++rank) takeLowest(asked[rank], lowest[rank], triangles);
    });
    return triangles;
  }

  /// False if the mesh has parts that take more than what each band knows.
  bool findWhole() {
    comm_.together(kPreparation, [&] { whole_ = maker_.found(); });
    BandEdges& edges = whole_.edges;
    std::vector<int> flags = {edges.closed, edges.oriented, edges.haveAtMostTwo};
    comm_.reduce(flags, MPI_MIN);
    std::vector<uint64_t> counts = {edges.open, edges.inconsistent, whole_.weldedVertices};
    comm_.reduce(counts, MPI_SUM);
    edges = {flags[0] != 0, flags[1] != 0, flags[2] != 0, counts[0], counts[1]};
    whole_.weldedVertices = counts[2];
    return edges.closed || edges.haveAtMostTwo;
  }

  void joinParts(bool areCounted) {
    BandParts own;
    std::vector<BandParts> all(size_t(comm_.size()));
    if (!whole_.edges.closed || areCounted) {
      comm_.together(kPreparation, [&] { own = maker_.parts(); });
      for (const auto member : {&BandParts::kinds, &BandParts::shared, &BandParts::openEdges}) {
        std::vector<std::vector<uint32_t>> told = comm_.gatherAll(own.*member);
        for (size_t rank = 0; rank < all.size(); ++rank) all[rank].*member = std::move(told[rank]);
      }
    }
    comm_.together(kPreparation, [&] { all_.cornerWinding = maker_.join(whole_, own.setOf, all); });
  }

  void uniteTriangles() {
    const PartCounts& counts = maker_.partCounts();
    const auto unite = [&](PartKind kind, std::vector<uint8_t>& flags) {
      comm_.together(kPreparation, [&] { flags = maker_.trianglesOf(kind); });
      comm_.uniteFlags(flags);
    };
    if (counts.parity > 0) unite(PartKind::parity, all_.inParity);
    if (counts.open > 0) unite(PartKind::open, all_.inOpen);
  }

  void uniteCrossings() {
    CrossingCounts& crossings = all_.crossings;
    comm_.together(kPreparation, [&] { crossings = maker_.crossings(); });
    comm_.reduce(crossings.counts, MPI_MAX);
    std::vector<std::array<uint32_t, 2>> many;
    for (const std::vector<uint32_t>& told : comm_.gatherAll(crossings.many)) {
      for (size_t i = 0; i < told.size(); i += 2) many.push_back({told[i], told[i + 1]});
    }
    sortUnique(many);
    crossings.many.clear();
    for (const auto& [vertex, count] : many) crossings.many.insert(crossings.many.end(), {vertex, count});
  }

  Communicator& comm_;
  const SlicedMeshData& mesh_;
  ShareInputMaker maker_;
  const Scale scale_;
  BandFindings whole_;
  SharedFindings all_;
};

}  // namespace

std::unique_ptr<ShareInput> prepareShares(Communicator& comm, const SlicedMeshData& mesh, const Grid& grid, const PrepareOptions& options,
                                          MeshInfo* info) {
  if (!mesh.isFit || options.orient) return nullptr;
  const double largest = largestCoordinate(comm, mesh);
  if (!std::isfinite(largest)) return nullptr;
  const int shift = largest > 0 ? Scale::kLargestExponent - std::ilogb(largest) : 0;
  const MeshFacts facts{mesh.vertices(), mesh.triangles(), fingerprintOf(comm, mesh), shift};
  return SharesPreparer(comm, mesh, facts, grid, options).run(info);
}

}  // namespace mandoline::detail
