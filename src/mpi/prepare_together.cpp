// Preparing a mesh in all processes of a communicator: what each of them finds of where triangles meet, all learn.
#include "cut/driver.h"
#include "mandoline/distributed.h"
#include "mandoline/prepare_share.h"
#include "mpi/communicator.h"

namespace mandoline {

using namespace detail;

namespace {

template <class GivenMesh>
PreparedTogether prepareAll(MPI_Comm comm_, const GivenMesh& mesh, const PrepareOptions& options, const std::function<void()>& inFirst) {
  constexpr const char* kNoun = "preparation";
  Communicator comm(comm_, kNoun, options);
  PrepareResult result;
  if (comm.size() == 1) {
    comm.together(kNoun, [&] {
      if (inFirst) inFirst();
      result = prepareThis(mesh, options);
    });
    comm.agree(result.error);
    return {std::move(result.mesh), std::move(result.stats)};
  }
  const int searching = inFirst ? comm.size() - 1 : comm.size();  // from the last on
  const int share = comm.size() - 1 - comm.rank();
  std::optional<PrepareShare> preparing;
  std::vector<uint32_t> pairs;
  comm.together(kNoun, [&] {
    if (inFirst && comm.rank() == 0) inFirst();
    preparing.emplace(ShareOf{uint32_t(share), uint32_t(searching)}, options);
    pairs = preparing->findPairs(mesh);
  });
  comm.requireSame(preparing->fingerprint().value, "mesh");
  const std::vector<std::vector<uint32_t>> all = comm.gatherAll(pairs);
  comm.together(kNoun, [&] {
    preparing->findEdges();
    pairs.clear();
    for (const std::vector<uint32_t>& some : all) pairs.insert(pairs.end(), some.begin(), some.end());
    result = preparing->resolve(pairs);
  });
  return {std::move(result.mesh), std::move(result.stats), comm.bytesSent()};
}

}  // namespace

PreparedTogether prepareTogether(MPI_Comm comm, const MeshView& mesh, const PrepareOptions& options, const std::function<void()>& inFirst) {
  return prepareAll(comm, mesh, options, inFirst);
}
PreparedTogether prepareTogether(MPI_Comm comm, std::shared_ptr<const Mesh> mesh, const PrepareOptions& options,
                                 const std::function<void()>& inFirst) {
  return prepareAll(comm, std::move(mesh), options, inFirst);
}

}  // namespace mandoline
