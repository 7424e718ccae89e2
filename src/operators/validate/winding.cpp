// Piecewise constant winding number and input volume, where the input has winding numbers.
#include <algorithm>
#include <functional>

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

/// What the input's triangles add to a number of each region.
struct Numbers {
  std::function<int32_t(uint32_t region)> of;
  bool modulo2;
  const char *wrongStep, *wrongSample;  ///< what is wrong with a face, and with a cell
  std::vector<uint8_t> isLeftOut;       ///< per triangle

  bool areEqual(int32_t a, int32_t b) const { return modulo2 ? (a - b) % 2 == 0 : a == b; }
  int32_t sign(uint32_t triangle, int8_t sign) const { return isLeftOut[triangle] ? 0 : sign; }
};

class WindingCheck {
 public:
  WindingCheck(const Context& context, const InputTopology& topology, const TriangleBins& bins)
      : x_(context), topology_(topology), bins_(bins) {}

  Check checkNumbers(const std::vector<Sample>& samples) const {
    Tally tally("windingNumber");
    if (!x_.cut.hasWinding) {
      if (!topology_.mayBeOpen) {
        tally.violate("mesh", 0, "is closed and consistently oriented, but the result has no winding numbers");
      } else if (x_.cut.regionPartWinding.empty() && x_.cut.regionParity.empty()) {
        tally.skip("The input is open or inconsistently oriented.");
      }
    } else if (!topology_.mayBeClosed) {
      tally.violate("mesh", 0, "is open or inconsistently oriented, but the result has winding numbers");
    }
    for (const Numbers& numbers : allNumbers()) {
      checkSteps(numbers, tally);
      checkSamples(numbers, samples, tally);
    }
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

  std::vector<Numbers> allNumbers() const {
    std::vector<Numbers> all;
    const auto add = [&](const auto& numbers, std::initializer_list<const std::vector<uint32_t>*> leftOut, bool modulo2,
                         const char* wrongStep, const char* wrongSample) {
      if (numbers.empty()) return;
      all.push_back({[&numbers](uint32_t region) { return int32_t(numbers[region]); }, modulo2, wrongStep, wrongSample, {}});
      all.back().isLeftOut.assign(x_.mesh.triangleCount(), 0);
      for (const std::vector<uint32_t>* triangles : leftOut) {
        for (const uint32_t t : *triangles) all.back().isLeftOut[t] = 1;
      }
    };
    const CutMesh& cut = x_.cut;
    add(cut.regionWinding, {}, false, "has winding numbers on its sides that do not differ as its triangles say",
        "has another winding number than the input there");
    add(cut.regionPartWinding, {&cut.parityTriangles, &cut.openTriangles}, false,
        "has winding numbers of parts on its sides that do not differ as its triangles say",
        "has another winding number of parts than the input there");
    add(cut.regionParity, {&cut.openTriangles}, true, "has parities on its sides that do not differ as its triangles say",
        "has another parity than the input there");
    return all;
  }

  /// The step from the front of a face to its back is the sum of its parents' signs.
  void checkSteps(const Numbers& numbers, Tally& tally) const {
    for (size_t f = 0; f < x_.cut.faceCount(); ++f) {
      const int32_t behind = x_.owner[2 * f], front = x_.owner[2 * f + 1];
      if (behind < 0 || front < 0) continue;
      int32_t step = 0;
      for (size_t i = 0; i < x_.parents(f).size(); ++i) step += numbers.sign(x_.parents(f)[i], x_.parentSigns(f)[i]);
      if (!numbers.areEqual(numbers.of(x_.cut.cellRegion[behind]), numbers.of(x_.cut.cellRegion[front]) + step)) {
        tally.violate("face", int64_t(f), numbers.wrongStep);
      }
    }
  }

  void checkSamples(const Numbers& numbers, const std::vector<Sample>& samples, Tally& tally) const {
    for (const Sample& sample : samples) {
      const std::optional<int32_t> winding = bins_.winding(sample.position, [&](uint32_t t) { return !numbers.isLeftOut[t]; });
      if (!winding || numbers.areEqual(*winding, numbers.of(sample.region))) continue;
      tally.violate(sample.kind, sample.element, numbers.wrongSample);
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
  if (context.cut.hasWinding || !context.cut.regionParity.empty()) {
    const std::vector<Sample> untouched = sampleUntouched(context);
    samples.insert(samples.end(), untouched.begin(), untouched.end());
  }
  const WindingCheck check(context, topology, bins);
  return {check.checkNumbers(samples), check.checkVolume(gridCells.cellVolumes)};
}

}  // namespace mandoline::validation
