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

  /// `whole`: what this process can read of it; null in all if they tell each other.
  std::unique_ptr<ShareInput> run(const MeshSource* whole, MeshInfo* info) {
    std::vector<uint64_t> work;
    if (!allGoOn([&] { return maker_.begin(mesh_.part, work); })) return nullptr;
    comm_.reduce(work, MPI_SUM);
    comm_.together(kPreparation, [&] { maker_.makeBands(work); });
    BandTriangles triangles = whole ? read(*whole) : gather();
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
    std::optional<MeshInfo> found;  // which takes memory
    comm_.together(kPreparation, [&] { found.emplace(); });
    const bool isPlain = whole_.edges.haveAtMostTwo;
    std::shared_ptr<const Mesh> mesh;
    if (isPlain)
      inspectArrays(comm_, mesh_, maker_.surface(), *found);
    else
      mesh = gathered(comm_, mesh_, false);
    comm_.together(kPreparation, [&] {
      if (comm_.rank() == 0) info = isPlain ? inspectPlain(std::move(*found), whole_, maker_.partCounts()) : inspect(*mesh);
    });
  }

  /// Parts for others, and those that come from them and what is here already, if anything is, as one.
  MeshPart exchange(const std::vector<MeshPart>& parts, const MeshPart* own) {
    std::vector<Communicator::Bytes> bytes;
    comm_.together(kPreparation, [&] {
      bytes.resize(size_t(comm_.size()));
      for (size_t rank = 0; rank < parts.size(); ++rank) {
        if (!parts[rank].triangles.empty()) bytes[rank] = packed(parts[rank]);
      }
    });
    bytes = comm_.exchangeAll(bytes);
    MeshPart all;
    comm_.together(kPreparation, [&] {
      std::vector<MeshPart> told;
      if (own) told.push_back(*own);
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
  BandTriangles read(const MeshSource& whole) {
    BandTriangles triangles;
    comm_.together(kPreparation, [&] { triangles = readBand(whole, scale_, maker_.band()); });
    return triangles;
  }

  /// The same, told by others.
  BandTriangles gather() {
    const size_t count = size_t(comm_.size());
    std::vector<MeshPart> parts;
    comm_.together(kPreparation, [&] { parts = trianglesOfBands(mesh_.part, heightsOf(mesh_.part, scale_), BandFinder(maker_.bands())); });
    const MeshPart within = exchange(parts, nullptr);
    std::vector<uint8_t> isFar;  // per vertex
    comm_.together(kPreparation, [&] { isFar.assign(within.vertices.size(), 1); });
    Positions told = comm_.exchangeAll(ask(within, isFar));
    comm_.together(kPreparation, [&] {
      const std::vector<double> heights = heightsOf(within, scale_);
      for (size_t rank = 0; rank < count; ++rank) parts[rank] = trianglesAt(told[rank], within, heights, maker_.bands()[rank]);
    });
    BandTriangles triangles;
    triangles.part = exchange(parts, &within);
    comm_.together(kPreparation, [&] {
      isFar.clear();
      const std::vector<uint32_t>& ids = within.triangles;
      for (const uint32_t t : triangles.part.triangles) triangles.isWithin.push_back(std::binary_search(ids.begin(), ids.end(), t));
      findLowest(triangles);
      for (const uint8_t flag : triangles.isComplete) isFar.push_back(!flag);
    });
    const Positions asked = ask(triangles.part, isFar);
    told = comm_.exchangeAll(asked);
    std::vector<std::vector<uint32_t>> lowest;
    comm_.together(kPreparation, [&] {
      lowest.resize(count);
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
    std::array<int, 3> flags = {edges.closed, edges.oriented, edges.haveAtMostTwo};
    comm_.reduce(std::span<int>(flags), MPI_MIN);
    std::array<uint64_t, 3> counts = {edges.open, edges.inconsistent, whole_.weldedVertices};
    comm_.reduce(std::span<uint64_t>(counts), MPI_SUM);
    edges = {flags[0] != 0, flags[1] != 0, flags[2] != 0, counts[0], counts[1]};
    whole_.weldedVertices = counts[2];
    return edges.closed || edges.haveAtMostTwo;
  }

  void joinParts(bool areCounted) {
    BandParts own;
    std::vector<BandParts> all;
    comm_.together(kPreparation, [&] { all.resize(size_t(comm_.size())); });
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
    const std::vector<std::vector<uint32_t>> all = comm_.gatherAll(crossings.many);
    comm_.together(kPreparation, [&] {
      std::vector<std::array<uint32_t, 2>> many;
      for (const std::vector<uint32_t>& told : all) {
        for (size_t i = 0; i < told.size(); i += 2) many.push_back({told[i], told[i + 1]});
      }
      sortUnique(many);
      crossings.many.clear();
      for (const auto& [vertex, count] : many) crossings.many.insert(crossings.many.end(), {vertex, count});
    });
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
  const MeshSums sums = sumsOf(comm, mesh);
  const MeshFacts facts{mesh.vertices(), mesh.triangles(), sums.whole, shift};
  std::optional<CheckedSource> whole;
  if (mesh.whole) whole.emplace(*mesh.whole, sums);
  std::optional<SharesPreparer> preparer;
  comm.together(kPreparation, [&] { preparer.emplace(comm, mesh, facts, grid, options); });
  return preparer->run(whole ? &*whole : nullptr, info);
}

}  // namespace mandoline::detail
