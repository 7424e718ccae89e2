// Mandoline: cuts a triangle mesh with a Cartesian grid into polyhedral cut-cells.
//
// After "Mandoline: Robust Cut-Cell Generation for Arbitrary Triangle Meshes" (Tao, Batty, Fiume, Levin; SIGGRAPH Asia 2019), with
// exact predicates in place of floating-point decisions. This header has all of the library mandoline::mandoline. grid.h, cut.h and
// cut_mesh.h are about the cut and its result; recut.h, for_each_brick.h, cut_share.h and rank_piece.h about cutting again and in parts;
// mesh.h, prepare.h, prepare_share.h, intersections.h, resolve.h, inspect.h, orient.h and shapes.h about meshes; measure.h, triangulate.h,
// drawing.h, locate.h, inside.h, slice.h, coarsen.h, cell_complex.h, refine.h, merge.h and validate.h work on cut-meshes. Files are in
// io.h; operators.h, poisson.h, flow.h, heat.h and unsteady.h, which need Eigen, compute on all cells; distributed.h and rank_complex.h
// need MPI.
//
//   mandoline::Mesh mesh = mandoline::readMesh("bunny.obj");  // io.h
//   mandoline::CutResult result = mandoline::cut(mesh, mandoline::Grid::around(mesh, 32));
//   if (!result) throw std::runtime_error(result.error.message);
//
// Lengths are in world units unless "cells" is said.
#pragma once

#include "mandoline/cell_complex.h"
#include "mandoline/coarsen.h"
#include "mandoline/cut.h"
#include "mandoline/cut_share.h"
#include "mandoline/drawing.h"
#include "mandoline/for_each_brick.h"
#include "mandoline/inside.h"
#include "mandoline/inspect.h"
#include "mandoline/intersections.h"
#include "mandoline/locate.h"
#include "mandoline/measure.h"
#include "mandoline/merge.h"
#include "mandoline/orient.h"
#include "mandoline/prepare.h"
#include "mandoline/prepare_share.h"
#include "mandoline/rank_piece.h"
#include "mandoline/recut.h"
#include "mandoline/refine.h"
#include "mandoline/resolve.h"
#include "mandoline/shapes.h"
#include "mandoline/slice.h"
#include "mandoline/triangulate.h"
#include "mandoline/validate.h"
#include "mandoline/version.h"
