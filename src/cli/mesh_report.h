// What the reports of all commands tell of the mesh, and the report of info; as JSON for programs and as text for people.
#pragma once

#include <optional>
#include <string>

#include "cli/input.h"
#include "cli/json.h"
#include "mandoline/inspect.h"
#include "mandoline/intersections.h"
#include "mandoline/orient.h"
#include "mandoline/status.h"

namespace mandoline::cli {

/// A number to report.
struct Count {
  const char* key;
  const char* label;
  uint64_t value;
};

/// For example "1 edge" and "2 edges".
std::string counted(uint64_t count, const char* one, const char* many);

struct MeshReport {
  const Input& input;
  MeshInfo info;
  /// Of info, with one pair; none for meshes that can't be searched.
  std::optional<MeshIntersections> intersections;
};

/// How a command has gone.
struct Outcome {
  std::string status = "ok", message;
  int64_t element = -1, element2 = -1;

  Outcome() = default;
  Outcome(const std::string& status_, const std::string& message_) : status(status_), message(message_) {}
  Outcome(const Error& error) : status(name(error.status)), message(error.message), element(error.element), element2(error.element2) {}
};

// What every report begins with, in an object that is left open.
/// status, message, element, element2 and path.
void addHead(Json& json, const Outcome& outcome, const std::string& path);
/// The same and mesh.
void addHead(Json& json, const Outcome& outcome, const MeshReport& mesh);

/// How many pairs of triangles meet, by kind, in an object that is left open.
void addPairs(Json& json, const char* key, const PairCounts& pairs);
std::vector<Count> pairCounts(const PairCounts& pairs);
/// For example "10 crossing, 2 touching".
std::string describePairs(const PairCounts& pairs);

/// For example "3 triangles turned".
std::string describe(const Orientation& orientation);

/// The mesh and its size; on another line what --orient has done, if it was asked for.
std::string headline(const MeshReport& mesh);
std::string triple(const double* v, const char* separator);

std::string infoJson(const MeshReport& mesh);
std::string infoText(const MeshReport& mesh);

}  // namespace mandoline::cli
