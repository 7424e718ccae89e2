// Piecewise constant winding number and input volume, where the input has winding numbers.
#include <algorithm>

#include "operators/validate/passes.h"

namespace mandoline::validation {
namespace {

/// Points in untouched grid cells.
std::vector<Sample> sampleUntouched(const Context& context) {
  constexpr size_t kSamples = 200;
  std::vector<Sample> samples;
  Random random(2);
  const CutMesh& cut = context.cut;
  const size_t ny = size_t(cut.grid.cells(1));
  for (size_t i = 0; i < kSamples && !cut.runBegin.empty(); ++i) {
    const size_t run = size_t(random.next() % cut.runBegin.size());
    const size_t row =
        size_t(std::upper_bound(cut.rowRunOffsets.begin(), cut.rowRunOffsets.end(), uint32_t(run)) - cut.rowRunOffsets.begin()) - 1;
    const auto inSlab = [&](size_t axis, size_t c, size_t end) {
      return random.between(context.planes()[axis][c], context.planes()[axis][end]);
    };
    const double x = inSlab(0, size_t(cut.runBegin[run]), size_t(cut.runEnd[run]));
    const double y = inSlab(1, row % ny, row % ny + 1);
    const double z = inSlab(2, row / ny, row / ny + 1);
    samples.push_back({{{x, y, z}}, cut.runRegion[run], "run", int64_t(run)});
  }
  return samples;
}

class WindingCheck {
 public:
  WindingCheck(const Context& context, const InputTopology& topology, const TriangleBins& bins)
      : x_(context), topology_(topology), bins_(bins) {}

  Check checkNumbers(const std::vector<Sample>& samples) const {
    Tally tally("windingNumber");
    if (!x_.cut.hasWinding) {
      if (!topology_.mayBeOpen) {
        tally.violate("mesh", 0, "is closed and consistently oriented, but the result has no winding numbers");
      } else {
        tally.skip("The input is open or inconsistently oriented.");
      }
      return tally.finish();
    }
    if (!topology_.mayBeClosed) tally.violate("mesh", 0, "is open or inconsistently oriented, but the result has winding numbers");
    checkSteps(tally);
    checkSamples(samples, tally);
    return tally.finish();
  }

  Check checkVolume(const std::vector<double>& cellVolumes) const {
    Tally tally("inputVolume", kTolerance);
    bool inside = true;
    for (const uint32_t v : x_.mesh.triangles) inside &= x_.inBox(x_.triVertex(v));
    if (!x_.cut.hasWinding || !inside) {
      tally.skip(inside ? "The input has no volume." : "The input leaves the box.");
      return tally.finish();
    }
    const Volume found = regionVolume(cellVolumes), expected = inputVolume();
    const double deviation = std::fabs(found.value - expected.value), noise = found.noise + expected.noise;
    tally.measure({deviation > 0 ? deviation / noise : 0, deviation / std::fabs(expected.value)}, "mesh", 0,
                  "has another volume than the regions times their winding numbers: they differ by {}");
    return tally.finish();
  }

 private:
  /// A volume, and how much of it changes when its boundary moves by one rounding.
  struct Volume {
    double value, noise;
  };

  /// The step from the front of a face to its back is the sum of its parents' signs.
  void checkSteps(Tally& tally) const {
    for (size_t f = 0; f < x_.cut.faceCount(); ++f) {
      const int32_t behind = x_.owner[2 * f], front = x_.owner[2 * f + 1];
      if (behind < 0 || front < 0) continue;
      int32_t step = 0;
      for (const int8_t sign : x_.parentSigns(f)) step += sign;
      if (x_.cut.regionWinding[x_.cut.cellRegion[behind]] - x_.cut.regionWinding[x_.cut.cellRegion[front]] != step) {
        tally.violate("face", int64_t(f), "has winding numbers on its sides that do not differ as its triangles say");
      }
    }
  }

  void checkSamples(const std::vector<Sample>& samples, Tally& tally) const {
    for (const Sample& sample : samples) {
      const std::optional<int32_t> winding = bins_.winding(sample.position);
      if (!winding || *winding == x_.cut.regionWinding[sample.region]) continue;
      tally.violate(sample.kind, sample.element, "has another winding number than the input there");
    }
  }

  /// Sum of winding number times volume.
  Volume regionVolume(const std::vector<double>& cellVolumes) const {
    Sum sum;
    double noise = 0;
    const auto add = [&](double volume, uint32_t region) {
      sum.add(volume * x_.cut.regionWinding[region]);
      noise += kRounding * std::fabs(volume * x_.cut.regionWinding[region]);
    };
    for (size_t c = 0; c < cellVolumes.size(); ++c) add(cellVolumes[c], x_.cut.cellRegion[c]);
    const auto& planes = x_.planes();
    const size_t ny = size_t(x_.cut.grid.cells(1));
    for (size_t row = 0; row + 1 < x_.cut.rowRunOffsets.size(); ++row) {
      const double section = (planes[1][row % ny + 1] - planes[1][row % ny]) * (planes[2][row / ny + 1] - planes[2][row / ny]);
      for (uint32_t r = x_.cut.rowRunOffsets[row]; r < x_.cut.rowRunOffsets[row + 1]; ++r) {
        add((planes[0][x_.cut.runEnd[r]] - planes[0][x_.cut.runBegin[r]]) * section, x_.cut.runRegion[r]);
      }
    }
    return {sum.value(), noise};
  }

  /// Each triangle counts as often as it occurs.
  Volume inputVolume() const {
    Vec3 centre;
    for (int d = 0; d < 3; ++d) centre[d] = (x_.planes()[size_t(d)].front() + x_.planes()[size_t(d)].back()) / 2;
    Sum sum;
    double noise = 0;
    for (size_t t = 0; t < x_.mesh.triangleCount(); ++t) {
      const Vec3 a = x_.corner(t, 0), twice = cross(x_.corner(t, 1) - a, x_.corner(t, 2) - a);
      sum.add(dot(a - centre, twice) / 6);
      for (int d = 0; d < 3; ++d) noise += x_.rounding[d] * std::fabs(twice[d]) / 2;
    }
    return {sum.value(), noise};
  }

  const Context& x_;
  const InputTopology& topology_;
  const TriangleBins& bins_;
};

}  // namespace

WindingChecks checkWinding(const Context& context, const InputTopology& topology, const TriangleBins& bins,
                           const GridCellChecks& gridCells) {
  std::vector<Sample> samples = gridCells.samples;
  if (context.cut.hasWinding) {
    const std::vector<Sample> untouched = sampleUntouched(context);
    samples.insert(samples.end(), untouched.begin(), untouched.end());
  }
  const WindingCheck check(context, topology, bins);
  return {check.checkNumbers(samples), check.checkVolume(gridCells.cellVolumes)};
}

}  // namespace mandoline::validation
