// What functions of the library report: statuses, errors, progress.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

#include "mandoline/api.h"

namespace MANDOLINE_API mandoline {

enum class Status : uint8_t {
  ok,
  cancelled,            ///< the progress callback returned false
  emptyMesh,            ///< no triangles
  badArrays,            ///< an array's length is not a multiple of 3
  badIndex,             ///< element: the triangle that names a tri-vertex that does not exist
  nonFiniteCoordinate,  ///< element: the tri-vertex
  badGrid,              ///< no cells on an axis, planes not ascending or not finite; element: the axis
  gridTooLarge,         ///< more than 2^24 cells on an axis (element), or more than 2^28 rows of cells
  badOption,            ///< out of range: a snapTolerance outside [0, 0.5), a negative maxLevel or number of layers
  selfIntersection,     ///< element, element2: two triangles that meet other than in a shared vertex or edge
  meshTooLarge,         ///< 2^31 or more triangles, vertices or corners of faces, in the mesh or in the result
  outOfMemory,
  internalError,  ///< a fault of this library
  badArgument,    ///< an argument that the function can't take, e.g. a cell that does not exist (element) or the mesh of another cut
};

/// The status as the word above, e.g. "selfIntersection".
inline const char* name(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::cancelled:
      return "cancelled";
    case Status::emptyMesh:
      return "emptyMesh";
    case Status::badArrays:
      return "badArrays";
    case Status::badIndex:
      return "badIndex";
    case Status::nonFiniteCoordinate:
      return "nonFiniteCoordinate";
    case Status::badGrid:
      return "badGrid";
    case Status::gridTooLarge:
      return "gridTooLarge";
    case Status::badOption:
      return "badOption";
    case Status::selfIntersection:
      return "selfIntersection";
    case Status::meshTooLarge:
      return "meshTooLarge";
    case Status::outOfMemory:
      return "outOfMemory";
    case Status::internalError:
      return "internalError";
    case Status::badArgument:
      return "badArgument";
  }
  return "unknown";
}

struct Error {
  Status status = Status::ok;
  int64_t element = -1, element2 = -1;  ///< what they are depends on the status; -1 for none
  std::string message;                  ///< a full sentence that names the elements; empty if ok
};

/// Thrown by functions that can't do what they are asked to. cut(), prepare() and resolve() return an Error instead, and a file that can't
/// be used is a FileError. what() is the error's message.
struct CallError : std::runtime_error {
  explicit CallError(Error error_) : std::runtime_error(error_.message), error(std::move(error_)) {}

  Error error;
};

/// How far a call has come: `done` of `total` items of the stage, and the stage's place among all.
struct Progress {
  const char* stage;
  int stageIndex, stageCount;
  size_t done, total;

  static void fields(auto& self, const auto& f) {
    f("stage", self.stage);
    f("stageIndex", self.stageIndex);
    f("stageCount", self.stageCount);
    f("done", self.done);
    f("total", self.total);
  }
};

/// How a call that may take long is run.
struct RunOptions {
  /// Threads to use; 0 for all cores. The result is the same to the bit for any number.
  unsigned threads = 0;
  /// Called now and then, never from two threads at once; false cancels the call. What it throws passes through the call unchanged.
  std::function<bool(const Progress&)> progress;
};

}  // namespace mandoline
