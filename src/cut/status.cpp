#include "mandoline/status.h"

namespace mandoline {

const char* name(Status status) {
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

}  // namespace mandoline
