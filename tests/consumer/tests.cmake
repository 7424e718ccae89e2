# A project that uses the library, in each of the ways there are. All have to get the bits that this build's own library gives.
#   static, as this build made it:  find_package, pkg-config, a module for Python
#   from source:                    FetchContent, without optimisation and fast_float, as shared libraries, in a project that hides its symbols
#                                   and compiles folders as one (CMAKE_UNITY_BUILD) with -ffast-math -Werror; add_subdirectory, which is not
#                                   compiled once more
#   shared, as the latter installs: find_package, pkg-config
add_executable(mandoline-reference consumer/consumer.cpp)
target_link_libraries(mandoline-reference PRIVATE mandoline_io)
if(TARGET mandoline_operators)
  target_link_libraries(mandoline-reference PRIVATE mandoline_operators)
  target_compile_definitions(mandoline-reference PRIVATE WITH_OPERATORS)
endif()
find_program(MANDOLINE_PKG_CONFIG pkg-config)
find_program(MANDOLINE_PYTHON python3)
set(folder ${CMAKE_CURRENT_BINARY_DIR}/consumer)

function(add_consumer_test name step)
  add_test(NAME consumer_${name} COMMAND ${CMAKE_COMMAND} -D STEP=${step} -D WORK=${folder}/${name} -D SOURCE=${PROJECT_SOURCE_DIR}
    -D CXX=${CMAKE_CXX_COMPILER} -D REFERENCE=$<TARGET_FILE:mandoline-reference> -D CONFIG=$<CONFIG> -D PKG_CONFIG=${MANDOLINE_PKG_CONFIG}
    ${ARGN} -P ${CMAKE_CURRENT_SOURCE_DIR}/consumer/run.cmake)
endfunction()
function(add_tests_of_installed kind)
  add_consumer_test(find_package_${kind} find_package -D PREFIX=${folder}/prefix_${kind})
  set_tests_properties(consumer_find_package_${kind} PROPERTIES FIXTURES_REQUIRED prefix_${kind})
  if(MANDOLINE_PKG_CONFIG)
    add_consumer_test(pkg_config_${kind} pkg-config -D PREFIX=${folder}/prefix_${kind} ${ARGN})
    set_tests_properties(consumer_pkg_config_${kind} PROPERTIES FIXTURES_REQUIRED prefix_${kind})
  endif()
endfunction()

add_consumer_test(add_subdirectory add_subdirectory)
string(JOIN "\\;" fetch_options -DBUILD_SHARED_LIBS=ON -DMANDOLINE_INSTALL=ON -DMANDOLINE_BUILD_CLI=ON
  -DCMAKE_DISABLE_FIND_PACKAGE_FastFloat=ON -DCMAKE_UNITY_BUILD=ON
  "-DCMAKE_CXX_FLAGS=-O0 -ffast-math -Werror -fvisibility=hidden")
add_consumer_test(FetchContent FetchContent -D MORE_TARGETS=mandoline-cli -D "OPTIONS=${fetch_options}")
set_tests_properties(consumer_FetchContent PROPERTIES FIXTURES_SETUP shared)

add_consumer_test(prefix_static install -D FROM=${PROJECT_BINARY_DIR})
set_tests_properties(consumer_prefix_static PROPERTIES FIXTURES_SETUP prefix_static)
add_tests_of_installed(static -D KIND=--static)
add_consumer_test(python find_package -D PREFIX=${folder}/prefix_static -D PYTHON=${MANDOLINE_PYTHON})
set_tests_properties(consumer_python PROPERTIES FIXTURES_REQUIRED prefix_static SKIP_REGULAR_EXPRESSION "skipped: ")
add_consumer_test(prefix_shared move -D FROM=${folder}/FetchContent)
set_tests_properties(consumer_prefix_shared PROPERTIES FIXTURES_REQUIRED shared FIXTURES_SETUP prefix_shared)
add_tests_of_installed(shared)

add_consumer_test(cxx17 c++17)

# Sources refuse to compile where flags have taken plain arithmetic away.
set(compile ${CMAKE_CXX_COMPILER} -std=c++20 -I${PROJECT_SOURCE_DIR}/src -I${PROJECT_SOURCE_DIR}/src/include -fsyntax-only)
add_test(NAME refuses_fast_math COMMAND ${compile} -ffast-math ${PROJECT_SOURCE_DIR}/src/base/exact.cpp)
set_tests_properties(refuses_fast_math PROPERTIES PASS_REGULAR_EXPRESSION "has to be compiled without -ffast-math")
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  add_test(NAME refuses_x87 COMMAND ${compile} -mfpmath=387 ${PROJECT_SOURCE_DIR}/src/base/exact.cpp)
  set_tests_properties(refuses_x87 PROPERTIES PASS_REGULAR_EXPRESSION "rounds to double each time")
endif()
