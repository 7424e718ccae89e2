#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/plain_arithmetic.h"
#include "io/mcm/arrays.h"

namespace mandoline::detail {
namespace {

/// How a coordinate that nothing predicts is written.
enum Spelling : int64_t {
  bits,     ///< as a double
  single,   ///< as a number that float has
  decimal,  ///< as an integer over a power of ten
  kSpellings
};

constexpr int kSingleShift = 29;  // bits of a double that a float lacks
constexpr int kMostDigits = 17;
constexpr const char* kOtherLength = "has another length than the other arrays of vertices";

double powerOfTen(int64_t exponent) {
  double power = 1;
  for (int64_t i = 0; i < exponent; ++i) power *= 10;
  return power;  // exact up to 10^22
}

std::optional<int64_t> asDecimal(double x, double power) {
  const double scaled = x * power;
  if (!(std::fabs(scaled) < double(int64_t(1) << 53))) return {};
  const int64_t n = int64_t(std::nearbyint(scaled));
  if (toInteger(double(n) / power) != toInteger(x)) return {};
  return n;
}

/// The fewest digits after the point that are enough for most tri-vertices, judged by some of them.
template <class AnyCutMesh>
int64_t digitsOf(const AnyCutMesh& cutMesh) {
  constexpr size_t kSamples = 1000;
  std::array<size_t, kMostDigits + 1> enough{};
  size_t samples = 0;
  for (size_t v = 0; v < cutMesh.vertexTriVertex.size() && samples < kSamples; ++v) {
    if (cutMesh.vertexTriVertex[v] < 0) continue;
    ++samples;
    for (int digits = 0; digits <= kMostDigits; ++digits) {
      enough[size_t(digits)] += asDecimal(cutMesh.positions[3 * v], powerOfTen(digits)).has_value();
    }
  }
  int64_t best = 0;
  for (int digits = 1; digits <= kMostDigits; ++digits) {
    if (enough[size_t(digits)] > enough[size_t(best)] + samples / 50) best = digits;
  }
  return best;
}

/// Finds the last plane of an axis at or below a coordinate; the first if there is none. It looks first where a uniform grid has it.
class PlaneFinder {
 public:
  explicit PlaneFinder(const std::vector<double>& planes) : planes_(planes) {
    if (!planes.empty()) perUnit_ = double(planes.size() - 1) / (planes.back() - planes.front());
  }

  /// There must be planes.
  int64_t operator()(double x) const {
    const size_t last = planes_.size() - 1;
    const double guess = (x - planes_.front()) * perUnit_;
    size_t i = size_t(guess > 0 ? std::min(guess, double(last)) : 0);  // 0 for NaN, too
    i += i < last && planes_[i + 1] <= x;
    i -= i > 0 && planes_[i] > x;
    if (planes_[i] <= x && (i == last || x < planes_[i + 1])) return int64_t(i);
    const auto above = std::upper_bound(planes_.begin(), planes_.end(), x);
    return above == planes_.begin() ? 0 : int64_t(above - planes_.begin()) - 1;
  }

 private:
  const std::vector<double>& planes_;
  double perUnit_ = 0;
};

/// Where an edge has the coordinate of the plane: of several planes the one it is steepest to.
struct Crossing {
  const double *a, *b;  ///< the ends
  size_t axis;
  double part;  ///< of the way from a to b

  double at(size_t d) const {
    const double x = a[d] + (b[d] - a[d]) * part;
    return std::isfinite(x) ? x : a[d];
  }
};

template <class Stream, class AnyCutMesh>
class PositionCoder {
 public:
  PositionCoder(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh)
      : cutMesh_(cutMesh), planes_(bytes), rounding_(bytes), spellings_(bytes), values_(bytes) {}

  void run(uint64_t length) {
    const size_t count = cutMesh_.vertexMask.size();
    const bool fit = length == 3 * count && cutMesh_.vertexTriVertex.size() == count && cutMesh_.vertexParents.size() == 2 * count;
    if (!fit) throw Damaged{kOtherLength};
    for (const std::vector<double>& planes : cutMesh_.grid.planes) {
      if (planes.empty()) throw Damaged{"has no planes to refer to"};
    }
    setLength(cutMesh_.positions, length);
    power_ = powerOfTen(std::clamp<int64_t>(values_.code(kIsRead ? 0 : digitsOf(cutMesh_)), 0, kMostDigits));
    for (size_t v = 0; v < count; ++v) codeVertex(v);
    planes_.finish();
    rounding_.finish();
    spellings_.finish();
    values_.finish();
  }

 private:
  static constexpr bool kIsRead = !std::is_const_v<AnyCutMesh>;

  void codeVertex(size_t v) {
    auto* p = &cutMesh_.positions[3 * v];
    const unsigned mask = cutMesh_.vertexMask[v] & 7;
    for (size_t d = 0; d < 3; ++d) {
      if (mask >> d & 1) codeOnPlane(p[d], d);
    }
    const std::optional<Crossing> crossing = mask == 0 ? std::nullopt : crossingOf(v, mask);
    for (size_t d = 0; d < 3; ++d) {
      if (mask >> d & 1) continue;
      if (crossing) {
        codeEntry(rounding_, p[d], toInteger(crossing->at(d)));
      } else {
        codeUnknown(p[d], d);
      }
    }
    const int32_t triVertex = cutMesh_.vertexTriVertex[v];
    if (triVertex < 0) return;
    if (size_t(triVertex) >= places_.size()) places_.resize(std::max(size_t(triVertex) + 1, 2 * places_.size()), kNowhere);
    places_[size_t(triVertex)] = uint32_t(v);
  }

  template <class Coordinate>
  void codeOnPlane(Coordinate& x, size_t d) {
    const std::vector<double>& planes = cutMesh_.grid.planes[d];
    plane_[d] = codeDifference(planes_, kIsRead ? 0 : finders_[d](x), plane_[d]);
    if (plane_[d] < 0 || size_t(plane_[d]) >= planes.size()) throw Damaged{"names a plane that does not exist"};
    codeEntry(rounding_, x, toInteger(planes[size_t(plane_[d])]));
  }

  const double* placeOf(int32_t triVertex) const {
    if (triVertex < 0 || size_t(triVertex) >= places_.size() || places_[size_t(triVertex)] == kNowhere) return nullptr;
    return &cutMesh_.positions[3 * size_t(places_[size_t(triVertex)])];
  }

  std::optional<Crossing> crossingOf(size_t v, unsigned mask) const {
    const int32_t* parents = &cutMesh_.vertexParents[2 * v];
    const double *a = placeOf(parents[0]), *b = placeOf(parents[1]);
    if (!a || !b) return {};
    size_t axis = 3;
    for (size_t d = 0; d < 3; ++d) {
      if ((mask >> d & 1) && (axis == 3 || std::fabs(b[d] - a[d]) > std::fabs(b[axis] - a[axis]))) axis = d;
    }
    const double part = (cutMesh_.positions[3 * v + axis] - a[axis]) / (b[axis] - a[axis]);
    if (!std::isfinite(part)) return {};
    return Crossing{a, b, axis, part};
  }

  template <class Coordinate>
  void codeUnknown(Coordinate& x, size_t d) {
    int64_t spelling = bits, value = 0;
    if constexpr (!kIsRead) {
      value = toInteger(x);
      if (const std::optional<int64_t> n = asDecimal(x, power_)) {
        spelling = decimal;
        value = *n;
      } else if (value % (int64_t(1) << kSingleShift) == 0) {
        spelling = single;
        value >>= kSingleShift;
      }
    }
    spelling = spellings_.code(spelling);
    if (spelling < 0 || spelling >= kSpellings) throw Damaged{"has a coordinate of no known kind"};
    int64_t& last = last_[size_t(spelling)][d];
    last = codeDifference(values_, value, last);
    if constexpr (kIsRead) {
      x = spelling == decimal ? double(last) / power_
                              : fromInteger<double>(spelling == single ? int64_t(uint64_t(last) << kSingleShift) : last);
    }
  }

  static constexpr uint32_t kNowhere = ~0u;
  AnyCutMesh& cutMesh_;
  Stream planes_, rounding_, spellings_, values_;
  std::array<PlaneFinder, 3> finders_{PlaneFinder(cutMesh_.grid.planes[0]), PlaneFinder(cutMesh_.grid.planes[1]),
                                      PlaneFinder(cutMesh_.grid.planes[2])};
  std::array<int64_t, 3> plane_{};  // the last one written
  double power_ = 1;
  std::array<std::array<int64_t, 3>, kSpellings> last_{};
  std::vector<uint32_t> places_;  // per tri-vertex: the vertex that it is, of those before
};

}  // namespace

template <class Stream, class AnyCutMesh>
void codePositions(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh, uint64_t length) {
  PositionCoder<Stream, AnyCutMesh>(bytes, cutMesh).run(length);
}

template <class Stream, class AnyCutMesh>
void codeVertexCells(typename Stream::Bytes& bytes, AnyCutMesh& cutMesh, uint64_t length) {
  if (length != cutMesh.positions.size()) throw Damaged{kOtherLength};
  setLength(cutMesh.vertexCell, length);
  Stream stream(bytes);
  const std::array<std::vector<double>, 3>& planes = cutMesh.grid.planes;
  const std::array<PlaneFinder, 3> finders{PlaneFinder(planes[0]), PlaneFinder(planes[1]), PlaneFinder(planes[2])};
  for (size_t i = 0; i < length; ++i) {
    codeEntry(stream, cutMesh.vertexCell[i], finders[i % 3](cutMesh.positions[i]));
  }
  stream.finish();
}

template void codeVertexCells<WrittenStream>(std::string& bytes, const CutMesh& cutMesh, uint64_t length);
template void codeVertexCells<ReadStream>(std::string_view& bytes, CutMesh& cutMesh, uint64_t length);
template void codePositions<WrittenStream>(std::string& bytes, const CutMesh& cutMesh, uint64_t length);
template void codePositions<ReadStream>(std::string_view& bytes, CutMesh& cutMesh, uint64_t length);

}  // namespace mandoline::detail
