// A decomposed case of OpenFOAM: a polyMesh of each process, which fit together.
#pragma once

#include "cli/interrupt.h"
#include "cli/mpi/ranks.h"
#include "io/poly_mesh.h"
#include "mandoline/distributed.h"

namespace mandoline::cli {

/// Throws UsageError unless the path of a polyMesh is CASE/constant/polyMesh.
void checkCase(const std::string& path);

/// The files CASE/processorN/constant/polyMesh, as decomposePar writes them. They go unless all are written.
class CaseFiles {
 public:
  /// `path` is one that checkCase() takes. Collective. Throws Stopped where there is a case in more parts.
  CaseFiles(Ranks& ranks, const std::string& path);
  ~CaseFiles();
  CaseFiles(const CaseFiles&) = delete;

  /// Writes the cells of this process, of mergedComplex() with a ring of ghosts; untouched of the options is not read.
  /// Collective. Throws Stopped, and RankError.
  void write(RankComplex complex, WriteOptions options);

 private:
  std::string folderOf(int rank) const;
  void refuseOthers() const;
  void chooseRegions(const RankComplex& complex, WriteOptions& options) const;
  void addSeams(const RankComplex& complex, detail::PolyMesh& mesh) const;
  void addZones(const RankComplex& complex, detail::PolyMesh& mesh) const;

  const DeferInterrupts defer_;  // which would leave files
  Ranks& ranks_;
  const std::string case_;
  bool isComplete_ = false;
};

}  // namespace mandoline::cli
