// Compares the pieces of distributed cuts with whole ones, to the bit. Run by MPI in any number of processes:
//
//   mandoline-mpi-pieces CELLS EVERY
//
// cuts made meshes, and of the collection of real ones (see mesh_folder.h) every so many-th of those below 40000 triangles. Each process
// compares its own piece: what it has is that of the whole under the same ids, and every id belongs to one process.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "case_list.h"
#include "compare_complex.h"
#include "cut/share_plan.h"
#include "mandoline/distributed.h"
#include "mandoline/io.h"
#include "mandoline/measure.h"
#include "mandoline/validate.h"
#include "ranks_here.h"
#include "real_meshes.h"
#include "same_bits.h"
#include "shapes.h"

using namespace mandoline;

namespace {

/// Throws what is wrong.
void require(bool holds, const std::string& what, size_t element = 0) {
  if (!holds) throw std::runtime_error(what + " " + std::to_string(element));
}

template <class Number>
bool areSame(const std::vector<Number>& a, size_t i, const std::vector<Number>& b, size_t j, size_t items) {
  return bytesOf(a.data() + i * items, items) == bytesOf(b.data() + j * items, items);
}

/// What loops and triangles a face has, by the ids of the whole.
std::vector<uint64_t> describeFace(const CutMesh& m, size_t f, const std::vector<uint64_t>* vertexIds) {
  std::vector<uint64_t> all = {uint64_t(m.faceTriangle[f]), uint64_t(m.faceAxis[f]), uint64_t(m.facePlane[f])};
  for (const auto loop : m.loops(f)) {
    all.push_back(loop.size());
    for (const uint32_t v : loop) all.push_back(vertexIds ? (*vertexIds)[v] : v);
  }
  for (uint32_t i = m.faceParentOffsets[f]; i < m.faceParentOffsets[f + 1]; ++i) {
    all.push_back(m.faceParents[i]);
    all.push_back(uint64_t(m.faceParentSigns[i]));
  }
  return all;
}

std::vector<int32_t> describeMade(const CutMesh& m, uint32_t vertex) {
  const auto found = std::lower_bound(m.madeVertices.begin(), m.madeVertices.end(), vertex);
  if (found == m.madeVertices.end() || *found != vertex) return {};
  const size_t i = size_t(found - m.madeVertices.begin());
  std::vector<int32_t> all = {m.madeVertexKinds[i]};
  all.insert(all.end(), &m.madeVertexParents[4 * i], &m.madeVertexParents[4 * i] + 4);
  return all;
}

void compareVertices(const RankPiece& piece, const CutMesh& whole) {
  const CutMesh& m = piece.cutMesh;
  for (size_t v = 0; v < m.vertexCount(); ++v) {
    const size_t id = piece.vertexIds[v];
    require(v == 0 || piece.vertexIds[v - 1] < id, "vertices do not ascend at", id);
    require(areSame(m.positions, v, whole.positions, id, 3), "positions differ at", id);
    require(areSame(m.vertexCell, v, whole.vertexCell, id, 3), "vertexCell differs at", id);
    require(m.vertexMask[v] == whole.vertexMask[id] && m.vertexTriVertex[v] == whole.vertexTriVertex[id], "vertex differs:", id);
    require(areSame(m.vertexParents, v, whole.vertexParents, id, 2), "vertexParents differ at", id);
    require(describeMade(m, uint32_t(v)) == describeMade(whole, uint32_t(id)), "made vertex differs:", id);
  }
}

void compareCells(const RankPiece& piece, const CutMesh& whole) {
  const CutMesh& m = piece.cutMesh;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    require(f == 0 || piece.faceIds[f - 1] < piece.faceIds[f], "faces do not ascend at", f);
    require(describeFace(m, f, &piece.vertexIds) == describeFace(whole, piece.faceIds[f], nullptr), "face differs:", piece.faceIds[f]);
  }
  for (size_t c = 0; c < m.cellCount(); ++c) {
    const size_t id = piece.cellIds[c];
    require(areSame(m.cellGridCell, c, whole.cellGridCell, id, 3) && m.cellRegion[c] == whole.cellRegion[id], "cell differs:", id);
    const auto here = m.halfFaces(c), there = whole.halfFaces(id);
    require(here.size() == there.size(), "half-faces differ of cell", id);
    for (size_t i = 0; i < here.size(); ++i) {
      require(2 * piece.faceIds[here[i] / 2] + here[i] % 2 == there[i], "half-faces differ of cell", id);
    }
  }
}

void compareMeasures(const Measures& measures, const RankPiece& piece, const Measures& whole) {
  for (size_t f = 0; f < piece.faceIds.size(); ++f) {
    const size_t id = piece.faceIds[f];
    require(areSame(measures.faceArea, f, whole.faceArea, id, 1) && areSame(measures.faceNormal, f, whole.faceNormal, id, 3) &&
                areSame(measures.faceCentroid, f, whole.faceCentroid, id, 3),
            "the measures differ of face", id);
  }
  for (size_t c = 0; c < piece.cellIds.size(); ++c) {
    const size_t id = piece.cellIds[c];
    require(areSame(measures.cellVolume, c, whole.cellVolume, id, 1) && areSame(measures.cellCentroid, c, whole.cellCentroid, id, 3),
            "the measures differ of cell", id);
  }
}

void compareRegions(const RankPiece& piece, const CutMesh& whole) {
  const CutMesh& m = piece.cutMesh;
  require(m.regionCount == whole.regionCount && m.regionWinding == whole.regionWinding && m.regionParity == whole.regionParity &&
              m.regionPartWinding == whole.regionPartWinding,
          "regions differ");
  require(m.parityTriangles == whole.parityTriangles && m.openTriangles == whole.openTriangles, "triangles of parts differ");
  UntouchedCells(whole).forEach([&](const UntouchedCells::Run& run) {
    const bool isHere = run.k >= piece.layers[0] && run.k < piece.layers[1];
    require(UntouchedCells(m).regionAt(run.begin, run.j, run.k) == (isHere ? int64_t(run.region) : -1), "untouched cell differs in row",
            size_t(run.k));
  });
}

/// What the seams say is at the other side.
void compareSeams(const RankPiece& piece, const CutMesh& whole) {
  const Adjacency sides = adjacency(whole);
  std::vector<int64_t> told(whole.faceCount(), -1);
  for (const RankSeam& seam : piece.seams) {
    require(seam.rank != rankHere() && seam.faces.size() == seam.cells.size() && !seam.faces.empty(), "a bad seam");
    for (size_t i = 0; i < seam.faces.size(); ++i) told[piece.faceIds[seam.faces[i]]] = int64_t(seam.cells[i]);
  }
  const auto isHere = [&](int64_t cell) { return std::binary_search(piece.cellIds.begin(), piece.cellIds.end(), uint64_t(cell)); };
  for (const uint64_t f : piece.faceIds) {
    int64_t expected = -1;
    for (size_t side = 0; side < 2; ++side) {
      const int64_t cell = sides.faceCells[2 * f + side];
      if (cell >= 0 && !isHere(cell)) expected = cell;
    }
    require(told[f] == expected, "a seam differs at face", f);
  }
}

/// Per element of the whole how many processes say that it is theirs.
void requireOneOwner(const std::vector<uint64_t>& ids, const std::vector<int32_t>* ranks, size_t count, const char* what) {
  std::vector<int> owners(count, 0);
  for (size_t i = 0; i < ids.size(); ++i) owners[ids[i]] += ranks ? (*ranks)[i] == rankHere() : 1;
  MPI_Allreduce(MPI_IN_PLACE, owners.data(), int(count), MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  for (size_t i = 0; i < count; ++i) require(owners[i] == 1, std::string(what) + " has not one owner:", i);
}

/// The whole from the files of all pieces, in the process of rank 0, the last piece first.
CutMesh joinFiles(const RankPiece& piece) {
  std::string bytes;
  writeMcm([&](std::string_view more) { bytes += more; }, piece);
  const int ranks = ranksHere();
  std::vector<int> lengths(size_t(ranks), 0), starts(size_t(ranks) + 1, 0);
  const int length = int(bytes.size());
  MPI_Allgather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, MPI_COMM_WORLD);
  for (size_t i = 0; i < lengths.size(); ++i) starts[i + 1] = starts[i] + lengths[i];
  std::string all(size_t(starts.back()), '\0');
  MPI_Gatherv(bytes.data(), length, MPI_CHAR, all.data(), lengths.data(), starts.data(), MPI_CHAR, 0, MPI_COMM_WORLD);
  if (rankHere() != 0) return {};
  std::vector<RankPiece> pieces;
  for (size_t i = lengths.size(); i-- > 0;) pieces.push_back(readRankPiece({all.data() + starts[i], size_t(lengths[i])}, "a.mcm"));
  return joinPieces(pieces);
}

/// What was planned for this process.
void comparePlan(const RankPiece& piece, const PreparedMesh& mesh, const Grid& grid) {
  const RunOptions oneThread{1, {}};
  const detail::ShareLoad load = detail::SharePlanner(mesh, grid, oneThread).loads(uint32_t(ranksHere()), oneThread)[size_t(rankHere())];
  size_t seamFaces = 0;
  for (const RankSeam& seam : piece.seams) seamFaces += seam.faces.size();
  require(load.cutCells == piece.cellIds.size(), "another number of cut-cells is planned:", load.cutCells);
  require(load.faces == uint64_t(std::count(piece.faceRanks.begin(), piece.faceRanks.end(), rankHere())),
          "another number of faces is planned:", load.faces);
  require(load.seamFaces == seamFaces, "another number of faces on seams is planned, not " + std::to_string(seamFaces) + ":",
          load.seamFaces);
}

bool areEqual(const CutCounts& a, const CutCounts& b) {
  return a.cutCells == b.cutCells && a.untouchedCells == b.untouchedCells && a.regions == b.regions && a.vertices == b.vertices &&
         a.faces == b.faces && a.loops == b.loops;
}

/// Runs work() in all processes. Whether it did in all; the others tell why not.
template <class Work>
bool inAll(const std::string& name, const Work& work) {
  int failed = 0;
  try {
    work();
  } catch (const std::exception& error) {
    std::cerr << name << ", process " << rankHere() << ": " << error.what() << std::endl;
    failed = 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return failed == 0;
}

CellComplex uncoarsened(const MeshView& mesh, const CutMesh& cutMesh) {
  CoarsenOptions options;
  options.maxLevel = 0;
  return cellComplex(mesh, cutMesh, coarsen(cutMesh, options));
}

/// Prepared by all processes together.
PreparedTogether preparedTogether(const std::string& name, const Mesh& mesh, const PrepareResult& alone) {
  size_t calls = 0;
  std::function<void()> inFirst;
  if (name.size() % 2 == 0) inFirst = [&] { ++calls; };
  PreparedTogether together = prepareTogether(MPI_COMM_WORLD, mesh, {{1, {}}}, inFirst);
  require(calls == size_t(inFirst && rankHere() == 0), "the first process has not done its work once", calls);
  require(bytesOf(&together.stats.intersections, 1) == bytesOf(&alone.stats.intersections, 1), "other intersections were found");
  require(together.stats.duplicateTriangles == alone.stats.duplicateTriangles, "other duplicates were found");
  require(together.stats.intersectionCurves == alone.stats.intersectionCurves, "other curves were found");
  return together;
}

bool areEqual(const PartCounts& a, const PartCounts& b) {
  return a.winding == b.winding && a.parity == b.parity && a.open == b.open && a.openEdges == b.openEdges && a.holes == b.holes;
}

/// All but the arrays.
void compareInfo(const MeshInfo& a, const MeshInfo& b) {
  MeshInfo::fields(a, [&](const auto& field, const auto& value) {
    MeshInfo::fields(b, [&](const auto& other, const auto& expected) {
      if constexpr (std::is_same_v<decltype(value), decltype(expected)>) {
        if constexpr (!detail::isVector<std::remove_cvref_t<decltype(value)>>)
          require(std::string(field) != other || value == expected, std::string("the inspection differs in ") + field);
      }
    });
  });
}

size_t preparedInShares = 0;

/// What this process has of a mesh in slices, which are uneven: the first may have nothing.
Mesh unevenSlice(const Mesh& mesh) {
  const auto some = [](const auto& numbers) {
    const auto at = [&](size_t rank) {
      return numbers.begin() + ptrdiff_t(numbers.size() / 3 * rank * rank / size_t(ranksHere() * ranksHere()) * 3);
    };
    return std::vector(at(size_t(rankHere())), at(size_t(rankHere()) + 1));
  };
  return {some(mesh.positions), some(mesh.triangles)};
}

void compareBox(const SlicedMesh& slices, const Mesh& mesh) {
  const MeshBox box = slices.box(), expected = boxOf(mesh);
  require(box.min == expected.min && box.max == expected.max, "the box of slices differs");
}

/// Slices without a finite value along an axis don't tell of the box along that.
bool checkBoxBesideUnknown() {
  Mesh mesh;
  for (uint32_t t = 0; t < 12; ++t) {
    const double x = t < 3 ? 10 + t : NAN, y = 5 + t;
    mesh.positions.insert(mesh.positions.end(), {x, y, 1, x, y + 1, 1, x, y, 2});
    mesh.triangles.insert(mesh.triangles.end(), {3 * t, 3 * t + 1, 3 * t + 2});
  }
  return inAll("unknown coordinates", [&] { compareBox(SlicedMesh(MPI_COMM_WORLD, unevenSlice(mesh)), mesh); });
}

/// Cuts a mesh that all processes have, or each a slice of.
DistributedCut cutUnprepared(const Mesh& mesh, const Grid& grid, bool inSlices, MeshInfo* info) {
  if (inSlices) {
    SlicedMesh slices(MPI_COMM_WORLD, unevenSlice(mesh));
    compareBox(slices, mesh);
    require(slices.vertexCount() == mesh.vertexCount() && slices.triangleCount() == mesh.triangleCount(), "slices differ in size");
    return DistributedCut(MPI_COMM_WORLD, std::move(slices), grid, {{1, {}}}, info);
  }
  auto given = std::make_shared<const Mesh>(mesh);
  const std::weak_ptr<const Mesh> left = given;
  DistributedCut cut(MPI_COMM_WORLD, std::move(given), grid, {{1, {}}}, info);
  require(left.expired() || ranksHere() == 1, "the mesh has not been freed");
  return cut;
}

/// The cut of a mesh that is not prepared before: its pieces are the same.
bool checkUnprepared(const std::string& name, const Mesh& mesh, const Grid& grid, const CutResult& whole, bool inSlices) {
  return inAll(name + (inSlices ? " in slices" : " unprepared"), [&] {
    MeshInfo info;
    DistributedCut cut = cutUnprepared(mesh, grid, inSlices, name.size() % 3 == 0 ? nullptr : &info);
    preparedInShares += cut.isPreparedInShares();
    const RankPiece piece = cut.piece();
    const CutResult& common = cut.common();
    const std::vector<double> volumes = cut.regionVolumes(piece);
    if (inSlices) {
      const RankPiece taken = cut.takePiece();
      require(taken.faceIds == piece.faceIds && taken.vertexIds == piece.vertexIds, "the taken piece differs");
      require(cut.regionVolumes(taken) == volumes, "the volumes differ once the piece is taken");
    }
    const CutResult gathered = inSlices ? CutResult() : cut.gather();
    compareVertices(piece, whole.mesh);
    compareCells(piece, whole.mesh);
    compareRegions(piece, whole.mesh);
    if (rankHere() == 0 && name.size() % 3 != 0) compareInfo(info, inspect(mesh));
    require(areEqual(cut.counts(), countsOf(whole.mesh)), "the counts differ");
    const Measures measures = measure(mesh, whole.mesh, {1, {}});
    require(volumes == regionVolumes(whole.mesh, measures), "the volumes of regions differ");
    compareMeasures(cut.measures(piece, {1, {}}), piece, measures);
    require(areEqual(common.stats.parts, whole.stats.parts), "other parts were found");
    require(common.stats.weldedVertices == whole.stats.weldedVertices, "other vertices were welded");
    require(common.stats.zeroAreaTriangles == whole.stats.zeroAreaTriangles, "other triangles have no area");
    require(common.stats.duplicateTriangles == whole.stats.duplicateTriangles, "other duplicates were found");
    require(common.mesh.droppedTriangles == whole.mesh.droppedTriangles, "dropped triangles differ");
    require(common.stats.outsideTriangles == whole.stats.outsideTriangles, "triangles outside differ");
    if (rankHere() == 0 && !inSlices) require(differences(gathered.mesh, whole.mesh).empty(), "the gathered cut differs");
  });
}

/// Where triangles are refused or assumed not to meet: the pieces are those of the whole, or the error is. What meets although it is
/// assumed not to may be contradictory, of which errors tell something else.
bool checkOtherModes(const std::string& name, const Mesh& mesh, const Grid& grid) {
  for (const Intersections intersections : {Intersections::refuse, Intersections::assumeNone}) {
    const PrepareOptions options{{1, {}}, intersections};
    const PrepareResult alone = prepare(mesh, options);
    if (intersections == Intersections::assumeNone && prepare(mesh, {{1, {}}, Intersections::refuse}).error.status != Status::ok) continue;
    const bool isRight = inAll(name + (intersections == Intersections::refuse ? " refused" : " assumed"), [&] {
      Error error;
      std::optional<DistributedCut> cut;
      try {
        cut.emplace(MPI_COMM_WORLD, SlicedMesh(MPI_COMM_WORLD, unevenSlice(mesh)), grid, options);
      } catch (const RankError& failed) {
        error = failed.error;
      }
      require(error.status == alone.error.status && error.message == alone.error.message, "the error differs: " + error.message);
      if (!cut) return;
      const CutResult whole = mandoline::cut(alone.mesh, grid, {{1, {}}});
      const RankPiece piece = cut->takePiece();
      compareVertices(piece, whole.mesh);
      compareCells(piece, whole.mesh);
      compareRegions(piece, whole.mesh);
      require(piece.whole == whole.mesh.fingerprint, "the fingerprint differs");
    });
    if (!isRight) return false;
  }
  return true;
}

/// Octree cells of few levels and of many, as few as there can be and more, with one ring of ghosts or several.
bool checkOctree(const std::string& name, const DistributedCut& cut, const RankPiece& piece, const MeshView& mesh, const CutMesh& whole) {
  std::array<CoarsenOptions, 4> all;
  all[0].maxLevel = 1;
  all[1].maxLevel = 2, all[1].balanceEdges = true;
  all[3].fineLayers = all[3].layersPerLevel = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    const int rings = 1 + int((name.size() + i) % 3);
    RankComplex complex;
    const bool isSame =
        inAll(name + ", octree " + std::to_string(i), [&] { complex = cut.cellComplex(piece, rings, all[i]); }) &&
        inAll(name + ", octree " + std::to_string(i), [&] { compareComplex(complex, cellComplex(mesh, whole, coarsen(whole, all[i]))); });
    if (!isSame) return false;
  }
  return true;
}

bool check(const std::string& name, const Mesh& wholeMesh, const Grid& grid) {
  const RunOptions oneThread{1, {}};
  const PrepareResult alone = prepare(wholeMesh, {oneThread});
  const CutResult whole = cut(alone.mesh, grid, {oneThread});
  if (!checkUnprepared(name, wholeMesh, grid, whole, false) || !checkUnprepared(name, wholeMesh, grid, whole, true)) return false;
  if (!checkOtherModes(name, wholeMesh, grid)) return false;
  PreparedMesh mesh;
  if (!inAll(name, [&] { mesh = preparedTogether(name, wholeMesh, alone).mesh; })) return false;
  std::optional<DistributedCut> distributed;
  RankPiece piece;
  std::vector<double> volumes;
  const bool isCut = inAll(name, [&] {
    distributed.emplace(MPI_COMM_WORLD, mesh, grid, oneThread);
    piece = distributed->piece();
    volumes = distributed->regionVolumes(piece);
  });
  if (!isCut) return false;
  const bool isSame = inAll(name, [&] {
    const std::string problem = checkArrays(piece.cutMesh).message;
    require(problem.empty(), problem);
    compareVertices(piece, whole.mesh);
    compareCells(piece, whole.mesh);
    compareRegions(piece, whole.mesh);
    compareSeams(piece, whole.mesh);
    comparePlan(piece, mesh, grid);
    require(areEqual(distributed->counts(), countsOf(whole.mesh)), "the counts differ");
    require(volumes == regionVolumes(whole.mesh, measure(mesh.mesh(), whole.mesh, oneThread)), "the volumes of regions differ");
    const CutResult& common = distributed->common();
    require(common.mesh.droppedTriangles == whole.mesh.droppedTriangles, "dropped triangles differ");
    require(common.stats.outsideTriangles == whole.stats.outsideTriangles, "triangles outside differ");
    require(common.stats.madeVertices == whole.stats.madeVertices, "made vertices differ");
  });
  if (!isSame) return false;
  RankComplex complex;
  const bool areCells = inAll(name, [&] { complex = distributed->cellComplex(piece, 1 + int(name.size() % 2)); }) &&
                        inAll(name, [&] { compareComplex(complex, uncoarsened(mesh.mesh(), whole.mesh)); });
  if (!areCells || !checkOctree(name, *distributed, piece, mesh.mesh(), whole.mesh)) return false;
  return inAll(name, [&] {
    requireOneOwner(piece.vertexIds, &piece.vertexRanks, whole.mesh.vertexCount(), "vertex");
    requireOneOwner(piece.faceIds, &piece.faceRanks, whole.mesh.faceCount(), "face");
    requireOneOwner(piece.cellIds, nullptr, whole.mesh.cellCount(), "cell");
    const CutMesh joined = joinFiles(piece);
    if (rankHere() == 0) require(differences(joined, whole.mesh).empty(), "the joined pieces differ");
    const CutResult gathered = distributed->gather();
    if (rankHere() == 0) require(differences(gathered.mesh, whole.mesh).empty(), "the gathered cut differs");
  });
}

/// Meshes that tell whether what processes find of their own layers adds up: triangles that reach into the layers of all, around the lowest
/// corner of the grid; separate vertices at the same positions; sheets and closed parts that come in several layers; vertices that no
/// triangle has, some at positions of others; closed ones of which four triangles have an edge.
std::vector<NamedCase> meshesInAllLayers() {
  const Mesh ball = shapes::icosphere({0.5, 0.5, 0.5}, 0.4, 3), box = shapes::cube(-5, 6);
  Mesh sheets = shapes::merged({ball, box}), loose = sheets;
  sheets.triangles.resize(sheets.triangles.size() - 3);
  sheets.triangles.erase(sheets.triangles.begin(), sheets.triangles.begin() + 3);
  for (size_t i = 0; i < loose.triangles.size(); ++i) {
    const double* p = &sheets.positions[3 * size_t(loose.triangles[i])];
    loose.positions.insert(loose.positions.end(), p, p + 3);
    loose.triangles[i] = uint32_t(loose.vertexCount() - 1);
  }
  Mesh spare = sheets;
  spare.positions.insert(spare.positions.begin(), {7, 8, 9, 0.5, 0.5, 0.9, 7, 8, 9, 0.5, 0.5, INFINITY, 6, 6, 6, -5, 6, -0.0});
  for (uint32_t& v : spare.triangles) v += 6;
  const Mesh hinged = {{0.2, 0.5, 0.1, 0.3, 0.5, 0.9, 0.8, 0.2, 0.3, 0.9, 0.4, 0.6, 0.1, 0.8, 0.4, 0.1, 0.9, 0.8},
                       {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3, 0, 4, 1, 0, 1, 5, 0, 5, 4, 1, 4, 5}};
  const Grid grid = Grid::box({0, 0, 0}, {1, 1, 1}, {9, 10, 11});
  return {{"spare vertices", spare, grid},
          {"two at an edge", hinged, grid},
          {"a ball in a box", shapes::merged({ball, box}), grid},
          {"the same with holes", sheets, grid},
          {"loose triangles", loose, grid}};
}

int checkAll(int64_t cells, size_t every) {
  size_t checked = 1, wrong = !checkBoxBesideUnknown();
  std::vector<NamedCase> cases = casesAndSoups();
  for (NamedCase& one : meshesInAllLayers()) cases.push_back(std::move(one));
  for (const NamedCase& one : cases) {
    ++checked;
    wrong += !check(one.name, one.mesh, one.grid);
  }
  for (const std::string& file : realMeshes(every)) {
    const Mesh mesh = readMesh(file);
    ++checked;
    wrong += !check(file, mesh, Grid::around(mesh, cells));
  }
  if (rankHere() == 0)
    std::cout << checked << " meshes, of which " << wrong << " differ; " << preparedInShares << " were prepared in shares" << std::endl;
  return wrong == 0 && checked > 0 && (preparedInShares > 0 || ranksHere() == 1) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int64_t cells = argc > 1 ? std::atoll(argv[1]) : 13;
  const size_t every = argc > 2 ? size_t(std::atoll(argv[2])) : 10;
  const int exitCode = checkAll(cells, std::max<size_t>(every, 1));
  MPI_Finalize();
  return exitCode;
}
