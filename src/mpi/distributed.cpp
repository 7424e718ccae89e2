// A cut by all processes of a communicator: their shares agree by summaries, and number by sums over the ranks before what they have.
#include "mandoline/distributed.h"

#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "cut/append.h"
#include "cut/driver.h"
#include "cut/share_excerpt.h"
#include "mesh/fingerprints.h"
#include "mesh/run_call.h"
#include "mpi/communicator.h"
#include "mpi/gather_made.h"
#include "mpi/make_rank_complex.h"
#include "mpi/pack.h"
#include "mpi/prepare_shares.h"
#include "mpi/rank_piece.h"
#include "mpi/sliced_mesh.h"
#include "operators/measure/measure_part.h"
#include "operators/measure/region_sums.h"

namespace mandoline {

using namespace detail;

constexpr const char* kNoun = "cut";

struct DistributedCut::Data {
  /// Nothing as yet.
  static std::shared_ptr<Data> begun(MPI_Comm comm, Grid grid, const RunOptions& options) {
    Communicator own(comm, kNoun, options);
    std::shared_ptr<Data> data;
    own.together(kNoun, [&] { data = std::make_shared<Data>(); });
    data->comm = std::move(own);
    data->grid = std::move(grid);
    return data;
  }

  void cutPrepared(PreparedMesh mesh_, const RunOptions& options) {
    takePrepared(std::move(mesh_), options);
    finish(options);
  }

  void cutMesh(std::shared_ptr<const Mesh> mesh_, const PrepareOptions& options, MeshInfo* info) {
    mesh = std::move(mesh_);
    requireSame();
    std::unique_ptr<ShareInput> input;
    if (comm.size() > 1) {
      std::shared_ptr<const Mesh> slice;
      std::shared_ptr<const MeshSource> whole;
      comm.together(kNoun, [&] {
        slice = std::make_shared<const Mesh>(sliceOf(*mesh, shareOf()));
        whole = std::make_shared<ArraySource>(mesh);
      });
      input = prepareShares(comm, *sliced(comm, std::move(slice), std::move(whole)), grid, options, info);
    }
    makeShare(std::move(input), options, info);
    finish(options);
  }

  void cutSlices(SlicedMesh slices, const PrepareOptions& options, MeshInfo* info) {
    sentPreparing = slices.data()->bytesSent;
    requireSame();
    triangles = slices.triangleCount();
    std::unique_ptr<ShareInput> input;
    if (comm.size() > 1) input = prepareShares(comm, *slices.data(), grid, options, info);
    if (!input) mesh = gathered(comm, *slices.data(), true);
    { const SlicedMesh freed = std::move(slices); }
    makeShare(std::move(input), options, info);
    finish(options);
  }

  /// Of what this process has prepared, or else of the mesh, which it has.
  void makeShare(std::unique_ptr<ShareInput> input, const PrepareOptions& options, MeshInfo* info) {
    if (input) {
      isPreparedInShares = true;
      preparation = std::move(input->preparation);
      surface = input->surface;
      triangles = input->triangles->count;
      mesh.reset();
      comm.together(kNoun, [&] { share.emplace(std::move(input), grid, shareOf(), options); });
    } else {
      const auto inspectMesh = [info, &whole = *mesh] { *info = inspect(whole); };
      PreparedTogether prepared = prepareTogether(comm.handle(), mesh, options, info ? std::function<void()>(inspectMesh) : nullptr);
      preparation = std::move(prepared.stats);
      sentPreparing += prepared.bytesSent;
      takePrepared(std::move(prepared.mesh), options);
    }
  }

  ShareOf shareOf() const { return {uint32_t(comm.rank()), uint32_t(comm.size())}; }

  void takePrepared(PreparedMesh prepared, const RunOptions& options) {
    if (prepared.data()) mesh = prepared.data()->mesh;
    requireSame();
    triangles = view().triangleCount();
    comm.together(kNoun, [&] { share.emplace(std::move(prepared), grid, shareOf(), options, takeExcerpt); });
  }

  void finish(const RunOptions& options) {
    std::vector<uint32_t> summary;
    comm.together(kNoun, [&] { summary = share->summary(); });
    const std::vector<std::vector<uint32_t>> summaries = comm.gatherAll(summary);
    summary = {};
    comm.together(kNoun, [&] {
      part = share->part(summaries, options);
      takeSurface();
    });
    number();
    findCommon();
  }

  /// Of another mesh the shares would be those of another cut.
  void requireSame() {
    comm.requireSame(fingerprintOf(view()).value, "mesh");
    Fingerprinter fingerprinter(kNoun);
    for (const std::vector<double>& planes : grid.planes) fingerprinter.add(planes);
    comm.requireSame(fingerprinter.get().value, "grid");
  }

  MeshView view() const { return mesh ? MeshView(*mesh) : MeshView({}, {}); }

  /// What there is of the mesh.
  NamedMesh named() const { return surface ? NamedMesh(*surface) : NamedMesh(view()); }

  /// Leaves of the mesh what measuring the part takes; one process alone needs all. Where the mesh is prepared in shares there is hardly
  /// more.
  void takeSurface() {
    if (comm.size() == 1 || surface) return;
    surface = std::make_shared<MeshPart>(measuring::partMeasuredBy(part.cutMesh, named()));
    mesh.reset();
  }

  /// Numbers what the part has by what the parts before have.
  void number() {
    const CutMesh& m = part.cutMesh;
    uint64_t surface = 0;
    for (const uint32_t v : part.firstVertices) surface = v == ~0u ? surface : std::max(surface, uint64_t(v) + 1);
    surface = comm.reduce(surface, MPI_MAX);
    uint64_t here[] = {part.triFaces, m.faceCount() - part.triFaces, m.vertexCount() - part.firstVertices.size(), m.cellCount(),
                       m.loopCount()};
    uint64_t before[5] = {}, all[5] = {};
    for (size_t i = 0; i < 5; ++i) {
      const std::vector<uint64_t> counts = comm.gatherAll(here[i]);
      for (size_t rank = 0; rank < counts.size(); ++rank) {
        if (rank < size_t(comm.rank())) before[i] += counts[rank];
        all[i] += counts[rank];
      }
    }
    numbers = {surface, surface + before[2], before[0], all[0] + before[1], before[3]};
    ownCells = m.cellCount();
    counts.vertices = surface + all[2];
    counts.faces = all[0] + all[1];
    counts.cutCells = all[3];
    counts.loops = all[4];
  }

  void findCommon() {
    std::vector<uint8_t> hasFace;
    comm.together(kNoun, [&] { hasFace = trianglesWithFace(part.cutMesh, triangles); });
    comm.uniteFlags(hasFace);
    comm.together(kNoun, [&] { common = share->common(hasFace); });
    gatherMade(comm, part.cutMesh, common);
    common.stats.exactFallbacks = comm.reduce(uint64_t(part.exactFallbacks), MPI_SUM);
    counts.regions = common.mesh.regionCount;
    counts.untouchedCells = UntouchedCells(common.mesh).count();
  }

  NumberedPart numberedPart() const {
    return {part, comm.rank(), numbers.surfaceVertices, numbers.firstVertex, numbers.firstTriFace, numbers.firstPiece, numbers.firstCell};
  }

  void requirePart() {
    comm.together(kNoun, [&] {
      if (isPartTaken) throw CallError({Status::badArgument, -1, -1, "This cut has given its piece away."});
    });
  }

  RankPiece takePiece() {
    RankPiece piece = makePiece();
    part = {};
    isPartTaken = true;
    giveBackFreed();
    return piece;
  }

  /// Ghosts come from the process whose layers lie below, and the seam is told to it.
  RankPiece makePiece() {
    requirePart();
    int below = -1, above = -1;
    std::tie(below, above) = neighbours();
    const NumberedPart numbered = numberedPart();
    Communicator::Bytes bytes;
    comm.together(kNoun, [&] {
      if (above < 0) return;
      PlaneFaces faces = facesInPlane(numbered, int32_t(share->layers()[1]));
      // Bands have the triangles between them in common.
      if (!isPreparedInShares) faces.surface = measuring::partMeasuredBy(faces.cutMesh, named());
      bytes = packed(faces);
    });
    bytes = comm.exchange(bytes, above, below);
    PieceFromBelow made;
    comm.together(kNoun, [&] {
      PlaneFaces faces = below >= 0 ? unpacked<PlaneFaces>(bytes) : PlaneFaces();
      made = detail::makePiece(numbered, common.mesh, share->layers(), faces);
      if (below >= 0 && !hasAll(*surface, faces.surface))
        surface = std::make_shared<MeshPart>(united(std::array{*surface, std::move(faces.surface)}));
    });
    comm.together(kNoun, [&] { bytes = packed(made.forBelow); });
    bytes = comm.exchange(bytes, below, above);
    comm.together(kNoun, [&] {
      if (above >= 0) addSeam(unpacked<CellsAbove>(bytes), made.piece);
    });
    return std::move(made.piece);
  }

  RankComplex makeComplex(const RankPiece& piece, int ghosts, const CoarsenOptions* coarsening) {
    std::optional<WholeCut> whole;  // which takes memory
    comm.together(kNoun, [&] { whole.emplace(WholeCut{named(), common.mesh, counts}); });
    return makeRankComplex(comm, *whole, piece, ghosts, coarsening);
  }

  /// The processes with the next layers below and above; -1 for none.
  std::pair<int, int> neighbours() {
    const auto [first, past] = share->layers();
    const std::vector<uint64_t> counts = comm.gatherAll(uint64_t(past - first));
    if (first == past) return {-1, -1};
    int below = comm.rank() - 1, above = comm.rank() + 1;
    while (below >= 0 && counts[size_t(below)] == 0) --below;
    while (above < comm.size() && counts[size_t(above)] == 0) ++above;
    return {below, above < comm.size() ? above : -1};
  }

  Measures measures(const RankPiece& piece, const RunOptions& options) const {
    return measuring::measureBy(named(), piece.cutMesh, options);
  }

  std::vector<double> regionVolumes(const RankPiece& piece) {
    constexpr const char* kMeasuring = "measuring";
    Measures measured;
    std::vector<DoubleDouble> sums;
    std::vector<double> volumes;
    comm.together(kMeasuring, [&] {
      measured = measures(piece, {1, {}});
      sums.resize(common.mesh.regionCount);
      volumes.reserve(sums.size());
    });
    comm.addInOrder(kMeasuring, std::span(sums), [&] { addCutCells(piece.cutMesh, measured, sums); });
    comm.addInOrder(kMeasuring, std::span(sums), [&] { addUntouchedCells(piece.cutMesh, sums); });
    for (const DoubleDouble& sum : sums) volumes.push_back(double(sum));
    return volumes;
  }

  CutResult gather() {
    requirePart();
    CutResult result;
    std::vector<CutPart> parts;
    for (int rank = 1; rank < comm.size(); ++rank) {
      Communicator::Bytes bytes;
      comm.together(kNoun, [&] {
        if (comm.rank() == rank) bytes = packed(part);
      });
      bytes = comm.exchange(bytes, comm.rank() == rank ? 0 : -1, comm.rank() == 0 ? rank : -1);
      comm.together(kNoun, [&] {
        if (comm.rank() == 0) parts.push_back(unpacked<CutPart>(bytes));
      });
    }
    comm.together(kNoun, [&] {
      if (comm.rank() > 0) return;
      parts.insert(parts.begin(), std::move(part));
      result = share->join(std::move(parts));
    });
    comm.agree(result.error);
    return result;
  }

  struct Numbers {
    uint64_t surfaceVertices, firstVertex, firstTriFace, firstPiece, firstCell;
  };

  Communicator comm;
  std::shared_ptr<const Mesh> mesh;         // until it is cut
  std::shared_ptr<const MeshPart> surface;  // what is known of it from then on
  Grid grid;
  std::optional<CutShare> share;
  size_t triangles = 0;  // of the whole mesh
  CutPart part;
  Numbers numbers{};
  CutCounts counts;
  uint64_t ownCells = 0, sentPreparing = 0;
  CutStats preparation;
  bool isPreparedInShares = false, isPartTaken = false;
  CutResult common;
};

DistributedCut::DistributedCut(MPI_Comm comm, PreparedMesh mesh, Grid grid, const RunOptions& options)
    : data_(Data::begun(comm, std::move(grid), options)) {
  data_->cutPrepared(std::move(mesh), options);
}
DistributedCut::DistributedCut(MPI_Comm comm, std::shared_ptr<const Mesh> mesh, Grid grid, const PrepareOptions& options, MeshInfo* info)
    : data_(Data::begun(comm, std::move(grid), options)) {
  data_->cutMesh(std::move(mesh), options, info);
}
DistributedCut::DistributedCut(MPI_Comm comm, SlicedMesh mesh, Grid grid, const PrepareOptions& options, MeshInfo* info)
    : data_(Data::begun(comm, std::move(grid), options)) {
  data_->cutSlices(std::move(mesh), options, info);
}

RankPiece DistributedCut::piece() const { return data_->makePiece(); }
RankComplex DistributedCut::cellComplex(const RankPiece& piece, int ghostLayers) const {
  return data_->makeComplex(piece, ghostLayers, nullptr);
}
RankComplex DistributedCut::cellComplex(const RankPiece& piece, int ghostRings, const CoarsenOptions& coarsening) const {
  return data_->makeComplex(piece, ghostRings, &coarsening);
}
CutCounts DistributedCut::counts() const { return data_->counts; }
uint64_t DistributedCut::ownCells() const { return data_->ownCells; }
Measures DistributedCut::measures(const RankPiece& piece, const RunOptions& options) const { return data_->measures(piece, options); }
std::vector<double> DistributedCut::regionVolumes(const RankPiece& piece) const { return data_->regionVolumes(piece); }
const CutResult& DistributedCut::common() const { return data_->common; }
RankPiece DistributedCut::takePiece() { return data_->takePiece(); }
CutResult DistributedCut::gather() { return data_->gather(); }
const CutStats& DistributedCut::preparation() const { return data_->preparation; }
bool DistributedCut::isPreparedInShares() const { return data_->isPreparedInShares; }
uint64_t DistributedCut::bytesSent() const { return data_->comm.bytesSent() + data_->sentPreparing; }

}  // namespace mandoline
