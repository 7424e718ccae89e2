// What the project's other libraries and its programs take of one of its libraries, besides the public functions.
#pragma once

/// Of such a function: shared libraries export it.
#if defined(__GNUC__)
#define MANDOLINE_SHARED [[gnu::visibility("default")]]
#else
#define MANDOLINE_SHARED
#endif
