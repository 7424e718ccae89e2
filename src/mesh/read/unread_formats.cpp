#include "mesh/read/unread_formats.h"

#include <algorithm>
#include <string>

#include "mesh/read/text_cursor.h"

namespace mandoline::detail {
namespace {

constexpr std::string_view kConvert = "convert it to one of them, for instance in Blender";
constexpr std::string_view kPrinting = "convert it to one of them, for instance in PrusaSlicer or MeshLab";
constexpr std::string_view kVtk = "convert its surface to one of them, for instance in ParaView";
constexpr std::string_view kGmsh = "convert its surface to one of them, for instance by gmsh in.msh -2 -o out.stl";
constexpr std::string_view kCad = "its surfaces have to be divided into triangles, for instance by FreeCAD or Gmsh, which write STL";

struct Known {
  UnreadFormat format;
  std::string_view begin;       ///< in lower case, after blanks; empty: not known by its content
  std::string_view extensions;  ///< each with its dot and a blank after it
};

constexpr Known kKnown[] = {
    {{"a glTF file", kConvert}, "gltf", ".glb .gltf "},
    {{"a glTF or other JSON file", kConvert}, "{", ""},
    {{"a COLLADA file", kConvert}, "", ".dae "},
    {{"an FBX file", kConvert}, "kaydara fbx", ".fbx "},
    {{"a Blender file", kConvert}, "blender", ".blend "},
    {{"a USD file", kConvert}, "pxr-usdc", ".usd .usda .usdc .usdz "},
    {{"a USD file", kConvert}, "#usda", ""},
    {{"a VRML file", kConvert}, "#vrml", ".wrl .vrml "},
    {{"an X3D file", kConvert}, "", ".x3d "},
    {{"a 3DS file", kConvert}, "", ".3ds "},
    {{"an Alembic file", kConvert}, "ogawa", ".abc "},
    {{"a VTK file", kVtk}, "# vtk datafile", ".vtk .vtp .vtu .vti .vtr .vts .vtm .pvtu .pvtp "},
    {{"a Gmsh file", kGmsh}, "$meshformat", ".msh "},
    {{"a STEP file", kCad}, "iso-10303-21", ".step .stp "},
    {{"an IGES file", kCad}, "", ".iges .igs "},
    {{"a BREP file", kCad}, "dbrep_drawable", ".brep "},
    {{"a DXF or DWG drawing", kCad}, "", ".dxf .dwg "},
    {{"an AMF file", kPrinting}, "", ".amf "},
    {{"a 3MF file", kPrinting}, "", ".3mf "},
};
constexpr UnreadFormat kZip = {"a ZIP archive", "unpack it first"};
constexpr UnreadFormat kWebPage = {"a web page", "it may tell why the file was not served"};
constexpr UnreadFormat kXml = {"an XML file", kConvert};

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// A ZIP archive, or a format that is one inside. Archives list their files at their end.
const UnreadFormat* unreadZip(std::string_view bytes) {
  const std::string_view list = bytes.substr(bytes.size() - std::min(bytes.size(), size_t(1) << 16));
  if (contains(list, "3dmodel.model")) return unreadByExtension(".3mf");
  return contains(list, ".usdc") || contains(list, ".usda") ? unreadByExtension(".usdz") : &kZip;
}

/// XML, by its elements; `text` is its beginning in lower case.
const UnreadFormat* unreadXml(std::string_view text) {
  if (text.starts_with("<!doctype html") || contains(text, "<html")) return &kWebPage;
  if (contains(text, "<vtkfile")) return unreadByExtension(".vtk");
  if (contains(text, "<collada")) return unreadByExtension(".dae");
  if (contains(text, "<x3d")) return unreadByExtension(".x3d");
  if (contains(text, "<amf")) return unreadByExtension(".amf");
  return text.starts_with("<?xml") ? &kXml : nullptr;
}

}  // namespace

const UnreadFormat* unreadByContent(std::string_view bytes) {
  if (bytes.starts_with("PK\x03\x04")) return unreadZip(bytes);
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);  // byte order mark
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  const std::string text = lowerCase(bytes.substr(0, 1000));
  for (const Known& known : kKnown) {
    if (!known.begin.empty() && text.starts_with(known.begin)) return &known.format;
  }
  return text.starts_with('<') ? unreadXml(text) : nullptr;
}

const UnreadFormat* unreadByExtension(std::string_view extension) {
  if (extension.empty()) return nullptr;
  const std::string word = std::string(extension) + ' ';
  for (const Known& known : kKnown) {
    if (contains(known.extensions, word)) return &known.format;
  }
  return extension == ".zip" ? &kZip : nullptr;
}

}  // namespace mandoline::detail
