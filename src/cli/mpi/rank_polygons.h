// What several processes tell each other of polygons.
#pragma once

#include "io/polygon_sharing.h"
#include "mandoline/distributed.h"
#include "mpi/communicator.h"

namespace mandoline::cli {

/// Of a face the process of the first of its cells tells. Throws RankError.
class RankPolygons final : public detail::PolygonSharing {
 public:
  /// Keeps references; adds vertices that others name.
  RankPolygons(detail::Communicator& comm, RankComplex& complex);

  uint64_t vertexId(uint32_t vertex) const override { return complex_.vertexIds[vertex]; }
  uint64_t faceId(uint32_t face) const override { return complex_.faceIds[face]; }
  bool tellsOf(uint32_t face) const override;
  std::optional<uint32_t> vertexOf(uint64_t id) const override;
  uint32_t addVertex(uint64_t id, const std::array<double, 3>& position) override;
  void together(detail::FunctionRef<void()> work) override { comm_.together(kNoun, work); }
  double largest(double here) override { return comm_.reduce(here, MPI_MAX); }
  void gather(std::vector<detail::KnownPolygon>& polygons) override;

 private:
  static constexpr const char* kNoun = "writing";
  using Named = std::pair<uint64_t, uint32_t>;  // an id, and the vertex that has it

  detail::Communicator& comm_;
  RankComplex& complex_;
  std::vector<Named> vertices_;  // ascending
};

}  // namespace mandoline::cli
