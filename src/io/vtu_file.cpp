#include "io/vtu_file.h"

namespace mandoline::detail {

std::string vtkStrings(std::string_view name, std::span<const std::string> strings) {
  std::string xml = "<FieldData>\n<Array type=\"String\" Name=\"" + std::string(name) + "\" NumberOfTuples=\"" +
                    std::to_string(strings.size()) + "\" format=\"ascii\">\n";
  for (const std::string& string : strings) {
    for (const char c : string) xml += std::to_string(int(static_cast<unsigned char>(c))) + ' ';
    xml += "0\n";  // ends each
  }
  return xml + "</Array>\n</FieldData>\n";
}

std::string vtkHead(std::string_view type) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + std::string(type) + "\" version=\"1.0\" byte_order=\"" +
         (kNativeOrder == ByteOrder::little ? "LittleEndian" : "BigEndian") + "\" header_type=\"UInt64\">\n";
}

void VtuFile::beginHead(OutputBuffer& out) const {
  out.text(vtkHead("UnstructuredGrid"));
  out.text("<UnstructuredGrid>\n");
  out.text(fieldData_);
  out.text("<Piece NumberOfPoints=\"");
  out.number(points_);
  out.text("\" NumberOfCells=\"");
  out.number(cells_);
  out.text("\">\n<Points>\n");
}

void VtuFile::describe(OutputBuffer& out, const ArrayHead& array) const {
  if (array.name == "connectivity") out.text("</Points>\n<Cells>\n");
  if (array.name == firstOfCells_) out.text("</Cells>\n<CellData>\n");
  out.text("<DataArray type=\"");
  out.text(array.type);
  out.text("\" Name=\"");
  out.text(array.name);
  out.text("\" NumberOfComponents=\"");
  out.number(array.components);
  out.text("\" format=\"appended\" offset=\"");
  out.number(array.offset);
  out.text("\"/>\n");
}

}  // namespace mandoline::detail
