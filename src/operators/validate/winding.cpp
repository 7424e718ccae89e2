// Piecewise-constant winding number and input volume (paper, 5.6), where the input has winding numbers.
#include <algorithm>

#include "operators/validate/bins.h"

namespace mandoline::validation {
namespace {

class WindingCheck {
 public:
  WindingCheck(const Context& context, const TriangleBins& bins, const std::vector<double>& cellVolumes,
               const std::vector<uint8_t>& overlapping, std::vector<Sample> samples)
      : x_(context), bins_(bins), cellVolumes_(cellVolumes), overlapping_(overlapping), samples_(std::move(samples)) {}

  void run(std::vector<Check>& checks) {
    if (x_.cut.hasWinding) sampleUntouched();
    checks.push_back(checkNumbers());
    checks.push_back(checkVolume());
  }

 private:
  // Triangles dropped as duplicates may be counted or not, but everywhere alike: both ways are tried, and the one that fits better counts.
  Check checkNumbers() const {
    Check distinct = checkNumbers(false);
    if (x_.duplicate.empty()) return distinct;
    Check all = checkNumbers(true);
    return all.worst < distinct.worst ? all : distinct;
  }

  Check checkNumbers(bool withDuplicates) const {
    Tally tally("windingNumber");
    if (!x_.cut.hasWinding) {
      if (!x_.mayBeOpen[withDuplicates]) {
        tally.violate("mesh", 0, "is closed and consistently oriented, but the result has no winding numbers");
      } else {
        tally.skip("the input is open or inconsistently oriented");
      }
      return tally.finish();
    }
    if (!x_.mayBeClosed[withDuplicates]) tally.violate("mesh", 0, "is open or inconsistently oriented, but the result has winding numbers");
    checkSteps(withDuplicates, tally);
    checkSamples(withDuplicates, tally);
    return tally.finish();
  }

  /// One more behind a triangle than in front of it. Where triangles overlap in part, only samples tell.
  void checkSteps(bool withDuplicates, Tally& tally) const {
    for (size_t f = 0; f < x_.cut.faceCount(); ++f) {
      const int32_t t = x_.cut.faceTriangle[f], behind = x_.owner[2 * f], front = x_.owner[2 * f + 1];
      if (t < 0 || behind < 0 || front < 0 || overlapping_[t]) continue;
      const int32_t step = withDuplicates && !x_.multiplicity.empty() ? x_.multiplicity[t] : 1;
      if (x_.cut.regionWinding[x_.cut.cellRegion[behind]] - x_.cut.regionWinding[x_.cut.cellRegion[front]] != step) {
        tally.violate("face", int64_t(f), "has winding numbers on its sides that do not differ as its triangle says");
      }
    }
  }

  void checkSamples(bool withDuplicates, Tally& tally) const {
    for (const Sample& sample : samples_) {
      int32_t winding;
      if (!bins_.winding(sample.position, withDuplicates, winding) || winding == x_.cut.regionWinding[sample.region]) continue;
      tally.violate(sample.kind, sample.element, "has another winding number than the input there");
    }
  }

  void sampleUntouched() {
    constexpr size_t kSamples = 200;
    Random random(2);
    const int64_t ny = x_.cut.grid.cells(1);
    for (size_t i = 0; i < kSamples && !x_.cut.runBegin.empty(); ++i) {
      const size_t run = size_t(random.next() % x_.cut.runBegin.size());
      const int64_t row =
          std::upper_bound(x_.cut.rowRunOffsets.begin(), x_.cut.rowRunOffsets.end(), uint32_t(run)) - x_.cut.rowRunOffsets.begin() - 1;
      const auto inSlab = [&](int axis, int64_t c, int64_t end) { return random.between(x_.planes[axis][c], x_.planes[axis][end]); };
      const Vec3 p{
          {inSlab(0, x_.cut.runBegin[run], x_.cut.runEnd[run]), inSlab(1, row % ny, row % ny + 1), inSlab(2, row / ny, row / ny + 1)}};
      samples_.push_back({p, x_.cut.runRegion[run], "run", int64_t(run)});
    }
  }

  Check checkVolume() const {
    Tally tally("inputVolume", kTolerance);
    bool inside = true;
    for (const uint32_t v : x_.mesh.triangles) inside &= x_.inBox(x_.triVertex(v));
    if (!x_.cut.hasWinding || !inside) {
      tally.skip(inside ? "the input has no volume" : "the input leaves the box");
      return tally.finish();
    }
    double noise = 0;
    const double found = regionVolume(noise), all = inputVolume(true, noise),
                 distinct = x_.duplicate.empty() ? all : inputVolume(false, noise);
    const double deviation = std::min(std::fabs(found - all), std::fabs(found - distinct));
    tally.measure(deviation > 0 ? deviation / noise : 0, "mesh", 0, "has another volume than the regions, times their winding numbers");
    return tally.finish();
  }

  /// Sum of winding number times volume.
  double regionVolume(double& noise) const {
    Sum sum;
    const auto add = [&](double volume, uint32_t region) {
      sum.add(volume * x_.cut.regionWinding[region]);
      noise += kRounding * std::fabs(volume * x_.cut.regionWinding[region]);
    };
    for (size_t c = 0; c < cellVolumes_.size(); ++c) add(cellVolumes_[c], x_.cut.cellRegion[c]);
    const auto& planes = x_.planes;
    const size_t ny = size_t(x_.cut.grid.cells(1));
    for (size_t row = 0; row + 1 < x_.cut.rowRunOffsets.size(); ++row) {
      const double section = (planes[1][row % ny + 1] - planes[1][row % ny]) * (planes[2][row / ny + 1] - planes[2][row / ny]);
      for (uint32_t r = x_.cut.rowRunOffsets[row]; r < x_.cut.rowRunOffsets[row + 1]; ++r) {
        add((planes[0][x_.cut.runEnd[r]] - planes[0][x_.cut.runBegin[r]]) * section, x_.cut.runRegion[r]);
      }
    }
    return sum.value();
  }

  double inputVolume(bool withDuplicates, double& noise) const {
    Vec3 centre;
    for (int d = 0; d < 3; ++d) centre[d] = (x_.planes[d].front() + x_.planes[d].back()) / 2;
    Sum sum;
    for (size_t t = 0; t < x_.mesh.triangleCount(); ++t) {
      if (!withDuplicates && x_.isDuplicate(t)) continue;
      const Vec3 a = x_.corner(t, 0), twice = cross(x_.corner(t, 1) - a, x_.corner(t, 2) - a);
      sum.add(dot(a - centre, twice) / 6);
      for (int d = 0; d < 3; ++d) noise += x_.rounding[d] * std::fabs(twice[d]) / 2;
    }
    return sum.value();
  }

  const Context& x_;
  const TriangleBins& bins_;
  const std::vector<double>& cellVolumes_;
  const std::vector<uint8_t>& overlapping_;
  std::vector<Sample> samples_;
};

}  // namespace

void checkWinding(const Context& context, const TriangleBins& bins, const std::vector<double>& cellVolumes,
                  const std::vector<uint8_t>& overlapping, std::vector<Sample> samples, std::vector<Check>& checks) {
  WindingCheck(context, bins, cellVolumes, overlapping, std::move(samples)).run(checks);
}

}  // namespace mandoline::validation
