# Cuts in several processes, also more than there are cores. The processes of the tests share the cores with others: they are not bound.
add_executable(mandoline-mpi-pieces mpi/pieces.cpp mpi/compare_complex.cpp support/case_list.cpp support/lattice.cpp support/shapes.cpp)
set_target_properties(mandoline-mpi-pieces PROPERTIES UNITY_BUILD OFF)
target_compile_options(mandoline-mpi-pieces PRIVATE ${MANDOLINE_COMPILE_OPTIONS})
target_include_directories(mandoline-mpi-pieces PRIVATE ${PROJECT_SOURCE_DIR}/src support)
target_link_libraries(mandoline-mpi-pieces PRIVATE mandoline_mpi mandoline_io)
add_dependencies(mandoline-tests mandoline-mpi)
set(MANDOLINE_MPI_PROGRAMS mandoline-mpi-pieces)
if(TARGET mandoline_rank_flow)
  add_executable(mandoline-mpi-flows mpi/flows.cpp support/shapes.cpp)
  set_target_properties(mandoline-mpi-flows PROPERTIES UNITY_BUILD OFF)
  target_compile_options(mandoline-mpi-flows PRIVATE ${MANDOLINE_COMPILE_OPTIONS})
  target_include_directories(mandoline-mpi-flows PRIVATE ${PROJECT_SOURCE_DIR}/src support)
  target_link_libraries(mandoline-mpi-flows PRIVATE mandoline_rank_flow mandoline_io)
  list(APPEND MANDOLINE_MPI_PROGRAMS mandoline-mpi-flows)
  set(MANDOLINE_MPI_DEFINITIONS MANDOLINE_MPI_FLOWS)
endif()
# Of this source alone: others need not be compiled again once MPI is there.
set_source_files_properties(cli/mpi_test.cpp PROPERTIES SKIP_PRECOMPILE_HEADERS ON
  COMPILE_DEFINITIONS "MANDOLINE_MPI=\"$<TARGET_FILE:mandoline-mpi>\";MANDOLINE_MPIEXEC=\"${MPIEXEC_EXECUTABLE}\";${MANDOLINE_MPI_DEFINITIONS}")

# Of Open MPI; others do without.
set(MANDOLINE_MPI_ENVIRONMENT OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  OMPI_MCA_hwloc_base_binding_policy=none)
foreach(processes 2 3)
  foreach(program ${MANDOLINE_MPI_PROGRAMS})
    string(REPLACE mandoline-mpi-pieces mpi${processes} name ${program})
    string(REPLACE mandoline-mpi-flows mpi${processes}flows name ${name})
    add_test(NAME ${name} COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${processes} $<TARGET_FILE:${program}>)
    set_tests_properties(${name} PROPERTIES LABELS mpi ENVIRONMENT "${MANDOLINE_MPI_ENVIRONMENT}" PROCESSORS 2)
  endforeach()
endforeach()
