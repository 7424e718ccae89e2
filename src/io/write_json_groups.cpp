// The JSON dump with groups: the dump without them, whose end is held back until two more arrays are written.
#include "io/groups.h"
#include "io/json_members.h"
#include "mesh/run_call.h"

namespace mandoline {
namespace detail {
namespace {

/// The bytes of the string are taken as UTF-8.
void putString(OutputBuffer& out, std::string_view string) {
  constexpr std::string_view kHex = "0123456789abcdef";
  out.character('"');
  for (const char c : string) {
    if (c >= 0 && c < ' ') {
      out.text("\\u00");
      out.character(kHex[size_t(c) / 16]);
      out.character(kHex[size_t(c) % 16]);
      continue;
    }
    if (c == '"' || c == '\\') out.character('\\');
    out.character(c);
  }
  out.character('"');
}

}  // namespace

void writeGroups(OutputBuffer& out, const TriangleGroups& groups) {
  out.text(",\n\"groupNames\":");
  for (size_t g = 0; g < groups.names.size(); ++g) {
    out.character(g == 0 ? '[' : ',');
    putString(out, groups.names[g]);
  }
  out.character(']');
  writeMember(out, "triangleGroup", groups.triangleGroup);
}

}  // namespace detail

void writeJson(const Sink& sink, const CutMesh& cutMesh, const TriangleGroups& groups, const RunOptions& options) {
  if (!detail::checkedGroups(&groups, cutMesh.triangleCount)) return writeJson(sink, cutMesh, options);
  constexpr std::string_view kEnd = "}\n";
  std::string heldBack;
  const Sink holding = [&](std::string_view piece) {
    heldBack += piece;
    if (heldBack.size() <= kEnd.size()) return;
    sink(std::string_view(heldBack).substr(0, heldBack.size() - kEnd.size()));
    heldBack.erase(0, heldBack.size() - kEnd.size());
  };
  writeJson(holding, cutMesh, options);
  detail::runCall("writing", [&] {
    detail::Meter meter(sink, RunOptions{});
    detail::OutputBuffer out(meter);
    detail::writeGroups(out, groups);
    out.text(kEnd);
    out.flush();
  });
}

}  // namespace mandoline
