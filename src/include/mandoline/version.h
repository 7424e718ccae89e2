// The version of these headers, for the preprocessor. CMakeLists.txt takes the project's version from here.
#pragma once

#define MANDOLINE_VERSION_MAJOR 0
#define MANDOLINE_VERSION_MINOR 1
#define MANDOLINE_VERSION_PATCH 0

/// One number to compare: 10203 for 1.2.3.
#define MANDOLINE_VERSION_NUMBER (MANDOLINE_VERSION_MAJOR * 10000 + MANDOLINE_VERSION_MINOR * 100 + MANDOLINE_VERSION_PATCH)
