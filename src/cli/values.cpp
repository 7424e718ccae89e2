#include "cli/values.h"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace mandoline::cli {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

bool areFinite(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

std::array<double, 3> parseVector(const char* option, const char* form, const std::string& word) {
  const std::vector<double> numbers = parseList<double>(word);
  if (numbers.size() != 3 || !areFinite(numbers)) throw UsageError(std::string(option) + " needs " + form + ", not '" + word + "'");
  return {numbers[0], numbers[1], numbers[2]};
}

/// The lists of a file, one on each line.
std::vector<std::string> readLists(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw FileError(path + ": can't be read");
  std::vector<std::string> lists;
  for (std::string line; std::getline(file, line);) {
    std::erase_if(line, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
    if (!line.empty()) lists.push_back(line);
  }
  if (lists.size() != 3)
    throw FileError(path + ": needs three lines, with the planes of x, y and z, but has " + std::to_string(lists.size()));
  return lists;
}

}  // namespace

void parseCells(const std::string& word, GridArguments& grid) {
  const std::vector<int64_t> cells = parseList<int64_t>(word);
  if (cells.size() != 1 && cells.size() != 3) throw UsageError("--cells needs N or NX,NY,NZ, not '" + word + "'");
  if (*std::min_element(cells.begin(), cells.end()) < 1) throw UsageError("--cells needs numbers of at least 1, not '" + word + "'");
  grid.oneNumber = cells.size() == 1;
  grid.cells.emplace();
  for (size_t d = 0; d < 3; ++d) (*grid.cells)[d] = cells[grid.oneNumber ? 0 : d];
}

void parseMargin(const std::string& word, GridArguments& grid) {
  double margin = 0;
  if (!parseNumber(word, margin) || !(margin >= 0 && margin <= 1e6)) {
    throw UsageError("--margin needs a number from 0 to 1e6, not '" + word + "'");
  }
  grid.margin = margin;
}

void parseBox(const std::string& word, GridArguments& grid) {
  const std::vector<double> box = parseList<double>(word);
  if (box.size() != 6) throw UsageError("--box needs X0,Y0,Z0,X1,Y1,Z1, not '" + word + "'");
  for (size_t d = 0; d < 3; ++d) {
    if (!(box[d] < box[d + 3]) || !std::isfinite(box[d + 3] - box[d]))
      throw UsageError("--box needs a box that is not empty, not '" + word + "'");
  }
  grid.box = {{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}}};
}

void parseOrigin(const std::string& word, GridArguments& grid) { grid.origin = parseVector("--origin", "X,Y,Z", word); }

void parseSpacing(const std::string& word, GridArguments& grid) {
  double one = 0;
  if (parseNumber(word, one) && std::isfinite(one)) {
    grid.spacing = {one, one, one};
  } else {
    grid.spacing = parseVector("--spacing", "S or SX,SY,SZ", word);
  }
  for (const double s : *grid.spacing) {
    if (!(s > 0)) throw UsageError("--spacing needs numbers above 0, not '" + word + "'");
  }
}

void parsePlanes(const std::string& word, GridArguments& grid) {
  const std::vector<std::string> lists = word[0] == '@' ? readLists(word.substr(1)) : split(word, '/');
  if (lists.size() != 3) throw UsageError("--planes needs X0,X1,.../Y0,Y1,.../Z0,Z1,... or @FILE, not '" + word + "'");
  grid.planes.emplace();
  for (size_t d = 0; d < 3; ++d) {
    const std::string axis = std::string("--planes: the ") + "xyz"[d] + " planes ";
    std::vector<double>& planes = (*grid.planes)[d] = parseList<double>(lists[d]);
    if (planes.empty() || !areFinite(planes)) throw UsageError(axis + "must be numbers, not '" + lists[d] + "'");
    if (planes.size() < 2) throw UsageError(axis + "must be at least two");
    if (std::adjacent_find(planes.begin(), planes.end(), std::greater_equal()) != planes.end()) throw UsageError(axis + "must ascend");
  }
}

void parseOnly(const std::string& word, OnlyArguments& only) {
  for (const std::string& part : split(word, ',')) {
    uint32_t region = 0;
    if (part == "cut") {
      only.cut = true;
    } else if (part == "inside") {
      only.inside = true;
    } else if (part == "outside") {
      only.outside = true;
    } else if (part == "all") {
      only.all = true;
    } else if (part.starts_with("region=") && parseNumber(std::string_view(part).substr(7), region)) {
      only.regions.push_back(region);
    } else {
      throw UsageError("--only needs cut, inside, outside, region=K or all, not '" + part + "'");
    }
  }
}

void parseAxis(const std::string& word, SliceArguments& slice) {
  const size_t axis = std::string_view("xyz").find(word);
  if (word.size() != 1 || axis == std::string_view::npos) throw UsageError("--axis needs x, y or z, not '" + word + "'");
  slice.normal = {0, 0, 0};
  slice.normal[axis] = 1;
}

void parseNormal(const std::string& word, SliceArguments& slice) {
  slice.normal = parseVector("--normal", "X,Y,Z", word);
  if (slice.normal == std::array<double, 3>{}) throw UsageError("--normal needs a vector that is not zero");
}

void parseHeights(const std::string& word, SliceArguments& slice) {
  slice.heights = parseList<double>(word);
  if (slice.heights.empty() || !areFinite(slice.heights)) throw UsageError("--heights needs H1,H2,..., not '" + word + "'");
}

void parseLayers(const std::string& word, SliceArguments& slice) {
  if (!parseNumber(word, slice.layers) || slice.layers < 1) throw UsageError("--layers needs a number of layers, not '" + word + "'");
}

void parseWind(const std::string& word, FlowArguments& flow) { flow.wind = parseVector("--wind", "X,Y,Z", word); }

void parseStreamlines(const std::string& word, FlowArguments& flow) {
  uint32_t count = 0;
  if (!parseNumber(word, count) || count < 1) throw UsageError("--streamlines needs a number of lines of at least 1, not '" + word + "'");
  flow.streamlines = count;
}

void parseCorrections(const std::string& word, FlowArguments& flow) {
  int count = 0;
  if (!parseNumber(word, count) || count < 0) throw UsageError("--corrections needs a number of at least 0, not '" + word + "'");
  flow.corrections = count;
}

void parseSteps(const std::string& word, FlowArguments& flow) {
  uint32_t count = 0;
  if (!parseNumber(word, count) || count < 1) throw UsageError("--steps needs a number of steps of at least 1, not '" + word + "'");
  flow.steps = count;
}

void parseViscosity(const std::string& word, FlowArguments& flow) {
  if (!parseNumber(word, flow.viscosity) || !(flow.viscosity >= 0) || !std::isfinite(flow.viscosity))
    throw UsageError("--viscosity needs a number of at least 0, not '" + word + "'");
}

void checkGrid(const GridArguments& grid) {
  if ((grid.box.has_value() + grid.planes.has_value() + (grid.origin || grid.spacing)) > 1) {
    throw UsageError("only one of --box, --planes, and --origin with --spacing");
  }
  if (grid.margin && (grid.box || grid.planes || grid.origin)) {
    throw UsageError("--margin is for grids around the mesh, without --box, --planes or --origin");
  }
  if (grid.planes && grid.cells) throw UsageError("--planes tells the number of cells, so there can be no --cells");
  if (grid.origin.has_value() != grid.spacing.has_value()) throw UsageError("--origin and --spacing need each other");
  if (grid.origin && !grid.cells) throw UsageError("--origin and --spacing need --cells");
}

void checkFlow(const FlowArguments& flow) {
  if (!flow.wind) throw UsageError("flow needs --wind");
  if (flow.viscosity > 0 && !flow.steps) throw UsageError("--viscosity is for --steps; without them the flow has a potential");
  if (flow.farField && flow.steps) throw UsageError("--far-field is that of the potential flow, without --steps");
  if (flow.corrections && flow.steps) throw UsageError("--corrections are those of the potential flow, without --steps");
  if (flow.streamlines && flow.steps) throw UsageError("--streamlines are those of the potential flow, without --steps");
}

void checkSlice(const SliceArguments& slice, const OnlyArguments& only) {
  if (slice.heights.empty() && slice.layers == 0) throw UsageError("slice needs --heights or --layers");
  if (!slice.heights.empty() && slice.layers != 0) throw UsageError("only one of --heights and --layers");
  if (only.cut) throw UsageError("--only cut: outlines have no cells");
}

}  // namespace mandoline::cli
