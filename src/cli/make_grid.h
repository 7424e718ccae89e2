// The grid that was asked for.
#pragma once

#include "cli/arguments.h"
#include "mandoline/inspect.h"

namespace mandoline::cli {

/// `info` is that of the mesh.
Grid makeGrid(const GridArguments& arguments, const Mesh& mesh, const MeshInfo& info);

}  // namespace mandoline::cli
