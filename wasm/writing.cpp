#include "writing.h"

namespace mandoline::wasm {

void FileBytes::add(std::string_view piece) {
  pieces_.call<void>("push", toArray(arrayType<char>(), piece.data(), piece.size()));
  size_ += double(piece.size());
}

val FileBytes::joined() const {
  const val result = val::global(arrayType<char>()).new_(size_);
  double end = 0;
  for (const val& piece : emscripten::vecFromJSArray<val>(pieces_)) {
    result.call<void>("set", piece, end);
    end += piece["length"].as<double>();
  }
  return result;
}

Writing::Writing(const val& options) {
  given.progress = progressOf(options);
  given.untouched = !options["untouched"].isFalse();
  given.simpleCells = options["simpleCells"].isTrue();
  if (!options["regions"].isUndefined()) readArray(options["regions"], given.regions);
  if (options["groups"].isUndefined()) return;
  groups = fromObject<TriangleGroups>(options["groups"]);
  given.groups = &groups;
}

}  // namespace mandoline::wasm
