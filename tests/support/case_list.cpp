#include "case_list.h"

#include <cmath>
#include <random>

#include "checked_cut.h"
#include "lattice.h"
#include "shapes.h"

using namespace mandoline;
using namespace shapes;

std::vector<NamedCase> caseList() {
  const Point c = {1.5, 1.5, 1.5};
  const auto wave = [](int i, int j) {
    return Point{0.375 + 0.3125 * i, 0.25 + 0.28125 * j, 2 + 0.7 * std::sin(0.9 * i) * std::cos(0.7 * j)};
  };
  Mesh flippedInPart = cube(0.5, 2.5);
  std::swap(flippedInPart.triangles[0], flippedInPart.triangles[1]);
  const Grid graded = Grid::rectilinear({{{0, 0.5, 2, 2.25, 4}, {0, 1, 1.125, 3, 4}, {0, 2, 2.5, 4}}});
  std::vector<NamedCase> cases = {
      {"aligned cube", cube(1, 3), unitGrid(4)},
      {"cube", cube(0.6875, 2.8125), unitGrid(4)},
      {"cube in a graded grid", cube(0.5, 2.25), graded},
      {"sphere in a graded grid", icosphere({1.9, 1.7, 2.1}, 1.6, 2), graded},
      {"sphere", icosphere({1.9, 2.1, 2}, 1.6, 2), unitGrid(4)},
      {"octahedron on grid vertices", octahedron({2, 2, 2}, 2), unitGrid(4)},
      {"octahedron in a cell", octahedron(c, 0.5), unitGrid(3)},
      {"nested bubbles", merged({octahedron(c, 0.375), flipped(octahedron(c, 0.25)), octahedron(c, 0.125)}), unitGrid(3)},
      {"noisy sphere", noisySphere({2, 2, 2}, 1.5, 0.2, 3), unitGrid(5, 4, 6)},
      {"torus", torus({2.1, 2.2, 2.3}, 1.25, 0.4, 16, 8), unitGrid(4)},
      {"bent tube", sweptTube({{1.25, 1.5, 0.5}, {1.25, 1.5, 1.5}, {1.75, 1.5, 1.5}, {1.75, 1.5, 0.5}}, 0.125), unitGrid(3)},
      {"open tube", tube({1.5, 1.5, 0.5}, 0.25, 2, 12, false), unitGrid(3)},
      {"prism in x = y", prism({{1, 1}, {3, 1}, {3, 3}}, 0.5, 2.5), unitGrid(4)},
      {"wave", sheet(11, 12, wave), unitGrid(4)},
      {"quad on a plane", quad({0.5, 0.5, 2}, {2.5, 0.5, 2}, {2.5, 2.5, 2}, {0.5, 2.5, 2}), unitGrid(4)},
      {"floating quad", quad({1.25, 1.25, 1.5}, {1.75, 1.25, 1.5}, {1.75, 1.75, 1.5}, {1.25, 1.75, 1.5}), unitGrid(3)},
      {"fan", fan(c, 1, {{1, 0}, {0.75, 0.75}, {-0.75, 0.75}, {-1, 0}, {0, -1}}), unitGrid(3)},
      {"fan on a grid line", fan({2, 2, 0.5}, 2, {{0.75, 0.25}, {-0.25, 0.75}, {-1, 0}, {0.25, -0.75}}), unitGrid(4)},
      {"bow tie", merged({octahedron({1.5, 1.5, 1}, 0.5), octahedron({1.5, 1.5, 2}, 0.5)}), unitGrid(3)},
      {"two boxes on an edge", merged({box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}), box({1.5, 1.5, 0.5}, {2.5, 2.5, 1.5})}), unitGrid(3)},
      {"Moebius strip", moebius({2.1, 2.05, 1.95}, 1.25, 0.75, 24), unitGrid(4)},
      {"inconsistently oriented cube", flippedInPart, unitGrid(4)},
      {"partly outside", cube(1.5, 6), unitGrid(4)},
      {"empty cone", emptyCone(), unitGrid(1, 1, 2)},
      {"claw", claw(), unitGrid(1, 1, 2)},
      {"oscillator", oscillator(8), unitGrid(1, 1, 2)},
  };
  for (NamedCase& named : cases)
    for (double& x : named.mesh.positions) x = std::ldexp(std::round(std::ldexp(x, 20)), -20);
  return cases;
}

std::vector<NamedCase> casesAndSoups() {
  std::vector<NamedCase> cases = caseList();
  std::mt19937 random(7);
  for (int i = 0; i < 150; ++i) {
    std::array<uint8_t, 96> bytes;
    for (uint8_t& byte : bytes) byte = uint8_t(random());
    LatticeCase soup = decodeLattice(bytes.data(), bytes.size());
    cases.push_back({"lattice", std::move(soup.mesh), std::move(soup.grid)});
  }
  return cases;
}
