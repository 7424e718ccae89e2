// mandoline slice, make, resolve and info.
#ifdef MANDOLINE_CLI

#include "catch.h"
#include "command_line.h"
#include "cubes.h"

TEST_CASE("Command line: outlines at heights", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const auto slice = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"slice", mesh, "-o", "-", "--format"});
    const Outcome o = run(folder, words);
    CAPTURE(o.err);
    REQUIRE(o.exitCode == 0);
    return o.out;
  };
  const auto count = [](const std::string& text, const std::string& part) {
    size_t n = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
  };
  // Its sides are two triangles each, so that a square has eight points.
  const std::string svg = slice({"svg", "--heights", "1.5,2,9"});
  REQUIRE(contains(svg, "viewBox=\"1 -3 2 2\""));
  for (const std::string height : {"1.5", "2", "9"}) REQUIRE(contains(svg, "<g data-height=\"" + height + "\">"));
  REQUIRE(count(svg, "<path data-region=\"1\"") == 2);
  REQUIRE(count(svg, "L") == 14);
  REQUIRE(count(svg, "Z\"/>") == 2);
  const std::string dxf = slice({"dxf", "--heights", "1.5,2,9"});
  REQUIRE(count(dxf, "0\nPOLYLINE\n8\nregion_1\n66\n1\n70\n9\n") == 2);
  REQUIRE(count(dxf, "0\nVERTEX\n") == 16);
  REQUIRE(contains(dxf, "\n30\n1.5\n"));
  REQUIRE(dxf.ends_with("0\nENDSEC\n0\nEOF\n"));
  const std::string obj = slice({"obj", "--normal", "0,0,2", "--heights", "2"});
  REQUIRE(obj.starts_with("g height_2_region_1\nv "));
  REQUIRE(count(obj, "\nv ") == 8);
  REQUIRE(obj.ends_with("l 1 2 3 4 5 6 7 8 1\n"));
  const std::string layers = slice({"svg", "--axis", "x", "--layers", "4", "--cells", "5"});
  for (const std::string height : {"1.25", "1.75", "2.25", "2.75"}) REQUIRE(contains(layers, "data-height=\"" + height + "\""));
  const std::string outside = slice({"svg", "--heights", "2", "--only", "outside", "--box", "0,0,0,4,4,4"});
  REQUIRE(contains(outside, "viewBox=\"0 -4 4 4\""));
  REQUIRE(count(outside, "<path") == 1);
  REQUIRE(count(outside, "M") == 2);  // the box, and the hole in it
}

TEST_CASE("Command line: outlines of sheets are open lines", "[cli]") {
  const TemporaryFolder folder;
  const std::string sheet = folder.write("sheet.obj", "v 0 0 0\nv 4 0 0\nv 0 0 4\nf 1 2 3\n"), obj = folder.path("a.obj");
  const Outcome o = run(folder, {"slice", sheet, "--heights", "1", "-o", obj, folder.path("a.dxf")});
  CAPTURE(o.err);
  REQUIRE(o.exitCode == 0);
  REQUIRE(contains(folder.read("a.dxf"), "\n70\n8\n"));
  REQUIRE(folder.read("a.obj").find("l 5 6\n") != std::string::npos);  // after the four points of the box
}

TEST_CASE("Command line: heights at which nothing is cut are told", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cube.obj", kCube);
  const Outcome some = run(folder, {"slice", mesh, "--heights", "2,7", "-o", folder.path("some.svg"), "--report", "-"});
  CHECK(some.exitCode == 0);
  CHECK(contains(some.err, "Nothing is cut at height 7: the mesh reaches from 1 to 3 along the normal."));
  CHECK(contains(some.out, "{\"height\": 2, \"polygons\": 1, \"slits\": 0},\n    {\"height\": 7, \"polygons\": 0, \"slits\": 0}"));
  CHECK(contains(some.out, "\"status\": \"ok\""));
  const Outcome none = run(folder, {"slice", mesh, "--heights", "-2,7", "-o", folder.path("none.svg"), "--report", "-"});
  CHECK(none.exitCode == 1);
  CHECK(contains(none.err, "Nothing is cut at heights -2 7"));
  CHECK(contains(none.out, "\"status\": \"nothingCut\""));
  CHECK_FALSE(std::filesystem::exists(folder.path("none.svg")));
}

TEST_CASE("Command line: made shapes are closed", "[cli]") {
  const TemporaryFolder folder;
  for (const std::string shape : {"box", "sphere", "torus", "torus-knot"}) {
    for (const std::string extension : {".obj", ".stl", ".ply", ".off"}) {
      const std::string path = folder.path(shape + extension);
      REQUIRE(run(folder, {"make", shape, "-o", path}).exitCode == 0);
      REQUIRE(contains(run(folder, {"info", path}).out, "yes, consistently oriented"));
    }
  }
}

TEST_CASE("Command line: crossing cubes are resolved, refused or left alone, and their pairs counted", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("cubes.obj", kCube + kCrossingCube);
  const std::vector<std::string> grid = {"cut", mesh, "--cells", "5", "--box", "0,0,0,5,5,5", "--report", "-", "--intersections"};
  const auto cutWith = [&](const std::string& what) {
    std::vector<std::string> words = grid;
    words.push_back(what);
    return run(folder, words);
  };
  const Outcome resolved = cutWith("resolve");
  REQUIRE(resolved.exitCode == 0);
  for (const std::string part : {"\"winding\": 0, \"volume\": 110,", "\"winding\": 1, \"volume\": 7,", "\"winding\": 2, \"volume\": 1,",
                                 "\"crossing\": 6", "\"touching\": 12", "\"curves\": 1", "\"madeVertices\": 6"}) {
    REQUIRE(contains(resolved.out, part));
  }
  const Outcome refused = cutWith("refuse");
  REQUIRE(refused.exitCode == 1);
  REQUIRE(contains(refused.err, mesh + ": selfIntersection: Triangles 2 and "));
  REQUIRE(contains(refused.err, " pairs that do."));
  REQUIRE(contains(cutWith("assume-none").out, "\"intersections\": null"));
  REQUIRE(contains(cutWith("never").err, "--intersections needs resolve, refuse or assume-none, not 'never'"));
  REQUIRE(contains(run(folder, {"info", mesh}).out, " crossing, "));
  REQUIRE(contains(run(folder, {"info", mesh, "--report", "-"}).out, "\"first\": [2, "));
  REQUIRE(contains(run(folder, {"info", folder.write("cube.obj", kCube)}).out, "intersecting pairs    0\n"));
}

TEST_CASE("Command line: info tells what kind of mesh it is", "[cli]") {
  const TemporaryFolder folder;
  const Outcome closed = run(folder, {"info", folder.write("cube.obj", kCube)});
  REQUIRE(closed.exitCode == 0);
  for (const std::string part : {"8 vertices, 12 triangles", "(1, 1, 1) to (3, 3, 3)", "yes, consistently oriented"})
    REQUIRE(contains(closed.out, part));
  // Three triangles on one edge, a pair that disagrees, a duplicate, two without area, an unwelded and an unreferenced vertex.
  const std::string mesh =
      folder.write("odd.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 1 0 1\nv 0 0 0\nv 9 9 9\nv 10 0 0\nv 11 0 0\nv 10 1 0\nv 11 1 0\n"
                   "v 0.3 0.1 0\nv 0.6 0.2 0\nv 0.9 0.3 0\n"
                   "f 1 2 3\nf 2 7 4\nf 1 2 5\nf 9 10 11\nf 10 11 12\nf 11 9 10\nf 5 5 6\nf 13 14 15\n");
  const Outcome odd = run(folder, {"info", mesh, "--report", "-"});
  REQUIRE(odd.exitCode == 0);
  for (const std::string part :
       {"\"vertices\": 15", "\"triangles\": 8", "\"status\": \"ok\"", "\"min\": [0, -1, 0]", "\"max\": [11, 1, 1]", "\"closed\": false",
        "\"oriented\": false", "\"nonManifoldEdges\": 2", "\"inconsistentEdges\": 2", "\"components\": 3", "\"duplicateTriangles\": 1",
        "\"weldedVertices\": 1", "\"unreferencedVertices\": 1", "\"nonFiniteVertices\": 0"}) {
    REQUIRE(contains(odd.out, part));
  }
}

TEST_CASE("Command line: info tells where a mesh has defects, and writes them as lines", "[cli]") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\nf 1 2 3\nf 2 3 4\n");
  const Outcome o = run(folder, {"info", mesh, "-o", folder.path("defects.obj")});
  REQUIRE(o.exitCode == 0);
  for (const std::string part :
       {"Defects in 1 place\n", "4 edges are open", "1 edge is run through the same way by both triangles: --orient",
        "place 0 of component 0, from (0, 0, 0) to (1, 1, 0.5)",
        "inconsistent edge from (1, 0, 0) to (0, 1, 0) in place 0, triangles 0 1"}) {
    CHECK(contains(o.out, part));
  }
  CHECK(folder.read("defects.obj") == "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0.5\ng open\nl 1 2\nl 1 3\nl 2 4\nl 3 4\ng inconsistent\nl 2 3\n");
  const std::string json = run(folder, {"info", mesh, "--report", "-"}).out;
  CHECK(contains(json,
                 "{\"kind\": \"inconsistent\", \"place\": 0, \"vertices\": [1, 2], \"triangles\": [0, 1], \"from\": [1, 0, 0], "
                 "\"to\": [0, 1, 0]}"));
  CHECK(contains(json, "\"places\": [\n    {\"component\": 0, \"min\": [0, 0, 0], \"max\": [1, 1, 0.5]}\n  ]"));
  CHECK(contains(json, "\"components\": [\n    {\"closed\": false, \"oriented\": false}\n  ]"));
  const Outcome none = run(folder, {"info", folder.write("cube.obj", kCube), "-o", folder.path("none.obj")});
  CHECK(none.exitCode == 0);
  CHECK_FALSE(contains(none.out, "Defects"));
  CHECK(folder.read("none.obj").empty());
}

TEST_CASE("Command line: info lists the first 10000 of the components, places and defects, and tells how many there are", "[cli]") {
  const TemporaryFolder folder;
  constexpr size_t kTriangles = 10001;
  std::string soup;
  for (size_t t = 0; t < kTriangles; ++t) {
    const std::string x = std::to_string(2 * t);
    soup += "v " + x + " 0 0\nv " + x + " 1 0\nv " + x + " 0 1\nf -3 -2 -1\n";
  }
  const std::string mesh = folder.write("soup.obj", soup), json = run(folder, {"info", mesh, "--report", "-"}).out;
  const auto count = [&](const std::string& part) {
    size_t found = 0;
    for (size_t at = json.find(part); at != std::string::npos; at = json.find(part, at + 1)) ++found;
    return found;
  };
  CHECK(count("\"components\": 10001") == 1);
  CHECK(count("\"placeCount\": 10001,\n  \"defectCount\": 30003,") == 1);
  CHECK(count("\n    {\"closed\": ") == 10000);
  CHECK(count("\n    {\"component\": ") == 10000);
  CHECK(count("\n    {\"kind\": ") == 10000);
  CHECK(contains(run(folder, {"info", mesh}).out, "--report FILE.json tells of the first 10000\n"));
}

TEST_CASE("Command line: --orient turns triangles, and the report tells how many", "[cli]") {
  const TemporaryFolder folder;
  std::string turned = kCube;
  turned.replace(turned.find("f 4 3 2 1"), 9, "f 1 2 3 4");
  const std::string mesh = folder.write("turned.obj", turned), file = folder.path("a.obj");
  CHECK(contains(run(folder, {"cut", mesh, "--cells", "4", "--report", "-"}).out, "\"orientation\": null"));
  const std::string json = run(folder, {"cut", mesh, "--cells", "4", "--orient", "--report", "-"}).out;
  CHECK(contains(json, "\"orientation\": {\"turnedTriangles\": 2, \"outward\": 1, \"inward\": 0, \"unknown\": 0, \"nonOrientable\": 0}"));
  CHECK(contains(json, "\"winding\": 1, \"volume\": 8,"));
  const std::vector<std::string> ways[] = {{"slice", mesh, "--heights", "2", "--only", "inside"}, {"resolve", mesh, "--rule", "positive"}};
  for (std::vector<std::string> words : ways) {
    words.insert(words.end(), {"-o", file, "--report", "-"});
    CHECK(contains(run(folder, words).err, "inside by parity"));
    words.push_back("--orient");
    const Outcome o = run(folder, words);
    CHECK(o.exitCode == 0);
    CHECK_FALSE(contains(o.err, "inside by"));
    CHECK(contains(o.out, "\"turnedTriangles\": 2"));
  }
}

#endif
