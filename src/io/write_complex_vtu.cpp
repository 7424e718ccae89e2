// Cell complexes as VTK XML unstructured grids: cells as polyhedra, or as hexahedra where these have the same faces; faces as polygons.
#include <cstring>
#include <set>

#include "base/sort.h"
#include "io/complex_polygons.h"
#include "io/groups.h"
#include "io/pvtu.h"
#include "io/selection.h"
#include "io/vtu_file.h"
#include "mesh/run_call.h"

namespace mandoline {
namespace detail {
namespace {

/// The numbers of components of fields. Throws CallError for one that does not fit.
std::vector<int> componentsOf(std::span<const Field> fields, size_t count, const char* element) {
  std::vector<int> components;
  for (const Field& field : fields) {
    const size_t each = count == 0 ? 1 : field.values.size() / count;
    if (each * count != field.values.size() || (each != 1 && each != 3)) {
      operators::refuse("The field " + field.name + " must have 1 or 3 numbers for each of the " + std::to_string(count) + ' ' + element +
                        '.');
    }
    components.push_back(int(each));
  }
  return components;
}

/// Throws CallError for a field whose name is missing, taken or not possible in XML.
template <class ForEachArray>
void requireNames(std::span<const Field> fields, const ForEachArray& forEachArray) {
  std::set<std::string_view> names;
  forEachArray([&](auto, std::string_view name, uint64_t, int, const auto&) { names.insert(name); });
  const auto isWrong = [](char c) { return (c >= 0 && c < ' ') || c == 0x7f || std::strchr("<>&\"", c); };
  for (const Field& field : fields) {
    if (field.name.empty()) operators::refuse("A field has no name.");
    if (std::any_of(field.name.begin(), field.name.end(), isWrong))
      operators::refuse("A field's name must be without control characters and any of < > & \".");
    if (!names.insert(field.name).second) operators::refuse("There are two arrays of the name " + field.name + ".");
  }
}

/// What both files have in common: the elements that are written, and the vertices that these use.
class ComplexWriter {
 public:
  ComplexWriter(Meter& meter, const CutMesh& cutMesh, const CellComplex& cells, const WriteOptions& options)
      : meter_(meter), cutMesh_(cutMesh), cells_(cells), options_(options), polygons_(cutMesh, cells) {}

 protected:
  bool hasCell(int64_t c) const {
    return c >= 0 && (options_.untouched || c < cells_.cutCells) && options_.hasRegion(cells_.cellRegion[size_t(c)]);
  }
  void use(uint32_t vertex) {
    if (numbers_.empty()) numbers_.resize(cells_.vertexCount(), kUnused);
    numbers_[vertex] = 0;
  }
  void numberPoints() {
    for (uint32_t& number : numbers_) {
      if (number != kUnused) number = uint32_t(points_++);
    }
  }
  template <class Put>
  void putPoints(const Put& put) const {
    for (size_t v = 0; v < numbers_.size(); ++v) {
      if (numbers_[v] == kUnused) continue;
      for (size_t d = 0; d < 3; ++d) put(cells_.positions[3 * v + d]);
    }
  }
  template <class Visit>
  void forEachField(std::span<const Field> fields, const std::vector<int>& components, const Visit& visit) const {
    for (size_t i = 0; i < fields.size(); ++i) {
      const size_t each = size_t(components[i]);
      visit(double(), fields[i].name, written_.size(), components[i], [&](const auto& put) {
        for (const uint32_t e : written_) {
          for (size_t k = 0; k < each; ++k) put(fields[i].values[each * e + k]);
        }
      });
    }
  }

  static constexpr uint32_t kUnused = ~0u;
  Meter& meter_;
  const CutMesh& cutMesh_;
  const CellComplex& cells_;
  const WriteOptions& options_;
  ComplexPolygons polygons_;
  std::vector<uint32_t> written_;  // cells; or per polygon, its face
  std::vector<uint32_t> numbers_;  // per vertex: that in the file
  uint64_t points_ = 0;
};

class CellWriter : ComplexWriter {
 public:
  using ComplexWriter::ComplexWriter;

  void write(std::span<const Field> fields, FunctionRef<bool(size_t cell)> isOwn) {
    const std::vector<int> components = componentsOf(fields, cells_.cellCount(), "cells");
    count(isOwn);
    requireNames(fields, [&](const auto& visit) { forEachArray(visit); });
    VtuFile(meter_, points_, written_.size(), "grid_cell").write(1, [&](const auto& visit) {
      forEachArray(visit);
      forEachField(fields, components, visit);
    });
  }

 private:
  void count(FunctionRef<bool(size_t cell)> isOwn) {
    meter_.beginStage("count", 0, cells_.cellCount());
    offsets_.push_back(0);
    faceOffsets_.push_back(0);
    for (uint32_t c = 0; c < cells_.cellCount(); ++c) {
      meter_.advance();
      if (c % 4096 == 0) meter_.report();
      if (!hasCell(c) || !isOwn(c)) continue;
      written_.push_back(c);
      isHexahedron_.push_back(findCorners(c));
      uint64_t size = 1;
      forEachPolygon(c, [&](std::span<const uint32_t> polygon, bool) {
        size += 1 + polygon.size();
        for (const uint32_t v : polygon) use(v);
      });
      faceOffsets_.push_back(faceOffsets_.back() + (isHexahedron_.back() ? 0 : size));
      offsets_.push_back(offsets_.back() + verticesOf(c).size());
    }
    numberPoints();
  }

  template <class Visit>
  void forEachPolygon(uint32_t c, const Visit& visit) const {
    for (const uint32_t h : cells_.halfFaces(c)) {
      if (options_.simpleCells && cells_.faceCells[h] == cells_.faceCells[h ^ 1]) continue;
      polygons_.forEach(h / 2, [&](std::span<const uint32_t> polygon) { visit(polygon, h % 2 != 0); });
    }
  }

  /// Whether the cell is an untouched grid cell or an octree cell whose faces are its six sides; then corners_ are its vertices in VTK's
  /// order.
  bool findCorners(uint32_t c) {
    constexpr std::array<uint8_t, 8> kPlaces = {0, 1, 3, 2, 4, 5, 7, 6};  // of x, y, z above the centre as bits
    if (c < cells_.cutCells || cells_.halfFaces(c).size() != 6) return false;
    corners_.fill(kUnused);
    bool isBox = true;
    forEachPolygon(c, [&](std::span<const uint32_t> polygon, bool) {
      isBox &= polygon.size() == 4;
      for (const uint32_t v : polygon) {
        size_t above = 0;
        for (size_t d = 0; d < 3; ++d) above |= size_t(cells_.positions[3 * size_t(v) + d] > cells_.cellCentre[3 * size_t(c) + d]) << d;
        uint32_t& corner = corners_[kPlaces[above]];
        isBox &= corner == kUnused || corner == v;
        corner = v;
      }
    });
    return isBox && std::find(corners_.begin(), corners_.end(), kUnused) == corners_.end();
  }

  /// Each once, until the next call.
  const std::vector<uint32_t>& verticesOf(uint32_t c) {
    vertices_.clear();
    forEachPolygon(c, [&](std::span<const uint32_t> polygon, bool) { vertices_.insert(vertices_.end(), polygon.begin(), polygon.end()); });
    sortUnique(vertices_);
    return vertices_;
  }

  template <class Visit>
  void forEachArray(const Visit& visit) {
    const uint64_t n = written_.size();
    const auto perCell = [&](const auto& value) {
      return [this, value](const auto& put) {
        for (const uint32_t c : written_) value(c, put);
      };
    };
    visit(double(), "Points", points_, 3, [&](const auto& put) { putPoints(put); });
    visit(int64_t(), "connectivity", offsets_.back(), 1, [&](const auto& put) {
      for (size_t i = 0; i < n; ++i) putVertices(i, put);
    });
    visit(int64_t(), "offsets", n, 1, [&](const auto& put) { std::for_each(offsets_.begin() + 1, offsets_.end(), put); });
    visit(uint8_t(), "types", n, 1, [&](const auto& put) {
      for (const bool isHexahedron : isHexahedron_) put(isHexahedron ? kVtkHexahedron : kVtkPolyhedron);
    });
    if (faceOffsets_.back() > 0) {
      visit(int64_t(), "faces", faceOffsets_.back(), 1, [&](const auto& put) {
        for (size_t i = 0; i < n; ++i) {
          if (!isHexahedron_[i]) putPolyhedron(written_[i], put);
        }
      });
      visit(int64_t(), "faceoffsets", n, 1, [&](const auto& put) {
        for (size_t i = 0; i < n; ++i) put(isHexahedron_[i] ? -1 : int64_t(faceOffsets_[i + 1]));
      });
    }
    visit(int32_t(), "grid_cell", n, 3, perCell([this](uint32_t c, const auto& put) {
            for (size_t d = 0; d < 3; ++d) put(cells_.cellCorner[3 * size_t(c) + d]);
          }));
    visit(int32_t(), "level", n, 1, perCell([this](uint32_t c, const auto& put) { put(cells_.cellLevel[c]); }));
    visit(int32_t(), "region", n, 1, perCell([this](uint32_t c, const auto& put) { put(cells_.cellRegion[c]); }));
    forEachRegionArray(cutMesh_, [&]<class Number>(const char* name, const std::vector<Number>& numbers) {
      visit(Number(), name, n, 1, perCell([&](uint32_t c, const auto& put) { put(numbers[cells_.cellRegion[c]]); }));
    });
    visit(double(), "volume", n, 1, perCell([this](uint32_t c, const auto& put) { put(cells_.cellVolume[c]); }));
  }

  template <class Put>
  void putVertices(size_t i, const Put& put) {
    const uint32_t c = written_[i];
    if (isHexahedron_[i]) {
      findCorners(c);
      for (const uint32_t v : corners_) put(numbers_[v]);
    } else {
      for (const uint32_t v : verticesOf(c)) put(numbers_[v]);
    }
  }

  template <class Put>
  void putPolyhedron(uint32_t c, const Put& put) const {
    size_t count = 0;
    forEachPolygon(c, [&](std::span<const uint32_t>, bool) { ++count; });
    put(count);
    forEachPolygon(c, [&](std::span<const uint32_t> polygon, bool reversed) {
      put(polygon.size());
      for (size_t i = 0; i < polygon.size(); ++i) put(numbers_[polygon[reversed ? polygon.size() - 1 - i : i]]);
    });
  }

  std::vector<uint64_t> offsets_, faceOffsets_;  // per cell written
  std::vector<bool> isHexahedron_;               // the same
  std::vector<uint32_t> vertices_;
  std::array<uint32_t, 8> corners_{};
};

class FaceWriter : ComplexWriter {
 public:
  using ComplexWriter::ComplexWriter;

  void write(std::span<const Field> fields) {
    const std::vector<int> components = componentsOf(fields, cells_.faceCount(), "faces");
    groups_ = checkedGroups(options_.groups, cutMesh_.triangleCount);
    const std::string names = groups_ ? vtkStrings("group_names", groups_->names) : "";
    count();
    requireNames(fields, [&](const auto& visit) { forEachArray(visit); });
    VtuFile(meter_, points_, written_.size(), "face", names).write(1, [&](const auto& visit) {
      forEachArray(visit);
      forEachField(fields, components, visit);
    });
  }

 private:
  void count() {
    meter_.beginStage("count", 0, cells_.faceCount());
    for (uint32_t f = 0; f < cells_.faceCount(); ++f) {
      meter_.advance();
      if (f % 4096 == 0) meter_.report();
      if (!hasCell(cells_.faceCells[2 * size_t(f)]) && !hasCell(cells_.faceCells[2 * size_t(f) + 1])) continue;
      polygons_.forEach(f, [&](std::span<const uint32_t> polygon) {
        written_.push_back(f);
        offsets_.push_back((offsets_.empty() ? 0 : offsets_.back()) + polygon.size());
        for (const uint32_t v : polygon) use(v);
      });
    }
    numberPoints();
  }

  int32_t triangleOf(uint32_t face) const { return detail::triangleOf(cutMesh_, cells_, face); }

  /// Fills an array with a value for each polygon, from its face.
  template <class Value>
  auto perPolygon(const Value& value) const {
    return [this, value](const auto& put) {
      for (const uint32_t f : written_) put(value(f));
    };
  }

  template <class Visit>
  void forEachArray(const Visit& visit) const {
    const uint64_t n = written_.size();
    visit(double(), "Points", points_, 3, [&](const auto& put) { putPoints(put); });
    visit(int64_t(), "connectivity", offsets_.empty() ? 0 : offsets_.back(), 1, [&](const auto& put) { putPolygons(put); });
    visit(int64_t(), "offsets", n, 1, [&](const auto& put) { std::for_each(offsets_.begin(), offsets_.end(), put); });
    visit(uint8_t(), "types", n, 1, perPolygon([](uint32_t) { return kVtkPolygon; }));
    visit(int32_t(), "face", n, 1, perPolygon([](uint32_t f) { return f; }));
    visit(int32_t(), "tag", n, 1, perPolygon([this](uint32_t f) { return int32_t(cells_.faceTag[f]); }));
    visit(int32_t(), "triangle", n, 1, perPolygon([this](uint32_t f) { return triangleOf(f); }));
    visit(int32_t(), "cells", n, 2, [&](const auto& put) {
      for (const uint32_t f : written_) {
        put(cells_.faceCells[2 * size_t(f)]);
        put(cells_.faceCells[2 * size_t(f) + 1]);
      }
    });
    if (groups_) visit(int32_t(), "group", n, 1, perPolygon([this](uint32_t f) { return groups_->of(triangleOf(f)); }));
  }

  template <class Put>
  void putPolygons(const Put& put) const {
    for (size_t i = 0; i < written_.size(); ++i) {
      if (i > 0 && written_[i] == written_[i - 1]) continue;  // all polygons of a face at once
      polygons_.forEach(written_[i], [&](std::span<const uint32_t> polygon) {
        for (const uint32_t v : polygon) put(numbers_[v]);
      });
    }
  }

  const TriangleGroups* groups_ = nullptr;
  std::vector<uint64_t> offsets_;  // per polygon
};

}  // namespace

void writeVtuPiece(const Sink& sink, const CutMesh& cutMesh, const CellComplex& cells, FunctionRef<bool(size_t cell)> isOwn,
                   const WriteOptions& options) {
  const Selection selection(cutMesh, options);
  runCall("writing", [&] {
    Meter meter(sink, options, 2);
    CellWriter(meter, cutMesh, cells, options).write({}, isOwn);
  });
}

}  // namespace detail

void writeVtu(const Sink& sink, const CutMesh& cutMesh, const CellComplex& cells, std::span<const Field> fields,
              const WriteOptions& options) {
  const detail::Selection selection(cutMesh, options);
  detail::runCall("writing", [&] {
    detail::Meter meter(sink, options, 2);
    detail::CellWriter(meter, cutMesh, cells, options).write(fields, [](size_t) { return true; });
  });
}

void writeFacesVtu(const Sink& sink, const CutMesh& cutMesh, const CellComplex& cells, std::span<const Field> fields,
                   const WriteOptions& options) {
  const detail::Selection selection(cutMesh, options);
  detail::runCall("writing", [&] {
    detail::Meter meter(sink, options, 2);
    detail::FaceWriter(meter, cutMesh, cells, options).write(fields);
  });
}

}  // namespace mandoline
