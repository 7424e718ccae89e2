// What every public header begins with: the language that all of them need, and what shared libraries export.
#pragma once

#if defined(_MSVC_LANG) ? _MSVC_LANG <= 201703L : __cplusplus <= 201703L
#error "Mandoline needs C++20: compile with -std=c++20 or later (/std:c++20 for MSVC)"
#include "(nothing more is compiled)"  // not a file: compilers go on after an #error, but stop here
#endif

/// Marks the namespace of a public header: all that it declares is exported, even from a project compiled with -fvisibility=hidden, and
/// exceptions are caught on both sides of the library's border. On Windows CMake exports all symbols.
#if defined(__GNUC__)
#define MANDOLINE_API [[gnu::visibility("default")]]
#else
#define MANDOLINE_API
#endif
