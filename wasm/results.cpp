#include "results.h"

namespace mandoline::wasm {

std::function<bool(const Progress&)> progressOf(const val& options) {
  const val callback = options["progress"];
  if (callback.isUndefined()) return {};
  return [callback](const Progress& progress) { return callback(toObject(progress)).as<bool>(); };
}

std::function<bool(const Progress&)> progressBetween(const val& options, size_t before, int after) {
  const auto tell = progressOf(options);
  if (!tell) return {};
  return [=](Progress progress) {
    progress.stageIndex += int(before);
    progress.stageCount += int(before) + after;
    return tell(progress);
  };
}

RunOptions runOptions(const val& options) {
  RunOptions result;
  result.progress = progressOf(options);
  return result;
}

void ObjectWriter::set(const char* key, const val& value) const { object_.set(key, value); }

void ObjectWriter::setNumber(const char* key, double value) const { set(key, val(value)); }

void ObjectWriter::setText(const char* key, const std::string& value) const { set(key, val(value)); }

void ObjectWriter::setArray(const char* key, const char* type, const void* numbers, size_t count) const {
  set(key, toArray(type, numbers, count, copy_));
}

template <>
val toObject(const Grid& grid) {
  val planes = val::array();
  for (int d = 0; d < 3; ++d) planes.set(d, toArray(grid.planes[d]));
  return object({{"origin", toTriple(grid.origin)},
                 {"spacing", grid.uniform ? toTriple(grid.spacing) : val::null()},
                 {"cells", toTriple(std::array<int64_t, 3>{grid.cells(0), grid.cells(1), grid.cells(2)})},
                 {"planes", planes}});
}

template <>
val toObject(const Fingerprint& fingerprint) {
  return val(fingerprint.text());
}

template <>
void read(const val& text, Fingerprint& fingerprint) {
  fingerprint.value = std::stoull(text.as<std::string>(), nullptr, 16);
}

template <>
void read(const val& object, Grid& grid) {
  std::array<std::vector<double>, 3> planes;
  for (int d = 0; d < 3; ++d) readArray(object["planes"][d], planes[d]);
  grid = Grid::rectilinear(std::move(planes));
  if (object["spacing"].isNull()) return;
  grid.uniform = true;
  grid.origin = readTriple<double>(object["origin"]);
  grid.spacing = readTriple<double>(object["spacing"]);
}

}  // namespace mandoline::wasm
