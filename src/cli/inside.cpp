#include "cli/inside.h"

#include <algorithm>

namespace mandoline::cli {
namespace {

template <class Numbers>
void addNumber(Json& json, const char* key, const Numbers& numbers, size_t region) {
  json.key(key);
  if (numbers.empty()) {
    json.null();
  } else {
    json.value(int64_t(numbers[region]));
  }
}

std::string counted(uint64_t count, const std::string& noun) { return std::to_string(count) + " " + noun + (count == 1 ? "" : "s"); }

std::string ofParts(uint32_t count, const PartCounts& counts) {
  return std::to_string(count) + " of " + counted(counts.winding + counts.parity + counts.open, "part");
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
    say(ofParts(counts.open, counts) + " open, with " + counted(counts.openEdges, "open edge") + " around " +
        counted(counts.holes, "hole") + (isEstimated ? ": inside by an estimate" : ": left out"));
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
  for (uint32_t r = 0; r < m.regionCount; ++r) {
    json.open('{').member("id", r);
    addNumber(json, "winding", m.regionWinding, r);
    json.member("volume", report.regionVolumes[r]);
    addNumber(json, "partWinding", m.regionPartWinding, r);
    addNumber(json, "parity", m.regionParity, r);
    json.key("insideness");
    if (m.regionInsideness.empty()) {
      json.null();
    } else {
      json.value(m.regionInsideness[r]);
    }
    json.key("inside");
    if (inside) {
      json.value(inside->isInside[r] != 0);
    } else {
      json.null();
    }
    json.close('}');
  }
  json.close(']');
}

}  // namespace mandoline::cli
