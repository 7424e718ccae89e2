#include "mpi/prepare_shares.h"

#include "base/sort.h"

namespace mandoline::detail {
namespace {

constexpr const char* kPreparation = "preparation";

class SharesPreparer {
 public:
  SharesPreparer(Communicator& comm, const std::shared_ptr<const Mesh>& mesh, const Grid& grid, const PrepareOptions& options,
                 MeshInfo* info)
      : comm_(comm), mesh_(*mesh), info_(info), maker_(mesh, grid, {uint32_t(comm.rank()), uint32_t(comm.size())}, options) {}

  std::unique_ptr<ShareInput> run() {
    std::vector<uint64_t> work;
    if (!allGoOn([&] { return maker_.begin(work); })) return nullptr;
    comm_.reduce(work, MPI_SUM);
    if (!allGoOn([&] { return maker_.prepare(work); }) || !findWhole()) return nullptr;
    joinParts();
    comm_.reduce(all_.cornerWinding, MPI_SUM);
    uniteTriangles();
    uniteCrossings();
    std::unique_ptr<ShareInput> input;
    comm_.together(kPreparation, [&] {
      if (info_ && comm_.rank() == 0)
        *info_ = whole_.edges.haveAtMostTwo ? inspectPlain(mesh_, whole_, maker_.partCounts()) : inspect(mesh_);
      input = maker_.take(all_);
    });
    return input;
  }

 private:
  template <class Body>
  bool allGoOn(const Body& body) {
    bool goesOn = false;
    comm_.together(kPreparation, [&] { goesOn = body(); });
    return comm_.reduce(int(goesOn), MPI_MIN) != 0;
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

  void joinParts() {
    BandParts own;
    std::vector<BandParts> all(size_t(comm_.size()));
    if (!whole_.edges.closed || info_) {
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
  const Mesh& mesh_;
  MeshInfo* const info_;
  ShareInputMaker maker_;
  BandFindings whole_;
  SharedFindings all_;
};

}  // namespace

std::unique_ptr<ShareInput> prepareShares(Communicator& comm, const std::shared_ptr<const Mesh>& mesh, const Grid& grid,
                                          const PrepareOptions& options, MeshInfo* info) {
  return SharesPreparer(comm, mesh, grid, options, info).run();
}

}  // namespace mandoline::detail
