// VTK XML unstructured grids, with the arrays appended as raw bytes (which VTK, ParaView and meshio read): one array after the other, each
// with its size before it.
#pragma once

#include "io/output_buffer.h"
#include "mandoline/cut_mesh.h"
#include "mesh/read/scalar.h"

namespace mandoline::detail {

inline constexpr uint8_t kVtkPolygon = 7, kVtkHexahedron = 12, kVtkPolyhedron = 42;  // VTK's cell types

/// Numbers as bytes for a file, gathered in a buffer. flush() has to be called at the end.
template <class Scalar>
class ArrayBuffer {
 public:
  explicit ArrayBuffer(Meter& meter) : meter_(meter) { buffer_.reserve(kCapacity); }

  void put(Scalar value) {
    buffer_.push_back(value);
    if (buffer_.size() == kCapacity) flush();
  }
  void flush() {
    meter_.advance(buffer_.size() * sizeof(Scalar));
    meter_.write({reinterpret_cast<const char*>(buffer_.data()), buffer_.size() * sizeof(Scalar)});
    buffer_.clear();
  }

 private:
  static constexpr size_t kCapacity = size_t(1) << 15;
  Meter& meter_;
  std::vector<Scalar> buffer_;
};

inline const char* vtkTypeName(double) { return "Float64"; }
inline const char* vtkTypeName(int64_t) { return "Int64"; }
inline const char* vtkTypeName(int32_t) { return "Int32"; }
inline const char* vtkTypeName(uint8_t) { return "UInt8"; }

/// Calls f(name, numbers) for each array of regions about inside that the cut-mesh has.
template <class F>
void forEachRegionArray(const CutMesh& cutMesh, const F& f) {
  const auto visit = [&](const char* name, const auto& numbers) {
    if (!numbers.empty()) f(name, numbers);
  };
  visit("winding", cutMesh.regionWinding);
  visit("part_winding", cutMesh.regionPartWinding);
  visit("parity", cutMesh.regionParity);
  visit("insideness", cutMesh.regionInsideness);
}

/// What a file of VTK's begins with.
std::string vtkHead(std::string_view type);

/// An array of strings about the whole, as XML.
std::string vtkStrings(std::string_view name, std::span<const std::string> strings);

/// Writes the file. `forEachArray(visit)` calls visit(a number of the array's type, name, count, components, fill) for the arrays, whose
/// names are VTK's: Points; connectivity, offsets, types and perhaps faces and faceoffsets; then those of the cells. fill(put) puts the
/// numbers. Every array is walked through twice, once for nothing but its size.
class VtuFile {
 public:
  /// `firstOfCells` is the name of the first array of the cells; `fieldData` comes from vtkStrings().
  VtuFile(Meter& meter, uint64_t points, uint64_t cells, std::string_view firstOfCells, std::string_view fieldData = {})
      : meter_(meter), points_(points), cells_(cells), firstOfCells_(firstOfCells), fieldData_(fieldData) {}

  template <class ForEachArray>
  void write(int stage, const ForEachArray& forEachArray) {
    uint64_t total = 0;
    forEachArray([&](auto scalar, std::string_view, uint64_t count, int components, const auto&) {
      total += count * uint64_t(components) * sizeof scalar;
    });
    meter_.beginStage("write", stage, total);
    writeHead(forEachArray);
    forEachArray([&](auto scalar, std::string_view, uint64_t count, int components, const auto& fill) {
      using Scalar = decltype(scalar);
      const uint64_t size = count * uint64_t(components) * sizeof(Scalar);
      meter_.write({reinterpret_cast<const char*>(&size), sizeof size});
      ArrayBuffer<Scalar> buffer(meter_);
      fill([&](auto value) { buffer.put(Scalar(value)); });
      buffer.flush();
    });
    meter_.write("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  template <class ForEachArray>
  void writeHead(const ForEachArray& forEachArray) {
    OutputBuffer out(meter_);
    beginHead(out);
    uint64_t offset = 0;
    forEachArray([&](auto scalar, std::string_view name, uint64_t count, int components, const auto&) {
      describe(out, {vtkTypeName(scalar), name, components, offset});
      offset += sizeof(uint64_t) + count * uint64_t(components) * sizeof scalar;
    });
    out.text("</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    out.flush();
  }

  struct ArrayHead {
    std::string_view type, name;
    int components;
    uint64_t offset;
  };
  void beginHead(OutputBuffer& out) const;
  void describe(OutputBuffer& out, const ArrayHead& array) const;

  Meter& meter_;
  uint64_t points_, cells_;
  std::string_view firstOfCells_, fieldData_;
};

}  // namespace mandoline::detail
