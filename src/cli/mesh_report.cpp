#include "cli/mesh_report.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace mandoline::cli {
namespace {

/// What kind of mesh it is, beyond its size.
std::vector<Count> meshCounts(const MeshInfo& info) {
  return {{"openEdges", "open edges", info.openEdges},
          {"nonManifoldEdges", "non-manifold edges", info.nonManifoldEdges},
          {"inconsistentEdges", "inconsistent edges", info.inconsistentEdges},
          {"components", "components", info.components},
          {"zeroAreaTriangles", "zero-area triangles", info.zeroAreaTriangles},
          {"duplicateTriangles", "duplicate triangles", info.duplicateTriangles},
          {"weldedVertices", "welded vertices", info.weldedVertices},
          {"unreferencedVertices", "unreferenced vertices", info.unreferencedVertices},
          {"nonFiniteVertices", "non-finite vertices", info.nonFiniteVertices}};
}

/// The groups with the numbers of their triangles.
std::vector<std::pair<std::string, uint64_t>> groupCounts(const TriangleGroups& groups) {
  std::vector<std::pair<std::string, uint64_t>> counts;
  for (const std::string& name : groups.names) counts.push_back({name, 0});
  for (const uint32_t group : groups.triangleGroup) ++counts[group].second;
  return counts;
}

void addOrientation(Json& json, const std::optional<Orientation>& orientation) {
  json.key("orientation");
  if (!orientation) {
    json.null();
    return;
  }
  json.open('{').member("turnedTriangles", orientation->turnedTriangles);
  for (size_t f = 0; f < orientation->patches.size(); ++f) json.member(name(Facing(f)), orientation->patches[f]);
  json.close('}');
}

const double* end(const Mesh& mesh, const MeshInfo& info, size_t defect, size_t i) {
  return &mesh.positions[3 * size_t(info.defectVertices[2 * defect + i])];
}

std::span<const uint32_t> trianglesAt(const MeshInfo& info, size_t defect) {
  const uint32_t begin = info.defectTriangleOffsets[defect];
  return {info.defectTriangles.data() + begin, info.defectTriangleOffsets[defect + 1] - begin};
}

/// The report of millions of loose triangles lists so many of their components, places and defects.
constexpr size_t kMostListed = 10000;

void addDefects(Json& json, const MeshReport& report) {
  const MeshInfo& info = report.info;
  json.member("placeCount", info.placeCount()).member("defectCount", info.defectCount());
  json.key("components").open('[');
  for (size_t c = 0; c < std::min(kMostListed, info.components); ++c) {
    json.open('{').member("closed", info.componentClosed[c] != 0).member("oriented", info.componentOriented[c] != 0).close('}');
  }
  json.close(']').key("places").open('[');
  for (size_t p = 0; p < std::min(kMostListed, info.placeCount()); ++p) {
    const std::span<const double> box(&info.placeBox[6 * p], 6);
    json.open('{').member("component", info.placeComponent[p]);
    json.key("min").values(box.first(3)).key("max").values(box.last(3)).close('}');
  }
  json.close(']').key("defects").open('[');
  for (size_t d = 0; d < std::min(kMostListed, info.defectCount()); ++d) {
    json.open('{').member("kind", name(info.defectKind[d])).member("place", info.defectPlace[d]);
    json.key("vertices").values(std::span(&info.defectVertices[2 * d], 2)).key("triangles").values(trianglesAt(info, d));
    json.key("from").values(std::span(end(report.input.mesh, info, d, 0), 3));
    json.key("to").values(std::span(end(report.input.mesh, info, d, 1), 3)).close('}');
  }
  json.close(']');
}

/// What there is to do about the defects of each kind.
void addAdvice(std::ostream& out, const MeshInfo& info) {
  if (info.openEdges > 0) out << "  " << counted(info.openEdges, "edge is open", "edges are open") << ": the surface ends there\n";
  if (info.nonManifoldEdges > 0) out << "  " << counted(info.nonManifoldEdges, "edge has", "edges have") << " more than two triangles\n";
  if (info.inconsistentEdges > 0) {
    out << "  " << counted(info.inconsistentEdges, "edge is", "edges are")
        << " run through the same way by both triangles: --orient turns one of them, but for one-sided surfaces\n";
  }
}

/// Where the defects are: the first of them, and of their places.
void addDefects(std::ostream& out, const MeshReport& report) {
  constexpr size_t kMost = 5;
  const MeshInfo& info = report.info;
  if (info.defectCount() == 0) return;
  out << "\nDefects in " << counted(info.placeCount(), "place", "places") << "\n";
  addAdvice(out, info);
  const auto addMore = [&](size_t count) {
    if (count > kMost) out << "    and " << count - kMost << " more\n";
  };
  for (size_t p = 0; p < std::min(kMost, info.placeCount()); ++p) {
    const double* box = &info.placeBox[6 * p];
    out << "    place " << p << " of component " << info.placeComponent[p] << ", from (" << triple(box, ", ") << ") to ("
        << triple(box + 3, ", ") << ")\n";
  }
  addMore(info.placeCount());
  for (size_t d = 0; d < std::min(kMost, info.defectCount()); ++d) {
    out << "    " << name(info.defectKind[d]) << " edge from (" << triple(end(report.input.mesh, info, d, 0), ", ") << ") to ("
        << triple(end(report.input.mesh, info, d, 1), ", ") << ") in place " << info.defectPlace[d] << ", "
        << (trianglesAt(info, d).size() == 1 ? "triangle" : "triangles");
    for (const uint32_t t : trianglesAt(info, d)) out << ' ' << t;
    out << "\n";
  }
  addMore(info.defectCount());
  out << "  -o FILE.obj writes them all as lines, --report FILE.json tells of the first " << kMostListed << "\n";
}

}  // namespace

void addHead(Json& json, const Outcome& outcome, const std::string& path) {
  json.open('{').member("status", outcome.status).member("message", outcome.message);
  json.element("element", outcome.element).element("element2", outcome.element2);
  json.member("path", path);
}

void addHead(Json& json, const Outcome& outcome, const MeshReport& report) {
  const MeshInfo& info = report.info;
  addHead(json, outcome, report.input.name);
  json.key("mesh").open('{').member("vertices", info.vertices).member("triangles", info.triangles);
  json.key("box").open('{').key("min").values(info.min).key("max").values(info.max).close('}');
  json.member("closed", info.closed).member("oriented", info.oriented);
  for (const Count& count : meshCounts(info)) json.member(count.key, count.value);
  addOrientation(json, report.input.orientation);
  json.key("groups").open('[');
  for (const auto& [groupName, triangles] : groupCounts(report.input.groups)) {
    json.open('{').member("name", groupName).member("triangles", triangles).close('}');
  }
  json.close(']').close('}');
}

void addPairs(Json& json, const char* key, const PairCounts& pairs) {
  json.key(key).open('{').member("pairs", pairs.total());
  for (const Count& count : pairCounts(pairs)) json.member(count.key, count.value);
}

std::string counted(uint64_t count, const char* one, const char* many) { return std::to_string(count) + ' ' + (count == 1 ? one : many); }

std::vector<Count> pairCounts(const PairCounts& pairs) {
  return {{"crossing", "crossing", pairs.crossing},
          {"touching", "touching", pairs.touching},
          {"overlapping", "overlapping", pairs.overlapping},
          {"folded", "folded", pairs.folded},
          {"identical", "identical", pairs.identical}};
}

std::string describePairs(const PairCounts& pairs) {
  if (pairs.total() == 0) return "0";
  std::string text;
  for (const Count& count : pairCounts(pairs)) {
    if (count.value > 0) text += (text.empty() ? "" : ", ") + std::to_string(count.value) + " " + count.label;
  }
  return text;
}

std::string describe(const Orientation& orientation) {
  std::string text = counted(orientation.turnedTriangles, "triangle", "triangles") + " turned";
  const size_t nonOrientable = orientation.patches[size_t(Facing::nonOrientable)];
  if (nonOrientable > 0) text += "; " + counted(nonOrientable, "one-sided patch", "one-sided patches") + " can't be oriented";
  return text;
}

std::string headline(const MeshReport& mesh) {
  std::string text =
      mesh.input.name + ": " + std::to_string(mesh.info.vertices) + " vertices, " + std::to_string(mesh.info.triangles) + " triangles\n";
  if (mesh.input.orientation) text += "Oriented: " + describe(*mesh.input.orientation) + "\n";
  return text;
}

std::string triple(const double* v, const char* separator) {
  std::ostringstream out;
  out << v[0] << separator << v[1] << separator << v[2];
  return out.str();
}

std::string infoJson(const MeshReport& mesh) {
  Json json;
  addHead(json, {}, mesh);
  if (mesh.intersections) {
    addPairs(json, "intersections", mesh.intersections->counts);
    json.key("first");
    if (mesh.intersections->pairCount() > 0) {
      json.values(mesh.intersections->pairTriangles);
    } else {
      json.null();
    }
    json.close('}');
  } else {
    json.key("intersections").null();
  }
  addDefects(json, mesh);
  json.close('}');
  return json.text();
}

std::string infoText(const MeshReport& mesh) {
  const MeshInfo& info = mesh.info;
  std::ostringstream out;
  out << headline(mesh) << std::left;
  const auto line = [&](const char* label) -> std::ostream& { return out << "  " << std::setw(22) << label; };
  line("box") << '(' << triple(info.min.data(), ", ") << ") to (" << triple(info.max.data(), ", ") << ")\n";
  const char* const oriented = info.oriented ? "yes, consistently oriented" : "yes, but not consistently oriented";
  line("closed") << (info.closed ? oriented : "no") << "\n";
  for (const Count& count : meshCounts(info)) line(count.label) << count.value << "\n";
  if (info.components > 1) {
    const auto number = [](const std::vector<uint8_t>& flags) { return std::count(flags.begin(), flags.end(), 1); };
    line("  closed") << number(info.componentClosed) << "\n";
    line("  and oriented") << number(info.componentOriented) << "\n";
  }
  if (mesh.intersections) {
    const auto& [counts, triangles, kinds, offsets, points] = *mesh.intersections;
    line("intersecting pairs") << describePairs(counts);
    if (!kinds.empty()) out << "; first: triangles " << triangles[0] << " and " << triangles[1];
    out << "\n";
  }
  const TriangleGroups& groups = mesh.input.groups;
  if (!groups.empty()) line("groups") << groups.names.size() << "\n";
  for (const auto& [groupName, triangles] : groupCounts(groups)) line("  triangles") << triangles << "  " << groupName << "\n";
  addDefects(out, mesh);
  return out.str();
}

}  // namespace mandoline::cli
