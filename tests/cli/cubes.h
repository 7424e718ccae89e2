// Cubes as OBJ files.
#pragma once

#include <string>

inline const std::string kCube =
    "v 1 1 1\nv 3 1 1\nv 3 3 1\nv 1 3 1\nv 1 1 3\nv 3 1 3\nv 3 3 3\nv 1 3 3\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// To follow kCube in a file; the cubes overlap in [2, 3]^3.
inline const std::string kCrossingCube =
    "v 2 2 2\nv 4 2 2\nv 4 4 2\nv 2 4 2\nv 2 2 4\nv 4 2 4\nv 4 4 4\nv 2 4 4\n"
    "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";
