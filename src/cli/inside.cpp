#include "cli/inside.h"

#include <algorithm>

namespace mandoline::cli {
namespace {

/// That of a region, of an array that may be empty.
template <class Number>
std::optional<Number> ofRegion(const std::vector<Number>& numbers, size_t region) {
  if (numbers.empty()) return std::nullopt;
  return numbers[region];
}

std::string ofParts(uint32_t count, const PartCounts& counts) {
  return std::to_string(count) + " of " + counted(counts.winding + counts.parity + counts.open, "part", "parts");
}

}  // namespace

std::optional<InsideRegions> insideOf(const CutMesh& cutMesh, double threshold) {
  if (!cutMesh.hasWinding && cutMesh.regionParity.empty() && cutMesh.regionInsideness.empty()) return std::nullopt;
  return insideRegions(cutMesh, {WindingRule::nonZero, threshold});
}

bool isAnyInside(const std::optional<InsideRegions>& inside) {
  return inside && std::count(inside->isInside.begin(), inside->isInside.end(), 1) > 0;
}

std::string describeInside(const std::optional<InsideRegions>& inside, const PartCounts& counts) {
  std::string text;
  const auto say = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  if (counts.parity > 0) say(ofParts(counts.parity, counts) + " not consistently oriented: inside by parity");
  if (counts.open > 0) {
    const bool isEstimated = inside && inside->by == InsideBy::estimate;
    say(ofParts(counts.open, counts) + " open, with " + counted(counts.openEdges, "open edge", "open edges") + " around " +
        counted(counts.holes, "hole", "holes") + (isEstimated ? ": inside by an estimate" : ": left out"));
  }
  return text;
}

void addInside(Json& json, const PartCounts& parts, const std::optional<InsideRegions>& inside) {
  json.key("parts").open('{').member("winding", parts.winding).member("parity", parts.parity).member("open", parts.open);
  json.member("openEdges", parts.openEdges).member("holes", parts.holes).close('}');
  json.key("inside");
  if (inside) {
    json.open('{').member("by", name(inside->by)).member("complete", inside->isComplete).close('}');
  } else {
    json.null();
  }
}

void addRegions(Json& json, const Report& report, const std::optional<InsideRegions>& inside) {
  const CutMesh& m = report.result.mesh;
  json.key("regions").open('[');
  for (size_t r = 0; r < m.regionCount; ++r) {
    json.open('{').member("id", r).member("winding", ofRegion(m.regionWinding, r)).member("volume", report.regionVolumes[r]);
    json.member("partWinding", ofRegion(m.regionPartWinding, r)).member("parity", ofRegion(m.regionParity, r));
    json.member("insideness", ofRegion(m.regionInsideness, r));
    json.member("inside", inside ? std::optional(inside->isInside[r] != 0) : std::nullopt).close('}');
  }
  json.close(']');
}

}  // namespace mandoline::cli
