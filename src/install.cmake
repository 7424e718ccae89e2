# What is installed, for find_package(mandoline) (targets mandoline::mandoline, mandoline::io and, where Eigen and MPI were found,
# mandoline::operators and mandoline::mpi)
# and for pkg-config (modules mandoline, mandoline-io and mandoline-operators). Nothing in it names a place: the installed tree can be moved.

# Shared libraries find each other, and the program finds them, by where they lie.
file(RELATIVE_PATH MANDOLINE_BIN_TO_LIB ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
if(APPLE)
  set(MANDOLINE_ORIGIN @loader_path)
else()
  set(MANDOLINE_ORIGIN $ORIGIN)
endif()
foreach(library ${MANDOLINE_INSTALLED})
  set_target_properties(${library} PROPERTIES INSTALL_RPATH ${MANDOLINE_ORIGIN})
endforeach()
if(TARGET mandoline-cli)
  set_target_properties(${MANDOLINE_COMMAND_LINES} PROPERTIES INSTALL_RPATH ${MANDOLINE_ORIGIN}/${MANDOLINE_BIN_TO_LIB})
endif()

set(MANDOLINE_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mandoline)
install(TARGETS ${MANDOLINE_INSTALLED} EXPORT mandoline)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY src/include/mandoline DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT mandoline NAMESPACE mandoline:: DESTINATION ${MANDOLINE_CMAKE_DIR} FILE mandoline-targets.cmake)

# Whoever links static libraries has to link what they use; shared ones see to it themselves.
set(MANDOLINE_CONFIG "")
if(MANDOLINE_STATIC)
  set(MANDOLINE_CONFIG "include(CMakeFindDependencyMacro)\nfind_dependency(Threads)\n")
  if(ZLIB_FOUND)
    string(APPEND MANDOLINE_CONFIG "find_dependency(ZLIB)\n")
  endif()
endif()
if(TARGET mandoline_operators) # those who only cut need no Eigen
  string(APPEND MANDOLINE_CONFIG "find_package(Eigen3 CONFIG QUIET)\n")
endif()
if(TARGET mandoline_mpi)
  string(APPEND MANDOLINE_CONFIG "set(MPI_CXX_SKIP_MPICXX ON)\nfind_package(MPI QUIET COMPONENTS CXX)\n")
endif()
file(WRITE ${PROJECT_BINARY_DIR}/mandoline-config.cmake
  "${MANDOLINE_CONFIG}include(\"\${CMAKE_CURRENT_LIST_DIR}/mandoline-targets.cmake\")\n")
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mandoline-config-version.cmake VERSION ${PROJECT_VERSION}
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mandoline-config.cmake ${PROJECT_BINARY_DIR}/mandoline-config-version.cmake
        DESTINATION ${MANDOLINE_CMAKE_DIR})

set(MANDOLINE_PC_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH MANDOLINE_PC_TO_INCLUDE ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_FULL_INCLUDEDIR})
# `uses` is what the library itself uses: static ones have nothing else to be linked with than `pkg-config --libs` says; of shared ones
# `pkg-config --static --libs` says it.
function(mandoline_write_pc module description requires uses)
  string(REPLACE - _ library ${module})
  set(libs "-L\${libdir} -l${library}")
  set(libs_private ${uses})
  if(MANDOLINE_STATIC)
    string(APPEND libs " ${uses}")
    set(libs_private "")
  endif()
  file(WRITE ${PROJECT_BINARY_DIR}/${module}.pc
"libdir=\${pcfiledir}/..
includedir=\${pcfiledir}/${MANDOLINE_PC_TO_INCLUDE}

Name: ${module}
Description: ${description}
Version: ${PROJECT_VERSION}
Requires: ${requires}
Cflags: -I\${includedir}
Libs: ${libs}
Libs.private: ${libs_private}
")
  install(FILES ${PROJECT_BINARY_DIR}/${module}.pc DESTINATION ${MANDOLINE_PC_DIR})
endfunction()
mandoline_write_pc(mandoline "Cuts triangle meshes with Cartesian grids into polyhedral cut-cells" "" "${CMAKE_THREAD_LIBS_INIT}")
if(ZLIB_FOUND)
  set(MANDOLINE_PC_ZLIB -lz)
endif()
mandoline_write_pc(mandoline-io "Mesh files for mandoline" "mandoline = ${PROJECT_VERSION}" "${MANDOLINE_PC_ZLIB}")
if(TARGET mandoline_operators)
  mandoline_write_pc(mandoline-operators "Discrete operators on the cells of mandoline" "mandoline = ${PROJECT_VERSION}, eigen3" "")
endif()
