// What every operator asks of its cut-mesh.
#pragma once

#include "mandoline/cut_mesh.h"
#include "mandoline/status.h"

namespace mandoline::operators {

/// Throws CallError{badArgument}.
[[noreturn]] void refuse(const std::string& message, int64_t element = -1);

/// Throws CallError for a CutMesh that holds nothing, as one is that was made without cut(). The arrays of others are trusted.
void requireCutMesh(const CutMesh& cutMesh);

}  // namespace mandoline::operators
