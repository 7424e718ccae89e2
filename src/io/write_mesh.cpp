// Triangle meshes: OBJ and OFF as text, STL and PLY as binary. The cut surface as STL and PLY is one, too.

#include "io/groups.h"
#include "io/output_buffer.h"
#include "io/surface.h"
#include "mesh/read/scalar.h"
#include "mesh/require_arrays.h"
#include "mesh/run_call.h"
#include "operators/measure/vector.h"

namespace mandoline {
namespace detail {
namespace {

/// Little-endian on every machine.
template <class Scalar>
void putScalar(OutputBuffer& out, Scalar value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  if (kNativeOrder == ByteOrder::big) std::reverse(bytes, bytes + sizeof value);
  out.text({bytes, sizeof value});
}

template <class Number>
void putLine(OutputBuffer& out, std::string_view keyword, std::span<const Number> numbers, Number add = 0) {
  out.text(keyword);
  for (const Number n : numbers) {
    out.character(' ');
    out.number(n + add);
  }
  out.character('\n');
}

void putObj(OutputBuffer& out, const MeshView& mesh, const TriangleGroups* groups) {
  for (size_t v = 0; v < mesh.vertexCount(); ++v) putLine(out, "v", mesh.positions.subspan(3 * v, 3));
  const std::vector<std::string> names = groups ? objNames(groups->names) : std::vector<std::string>();
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (groups && (t == 0 || groups->triangleGroup[t] != groups->triangleGroup[t - 1])) {
      out.text("g ");
      out.text(names[groups->triangleGroup[t]]);
      out.character('\n');
    }
    putLine(out, "f", mesh.triangles.subspan(3 * t, 3), 1u);
    out.advance();
  }
}

void putOff(OutputBuffer& out, const MeshView& mesh) {
  const std::array<size_t, 3> counts = {mesh.vertexCount(), mesh.triangleCount(), 0};
  putLine(out, "OFF\n", std::span<const size_t>(counts));
  for (size_t v = 0; v < mesh.vertexCount(); ++v) putLine(out, "", mesh.positions.subspan(3 * v, 3));
  for (size_t t = 0; t < mesh.triangleCount(); ++t) putLine(out, "3", mesh.triangles.subspan(3 * t, 3)), out.advance();
}

std::array<float, 3> unitNormal(const std::array<const double*, 3>& corners) {
  measuring::Vector<double> a, b;
  for (size_t d = 0; d < 3; ++d) {
    a[d] = corners[1][d] - corners[0][d];
    b[d] = corners[2][d] - corners[0][d];
  }
  const auto n = measuring::cross(a, b);
  const double length = measuring::length(n);
  if (!(length > 0)) return {0, 0, 0};
  return {float(n[0] / length), float(n[1] / length), float(n[2] / length)};
}

void putStl(OutputBuffer& out, const MeshView& mesh) {
  std::string header = "mandoline";
  header.resize(80, ' ');
  out.text(header);
  putScalar(out, uint32_t(mesh.triangleCount()));
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    std::array<const double*, 3> corners;
    for (size_t i = 0; i < 3; ++i) corners[i] = mesh.positions.data() + 3 * size_t(mesh.triangles[3 * t + i]);
    for (const float n : unitNormal(corners)) putScalar(out, n);
    for (const double* corner : corners) {
      for (size_t d = 0; d < 3; ++d) putScalar(out, float(corner[d]));
    }
    putScalar(out, uint16_t(0));
    out.advance();
  }
}

/// A number for each triangle, by a name.
struct Property {
  const char* name;
  std::span<const uint32_t> values;
};

void putPly(OutputBuffer& out, const MeshView& mesh, std::span<const Property> properties) {
  out.text("ply\nformat binary_little_endian 1.0\nelement vertex ");
  out.number(mesh.vertexCount());
  out.text("\nproperty double x\nproperty double y\nproperty double z\nelement face ");
  out.number(mesh.triangleCount());
  out.text("\nproperty list uchar uint vertex_indices\n");
  for (const Property& property : properties) {
    out.text("property uint ");
    out.text(property.name);
    out.character('\n');
  }
  out.text("end_header\n");
  for (const double x : mesh.positions) putScalar(out, x);
  for (size_t t = 0; t < mesh.triangleCount(); ++t) {
    putScalar(out, uint8_t(3));
    for (const uint32_t v : mesh.triangles.subspan(3 * t, 3)) putScalar(out, v);
    for (const Property& property : properties) putScalar(out, property.values[t]);
    out.advance();
  }
}

void putMesh(OutputBuffer& out, FileFormat format, const MeshView& mesh, const TriangleGroups* groups) {
  switch (format) {
    case FileFormat::obj:
      return putObj(out, mesh, groups);
    case FileFormat::off:
      return putOff(out, mesh);
    case FileFormat::stl:
      return putStl(out, mesh);
    case FileFormat::ply:
      return putPly(out, mesh, {});
    default:
      throw FileError(std::string("meshes can't be written as .") + name(format));
  }
}

/// Calls put(OutputBuffer) for a mesh; the items of progress are its triangles.
template <class Put>
void writeTriangles(const Sink& sink, const RunOptions& options, const MeshView& mesh, const Put& put) {
  Meter meter(sink, options);
  meter.beginStage("write", 0, mesh.triangleCount());
  OutputBuffer out(meter);
  put(out);
  out.flush();
}

}  // namespace
}  // namespace detail

void writeMesh(const Sink& sink, FileFormat format, const MeshView& mesh, const RunOptions& options, const TriangleGroups* groups) {
  detail::requireArrays(mesh);
  const TriangleGroups* const checked = detail::checkedGroups(groups, mesh.triangleCount());
  detail::runCall("writing", [&] {
    detail::writeTriangles(sink, options, mesh, [&](detail::OutputBuffer& out) { detail::putMesh(out, format, mesh, checked); });
  });
}

void writeStl(const Sink& sink, const CutMesh& cutMesh, const WriteOptions& options) {
  const Mesh surface = detail::triangulateSurface({cutMesh, options}).mesh;
  writeMesh(sink, FileFormat::stl, surface, options);
}

void writePly(const Sink& sink, const CutMesh& cutMesh, const WriteOptions& options) {
  const detail::SurfaceTriangles surface = detail::triangulateSurface({cutMesh, options});
  std::vector<detail::Property> properties = {{"region", surface.region}};
  std::vector<uint32_t> group;
  if (const TriangleGroups* groups = detail::checkedGroups(options.groups, cutMesh.triangleCount)) {
    for (const uint32_t f : surface.face) group.push_back(uint32_t(groups->of(cutMesh.faceTriangle[f])));
    properties.push_back({"group", group});
  }
  detail::runCall("writing", [&] {
    detail::writeTriangles(sink, options, surface.mesh, [&](detail::OutputBuffer& out) { detail::putPly(out, surface.mesh, properties); });
  });
}

}  // namespace mandoline
