// What is inside, for the commands and their reports: which regions, and what tells it.
#pragma once

#include <optional>

#include "cli/json.h"
#include "cli/report.h"

namespace mandoline::cli {

/// The regions with a winding number other than 0, by the best that the cut-mesh has; nothing if nothing is known of any.
std::optional<InsideRegions> insideOf(const CutMesh& cutMesh, double threshold);

bool isAnyInside(const std::optional<InsideRegions>& inside);

/// One line for people: what tells inside from outside, and which parts are left out. Empty if the input has winding numbers as a
/// whole.
std::string describeInside(const std::optional<InsideRegions>& inside, const PartCounts& parts);

/// The members parts and inside.
void addInside(Json& json, const PartCounts& parts, const std::optional<InsideRegions>& inside);

/// The member regions.
void addRegions(Json& json, const Report& report, const std::optional<InsideRegions>& inside);

}  // namespace mandoline::cli
