#include "io/pvtu.h"

#include "io/vtu_file.h"

namespace mandoline::detail {
namespace {

std::string arrayXml(const char* type, const char* name, int components) {
  return std::string("<PDataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" + std::to_string(components) +
         "\"/>\n";
}

}  // namespace

std::string pvtuArrays(const CutMesh& piece, PieceCells kind) {
  std::string xml = "<PPoints>\n" + arrayXml(vtkTypeName(double()), "Points", 3) + "</PPoints>\n<PCellData>\n" +
                    arrayXml(vtkTypeName(int32_t()), "grid_cell", 3);
  if (kind == PieceCells::complex) xml += arrayXml(vtkTypeName(int32_t()), "level", 1);
  if (kind != PieceCells::brick) xml += arrayXml(vtkTypeName(int32_t()), "region", 1);
  forEachRegionArray(piece,
                     [&]<class Number>(const char* name, const std::vector<Number>&) { xml += arrayXml(vtkTypeName(Number()), name, 1); });
  return xml + arrayXml(vtkTypeName(double()), "volume", 1) + "</PCellData>\n";
}

std::string pvtuText(const std::string& arrays, const std::vector<std::string>& pieces) {
  std::string xml = vtkHead("PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n" + arrays;
  for (const std::string& piece : pieces) xml += "<Piece Source=\"" + piece + "\"/>\n";
  return xml + "</PUnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace mandoline::detail
