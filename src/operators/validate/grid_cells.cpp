// The pass that works by grid cell.
#include <optional>

#include "base/sort.h"
#include "operators/validate/grid_cell_checks.h"

namespace mandoline::validation {
namespace {

/// All checks of a range of grid cells.
struct Checks {
  explicit Checks(const Context& context_) : context(context_), cell(context), lines(context) {}

  void run(size_t group, std::vector<double>& cellVolumes) {
    cell.gather(group);
    const CellEdges& found = edges.run(cell);
    const std::vector<Edge>& withThoseBeyond = join(found.edges, context.edgesBeyond[group]);
    spots.start(cell);
    conforming.run(cell, withThoseBeyond, spots);
    crossings.run(cell, withThoseBeyond, spots);
    gridFaces.run(cell, withThoseBeyond);
    const std::vector<double> volumes = shells.run(cell, found.shell);
    for (size_t i = 0; i < volumes.size(); ++i) cellVolumes[cell.cells[i]] = volumes[i];
    lines.run(cell);
  }
  void merge(const Checks& next) {
    edges.merge(next.edges);
    conforming.merge(next.conforming);
    crossings.merge(next.crossings);
    gridFaces.merge(next.gridFaces);
    shells.merge(next.shells);
    lines.merge(next.lines);
  }

  /// Both, ascending and without repeats.
  const std::vector<Edge>& join(const std::vector<Edge>& own, std::span<const Edge> beyond) {
    joined = own;
    joined.insert(joined.end(), beyond.begin(), beyond.end());
    detail::sortUnique(joined);
    return joined;
  }

  const Context& context;
  GridCell cell;
  std::vector<Edge> joined;
  CellSpots spots;
  EdgeCheck edges;
  ConformingCheck conforming;
  CrossingCheck crossings;
  GridFaceCheck gridFaces;
  ShellCheck shells;
  LineCheck lines;
};

}  // namespace

GridCellChecks checkGridCells(const Context& context, detail::Monitor& monitor) {
  std::vector<double> cellVolumes(context.cut.cellCount(), 0);
  const auto work = [&](std::optional<Checks>& checks, size_t begin, size_t end) {
    if (!checks) checks.emplace(context);
    for (size_t group = begin; group < end; ++group) checks->run(group, cellVolumes);
  };
  constexpr size_t kBlock = 64;  // grid cells
  const auto parts = detail::forChunks<std::optional<Checks>>(context.groups.count(), monitor, work, kBlock);
  Checks all(context);
  for (const std::optional<Checks>& part : parts) {
    if (part) all.merge(*part);
  }
  return {all.edges.closedCells(),     all.edges.facingFaces(),   all.conforming.conforming(), all.crossings.crossings(),
          all.gridFaces.divided(),     all.shells.connected(),    all.shells.distinctCells(),  all.shells.cellVolume(),
          all.shells.gridCellVolume(), all.shells.gridFaceArea(), all.lines.partition(),       std::move(cellVolumes),
          all.lines.samples()};
}

}  // namespace mandoline::validation
