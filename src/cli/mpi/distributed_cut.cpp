#include "cli/mpi/distributed_cut.h"

#include "cli/commands.h"
#include "cli/cut_command.h"
#include "cli/cutting.h"
#include "cli/files.h"
#include "cli/mpi/case_files.h"
#include "cli/mpi/check_distributed.h"
#include "cli/mpi/mcm_folder.h"
#include "cli/mpi/merging.h"
#include "cli/mpi/piece_files.h"
#include "cli/peak_memory.h"
#include "cut/stages/input.h"
#include "mandoline/distributed.h"
#include "mesh/inspect_arrays.h"
#include "mesh/read/load_file.h"
#include "mpi/sliced_mesh.h"

#ifdef MANDOLINE_HAVE_PETSC
#include "cli/mpi/distributed_flow.h"
#endif

namespace mandoline::cli {
namespace {

class Run {
 public:
  Run(Ranks& ranks, const Arguments& arguments) : ranks_(ranks), arguments_(arguments) {}

  int run() {
    read();
    if (const Error error = cut(); error.status != Status::ok) return fail(error);
    if (arguments_.command == Command::flow) return ranks_.comm().reduce(finishFlow(), MPI_MAX);
    cellOutputs_ = std::count_if(arguments_.outputs.begin(), arguments_.outputs.end(), [&](const std::string& output) {
      return isPolyMesh(output) || (isPvtu(output) && needsComplex(arguments_));
    });
    const RankPiece piece = !needsPiece() ? RankPiece() : needsWhole(arguments_) ? cut_->piece() : cut_->takePiece();
    for (const std::string& output : arguments_.outputs) {
      if (isPvtu(output)) writePiece(output, piece);
      if (isPolyMesh(output)) writeCase(output, piece);
      if (isMcmFolder(output)) writeMcmFolder(ranks_, output, piece, writingOptions());
    }
    const int exitCode = needsWhole(arguments_) ? finishWhole() : finishReduced(piece);
    return ranks_.comm().reduce(exitCode, MPI_MAX);
  }

 private:
  bool needsPiece() const {
    return !needsWhole(arguments_) || std::any_of(arguments_.outputs.begin(), arguments_.outputs.end(), isInPieces);
  }

  /// Each process reads a file that it can read quickly, its slice if that can be found; the first one others, as it does where it needs
  /// the whole.
  void read() {
    const bool inSlices = ranks_.size() > 1 && readSlice();
    isReadByAll_ = inSlices || ranks_.comm().reduce(int(detail::isBinaryMesh(arguments_.mesh)), MPI_MIN) != 0;
    ranks_.together([&] {
      if (inSlices ? !needsMesh() : !ranks_.isFirst() && !isReadByAll_) return;
      Arguments arguments = arguments_;
      if (!ranks_.isFirst()) arguments.report.clear();  // the first one says what is wrong
      input_ = readInput(arguments);
    });
    if (inSlices) makeSlices();
    input_.name = nameOf(arguments_.mesh);
    ranks_.inFirst([&] {
      const bool isFlow = arguments_.command == Command::flow;
      const Mesh likeIt = input_.mesh.triangles.empty() ? meshWithBox() : Mesh();
      grid_ = makeGrid(isFlow ? flowGrid(arguments_.grid) : arguments_.grid, input_.mesh.triangles.empty() ? likeIt : input_.mesh);
    });
  }

  /// Whether the first process needs the mesh for what it writes or finds.
  bool needsMesh() const { return ranks_.isFirst() && (arguments_.command == Command::flow || needsWhole(arguments_)); }

  /// False, alike in all processes, if it can't be found.
  bool readSlice() {
    std::optional<detail::FileSlice> slice;
    ranks_.together([&] {
      if (!arguments_.orient) slice = detail::readMeshSlice(arguments_.mesh, {uint32_t(ranks_.rank()), uint32_t(ranks_.size())});
    });
    if (ranks_.comm().reduce(int(slice.has_value()), MPI_MIN) == 0) return false;
    slice_ = std::move(slice->mesh);
    sample_ = slice->sample;
    const bool areSame = ranks_.comm().reduce(sample_, MPI_MIN) == ranks_.comm().reduce(sample_, MPI_MAX);  // else cut() says so
    if (areSame && readsFileInAll(size_t(ranks_.size()))) whole_ = std::move(slice->whole);
    return true;
  }

  void makeSlices() {
    slices_.emplace(MPI_COMM_WORLD, std::exchange(slice_, {}), std::move(whole_));
    const MeshBox box = slices_->box();
    info_.min = box.min;
    info_.max = box.max;
    info_.vertices = slices_->vertexCount();
    info_.triangles = slices_->triangleCount();
  }

  /// That of the slices.
  Mesh meshWithBox() const {
    Mesh mesh;
    if (info_.triangles == 0) return mesh;
    for (const auto& corner : {info_.min, info_.max}) mesh.positions.insert(mesh.positions.end(), corner.begin(), corner.end());
    mesh.triangles = {0, 1, 1};
    return mesh;
  }

  /// The first process sends the grid to the others, and their slices if need be.
  void send() {
    detail::Communicator& comm = ranks_.comm();
    if (!slices_ && ranks_.size() > 1 && !isReadByAll_) sendSlices();
    Grid& grid = grid_.grid;
    for (std::vector<double>& planes : grid.planes) comm.broadcast(planes, 0);
    std::vector<double> uniform = {double(grid.uniform)};
    uniform.insert(uniform.end(), grid.origin.begin(), grid.origin.end());
    uniform.insert(uniform.end(), grid.spacing.begin(), grid.spacing.end());
    comm.broadcast(uniform, 0);
    grid.uniform = uniform[0] != 0;
    std::copy_n(uniform.begin() + 1, 3, grid.origin.begin());
    std::copy_n(uniform.begin() + 4, 3, grid.spacing.begin());
  }

  /// From the first process, which keeps the mesh if it needs it.
  void sendSlices() {
    detail::Communicator& comm = ranks_.comm();
    std::vector<std::vector<double>> positions(size_t(ranks_.size()));
    std::vector<std::vector<uint32_t>> triangles(positions.size());
    ranks_.inFirst([&] {
      for (uint32_t rank = 0; rank < positions.size(); ++rank) {
        Mesh slice = detail::sliceOf(input_.mesh, {rank, uint32_t(positions.size())});
        positions[rank] = std::move(slice.positions);
        triangles[rank] = std::move(slice.triangles);
      }
      if (!needsMesh()) input_.mesh = {};
    });
    positions = comm.exchangeAll(positions);
    triangles = comm.exchangeAll(triangles);
    slice_ = {std::move(positions[0]), std::move(triangles[0])};
    makeSlices();
  }

  /// Gives the error, alike in all processes.
  Error cut() {
    const RunOptions options{arguments_.threads, [this](const Progress& progress) { return bar_.update(progress); }};
    try {
      ranks_.comm().requireSame(sample_, "mesh");
      ranks_.comm().together("cut", [this] {
        if (ranks_.isFirst()) detail::checkGrid(grid_.grid, 0);
      });
      send();
      const PrepareOptions preparing{options, arguments_.intersections};
      if (slices_) {
        SlicedMesh slices = *std::move(slices_);
        slices_.reset();
        cut_.emplace(MPI_COMM_WORLD, std::move(slices), grid_.grid, preparing, &info_);
      } else {
        cut_.emplace(MPI_COMM_WORLD, takeMesh(), grid_.grid, preparing, &info_);
      }
    } catch (const RankError& error) {
      throwIfInterrupted();
      failed_ = error.rank;
      return error.error;
    } catch (const CallError& error) {
      throwIfInterrupted();
      throw;
    }
    throwIfInterrupted();
    return {};
  }

  /// The mesh for the cut, which frees it on the way. It stays where the whole is written, or what is inside is to be found.
  std::shared_ptr<const Mesh> takeMesh() {
    if (needsMesh()) return std::shared_ptr<const Mesh>(std::shared_ptr<void>(), &input_.mesh);  // which outlives the cut
    if (ranks_.isFirst()) info_ = detail::inspectArrays(input_.mesh);
    return std::make_shared<const Mesh>(std::exchange(input_.mesh, {}));
  }

  /// The mesh may be gone: the cut has inspected it first, unless the processes have different ones.
  int fail(const Error& error) {
    if (ranks_.isFirst()) {
      CutResult result;
      result.error = withSize(error, arguments_, grid_);
      const MeshReport mesh{input_, input_.mesh.triangles.empty() ? info_ : inspect(input_.mesh), {}};
      failWith(arguments_, "rank " + std::to_string(failed_) + ": " + input_.name, result.error,
               [&] { return reportJson(reportOf(arguments_, mesh, grid_, result)); });
    }
    return kNotCut;
  }

  void writePiece(const std::string& output, const RankPiece& piece) {
    if (arguments_.uniteWalls) sendGroups();
    WriteOptions options;
    ranks_.together([&] {
      options = writeOptions(arguments_, cut_->common());
      static_cast<RunOptions&>(options) = writingOptions();
    });
    if (!needsComplex(arguments_)) return writePvtu(ranks_, output, *cut_, piece, options);
    makeCells(piece);
    writePvtu(ranks_, output, *cells_, options);
    if (--cellOutputs_ == 0) cells_.reset();
  }

  void writeCase(const std::string& output, const RankPiece& piece) {
    sendGroups();
    WriteOptions options;
    static_cast<RunOptions&>(options) = writingOptions();
    options.simpleCells = arguments_.simpleCells;
    options.groups = &input_.groups;
    if (arguments_.only.all) ranks_.together([&] { options.regions.assign(cut_->common().mesh.regionCount, 1); });
    CaseFiles files(ranks_, output);  // refuses before there are cells
    makeCells(piece);
    const bool isLast = --cellOutputs_ == 0;
    RankComplex cells;
    ranks_.together([&] { cells = isLast ? std::move(*cells_) : *cells_; });
    if (isLast) cells_.reset();
    files.write(std::move(cells), options);
  }

  /// Once for all outputs: as makeCells() of the whole, with the ghosts that what is written of own cells follows from. Takes the groups of
  /// triangles.
  void makeCells(const RankPiece& piece) {
    constexpr int kRings = 1;
    if (cells_) return;
    std::optional<Merging> merging;  // which takes memory
    ranks_.together([&] { merging.emplace(arguments_, input_.groups, RunOptions{arguments_.threads, {}}); });
    cells_ = detail::mergedComplex(ranks_.comm(), *cut_, piece, merging->with(kRings), &merged_);
  }

  /// The first process sends the groups of triangles to the others.
  void sendGroups() {
    detail::Communicator& comm = ranks_.comm();
    std::vector<char> names;  // each ends with a zero
    for (const std::string& name : input_.groups.names) names.insert(names.end(), name.c_str(), name.c_str() + name.size() + 1);
    comm.broadcast(names, 0);
    comm.broadcast(input_.groups.triangleGroup, 0);
    input_.groups.names.clear();
    for (auto at = names.begin(); at != names.end();) {
      const auto end = std::find(at, names.end(), '\0');
      input_.groups.names.emplace_back(at, end);
      at = end + 1;
    }
  }

  RunOptions writingOptions() {
    return {arguments_.threads, [this](const Progress& progress) { return bar_.update(progress); }};
  }

  /// What all processes tell of themselves.
  std::vector<RankReport> ranks() {
    detail::Communicator& comm = ranks_.comm();
    const std::vector<uint64_t> cells = comm.gatherAll(cut_->ownCells()), memory = comm.gatherAll(peakMemoryBytes()),
                                sent = comm.gatherAll(comm.bytesSent() + cut_->bytesSent()),
                                microseconds = comm.gatherAll(uint64_t(1000 * processorMs()));
    std::vector<RankReport> reports;
    for (size_t rank = 0; rank < cells.size(); ++rank)
      reports.push_back({cells[rank], memory[rank], sent[rank], double(microseconds[rank]) / 1000});
    return reports;
  }

  /// Stages of the preparation come before those of the cut.
  CutStats withPreparation(CutStats stats) const {
    const CutStats& before = cut_->preparation();
    stats.stages.insert(stats.stages.begin(), before.stages.begin(), before.stages.end());
    stats.totalMs += before.totalMs;
    return stats;
  }

  int finishWhole() {
    CutResult whole = cut_->gather();
    const std::vector<RankReport> reports = ranks();
    int exitCode = kFine;
    ranks_.inFirst([&] {
      whole.stats = withPreparation(whole.stats);
      if (needsInside(arguments_)) findInside(arguments_, input_.mesh, whole.mesh);
      const Arguments arguments = ofWhole(arguments_);
      exitCode = finishCut({arguments, input_, info_, grid_}, whole, reports);
    });
    return exitCode;
  }

#ifdef MANDOLINE_HAVE_PETSC
  /// The first process gathers the whole cut, and phi.
  int finishFlow() {
    if (arguments_.uniteWalls) sendGroups();
    const SolveCells solve = solveDistributed(ranks_, arguments_, *cut_, input_.groups);
    CutResult whole = cut_->gather();
    const std::vector<RankReport> reports = ranks();
    int exitCode = kFine;
    ranks_.inFirst([&] {
      if (needsInside(arguments_)) findInside(arguments_, input_.mesh, whole.mesh);
      exitCode = cli::finishFlow({arguments_, input_, whole}, solve, reports);
    });
    return exitCode;
  }
#else
  int finishFlow() { return kNotCut; }  // checkDistributed() has refused it
#endif

  int finishReduced(const RankPiece& piece) {
    std::vector<double> volumes = cut_->regionVolumes(piece);
    CutResult result = cut_->common();
    result.stats = withPreparation(result.stats);
    const std::vector<RankReport> reports = ranks();
    ranks_.inFirst([&] {
      Report report = reportOf(arguments_, {input_, info_, {}}, grid_, result);
      report.counts = cut_->counts();
      report.regionVolumes = std::move(volumes);
      if (mergeFraction(arguments_) > 0) report.merge = MergeCounts{merged_.before, merged_.after, merged_.pockets};
      report.ranks = reports;
      deliver(
          arguments_, [&] { return reportText(report); }, [&] { return reportJson(report); });
    });
    return kFine;
  }

  Ranks& ranks_;
  const Arguments& arguments_;
  ProgressBar bar_;
  Input input_;  // of others than the first the name and at most the mesh
  bool isReadByAll_ = false;
  Mesh slice_;                                       // until it is one of slices_
  std::shared_ptr<const detail::MeshSource> whole_;  // likewise, if each process reads what it needs of the file
  uint64_t sample_ = 0;                              // of the file that it is read from
  std::optional<SlicedMesh> slices_;                 // in the place of the mesh, until it is cut
  MeshInfo info_;
  AskedGrid grid_;
  int failed_ = 0;
  detail::MergedCounts merged_;
  std::optional<RankComplex> cells_;  // until the last output that needs them has them
  ptrdiff_t cellOutputs_ = 0;         // that still need them
  std::optional<DistributedCut> cut_;
};

}  // namespace

int runDistributedCut(Ranks& ranks, const Arguments& arguments) {
  ranks.together([&] { checkDistributed(arguments); });
  return Run(ranks, arguments).run();
}

}  // namespace mandoline::cli
