#include "operators/join/join_cells.h"

#include "base/sort.h"
#include "cut/append.h"

namespace mandoline::operators {
namespace {

constexpr uint32_t kNone = ~0u;

/// A face or vertex of one of several pieces.
struct PlaceOf {
  uint64_t id;
  uint32_t piece, item;

  bool operator<(const PlaceOf& other) const { return id < other.id; }
  bool operator==(const PlaceOf& other) const { return id == other.id; }
};

/// Faces or vertices of several pieces, each under one number.
class Numbering {
 public:
  void use(uint32_t piece, uint32_t item) { numbers_[piece][item] = 0; }
  void addPiece(size_t items) { numbers_.emplace_back(items, kNone); }
  uint32_t operator()(uint32_t piece, uint32_t item) const { return numbers_[piece][item]; }

  /// Numbers those that are used in the order of their ids. `idsOf(piece)`: the ids of its items.
  template <class IdsOf>
  std::vector<PlaceOf> number(const IdsOf& idsOf) {
    std::vector<PlaceOf> all;
    for (uint32_t i = 0; i < numbers_.size(); ++i) {
      for (uint32_t item = 0; item < numbers_[i].size(); ++item) {
        if (numbers_[i][item] != kNone) all.push_back({idsOf(i)[item], i, item});
      }
    }
    detail::sortItems(all);
    std::vector<PlaceOf> once;
    for (const PlaceOf& place : all) {
      if (once.empty() || once.back().id != place.id) once.push_back(place);
      numbers_[place.piece][place.item] = uint32_t(once.size() - 1);
    }
    return once;
  }

 private:
  std::vector<std::vector<uint32_t>> numbers_;  // per piece and item
};

class Joiner {
 public:
  explicit Joiner(std::span<const PieceCells> cells) : cells_(cells) {}

  RankPiece run() {
    takeFaces();
    takeVertices();
    takeCells();
    return std::move(result_);
  }

 private:
  const RankPiece& piece(uint32_t i) const { return cells_[i].piece; }

  void takeFaces() {
    for (uint32_t i = 0; i < cells_.size(); ++i) {
      faces_.addPiece(piece(i).faceIds.size());
      vertices_.addPiece(piece(i).vertexIds.size());
      for (size_t c = cells_[i].range.begin; c < cells_[i].range.end; ++c) {
        for (const uint32_t h : piece(i).cutMesh.halfFaces(c)) faces_.use(i, h / 2);
      }
    }
    places_ = faces_.number([&](uint32_t i) -> const std::vector<uint64_t>& { return piece(i).faceIds; });
    detail::beginFaces(result_.cutMesh);
    for (const PlaceOf& face : places_) {
      detail::appendFace(piece(face.piece).cutMesh, face.item, result_.cutMesh);
      result_.faceIds.push_back(face.id);
    }
  }

  void takeVertices() {
    const auto forEachCorner = [&](const auto& visit) {
      for (const PlaceOf& face : places_) {
        for (const auto loop : piece(face.piece).cutMesh.loops(face.item)) {
          for (const uint32_t v : loop) visit(face.piece, v);
        }
      }
    };
    forEachCorner([&](uint32_t i, uint32_t v) { vertices_.use(i, v); });
    for (const PlaceOf& vertex : vertices_.number([&](uint32_t i) -> const std::vector<uint64_t>& { return piece(i).vertexIds; })) {
      detail::appendVertex(piece(vertex.piece).cutMesh, vertex.item, result_.cutMesh);
      result_.vertexIds.push_back(vertex.id);
    }
    size_t corner = 0;
    forEachCorner([&](uint32_t i, uint32_t v) { result_.cutMesh.loopVertices[corner++] = vertices_(i, v); });
  }

  void takeCells() {
    CutMesh& to = result_.cutMesh;
    to.cellHalfFaceOffsets.assign(1, 0);
    for (uint32_t i = 0; i < cells_.size(); ++i) {
      const CutMesh& from = piece(i).cutMesh;
      for (size_t c = cells_[i].range.begin; c < cells_[i].range.end; ++c) {
        detail::append(to.cellGridCell, from.cellGridCell, c, 3);
        detail::append(to.cellRegion, from.cellRegion, c);
        detail::append(result_.cellIds, piece(i).cellIds, c);
        for (const uint32_t h : from.halfFaces(c)) to.cellHalfFaces.push_back(2 * faces_(i, h / 2) + h % 2);
        to.cellHalfFaceOffsets.push_back(uint32_t(to.cellHalfFaces.size()));
      }
    }
  }

  std::span<const PieceCells> cells_;
  Numbering faces_, vertices_;
  std::vector<PlaceOf> places_;  // per face of the result
  RankPiece result_;
};

}  // namespace

RankPiece joinCells(std::span<const PieceCells> cells) { return Joiner(cells).run(); }

}  // namespace mandoline::operators
