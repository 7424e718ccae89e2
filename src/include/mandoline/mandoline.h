// Mandoline: cuts a triangle mesh with a Cartesian grid into polyhedral cut-cells.
//
// After "Mandoline: Robust Cut-Cell Generation for Arbitrary Triangle Meshes" (Tao, Batty, Fiume, Levin; SIGGRAPH Asia 2019), with
// exact predicates in place of floating-point decisions. This header is the whole interface of the cutter; measure.h, triangulate.h,
// locate.h, slice.h, validate.h and io.h work on its results and see nothing else.
//
//   mandoline::Mesh mesh = mandoline::readMesh("bunny.obj");
//   mandoline::CutResult result = mandoline::cut(mesh, mandoline::Grid::around(mesh, 32));
//   if (!result) throw std::runtime_error(result.error.message);
//
// Lengths are in world units unless "cells" is said.
#pragma once

#include "mandoline/cut.h"
#include "mandoline/version.h"
