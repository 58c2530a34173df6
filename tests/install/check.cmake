# SPDX-License-Identifier: MIT
#
# cmake -DBUILD=… -DSOURCE=… -DCOMPILER=… -DGENERATOR=… -DMAKE_PROGRAM=… -DLAUNCHER=… -DCOMPONENTS=…
#       -P check.cmake
cmake_minimum_required(VERSION 3.25)

set(work "${BUILD}/install_test")
set(prefix "${work}/prefix")
file(REMOVE_RECURSE "${work}")

execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}" OUTPUT_QUIET
                COMMAND_ERROR_IS_FATAL ANY)

# Every header of both base directories is there under <slant/…>, and nothing else; only those of a
# component that was not built may be absent.
file(GLOB_RECURSE in_concepts RELATIVE "${SOURCE}/concepts" "${SOURCE}/concepts/*.hpp")
file(GLOB_RECURSE in_include RELATIVE "${SOURCE}/include" "${SOURCE}/include/*.hpp")
set(expected ${in_concepts} ${in_include})
if(NOT "cholmod" IN_LIST COMPONENTS)
  list(FILTER expected EXCLUDE REGEX "^slant/factorizations/(parts/)?cholmod")
endif()
if(NOT "vtu" IN_LIST COMPONENTS)
  list(REMOVE_ITEM expected slant/io/vtu.hpp)
endif()
if(NOT "testing" IN_LIST COMPONENTS)
  list(FILTER expected EXCLUDE REGEX "^slant/testing/[^/]*_laws[.]hpp$")
endif()
file(GLOB_RECURSE installed RELATIVE "${prefix}/include" "${prefix}/include/*")
list(SORT expected)
list(SORT installed)
if(NOT expected STREQUAL installed)
  message("expected: ${expected}\ninstalled: ${installed}")
  message(FATAL_ERROR "the installed headers are not those of the repository")
endif()

execute_process(
  COMMAND
    "${CMAKE_COMMAND}" -S "${SOURCE}/tests/install/consumer" -B "${work}/build" -G "${GENERATOR}"
    "-DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM}" "-DCMAKE_CXX_COMPILER=${COMPILER}"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_CXX_FLAGS=${FLAGS}" "-DCMAKE_PREFIX_PATH=${prefix}"
    "-DEXPECTED_PREFIX=${prefix}" "-DCOMPONENTS=${COMPONENTS}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${CMAKE_COMMAND}" --build "${work}/build" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${work}/build/consumer" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${work}/build/precompiled_consumer" COMMAND_ERROR_IS_FATAL ANY)
