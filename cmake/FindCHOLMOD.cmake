# SPDX-License-Identifier: MIT
#
# Finds CHOLMOD, the sparse Cholesky factorisation of SuiteSparse, and makes CHOLMOD::CHOLMOD.
# Sets CHOLMOD_FOUND and CHOLMOD_VERSION. SuiteSparse brings its own package file only from version
# 7 on; for older ones we look for the header and the library.
find_package(CHOLMOD QUIET CONFIG)
if(CHOLMOD_FOUND AND TARGET SuiteSparse::CHOLMOD)
  if(NOT TARGET CHOLMOD::CHOLMOD)
    add_library(CHOLMOD::CHOLMOD INTERFACE IMPORTED)
    target_link_libraries(CHOLMOD::CHOLMOD INTERFACE SuiteSparse::CHOLMOD)
  endif()
  return()
endif()

find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)

# The version macros moved from cholmod_core.h to cholmod.h in SuiteSparse 7.
set(CHOLMOD_VERSION "")
foreach(header IN ITEMS cholmod.h cholmod_core.h)
  if(CHOLMOD_INCLUDE_DIR AND EXISTS "${CHOLMOD_INCLUDE_DIR}/${header}" AND NOT CHOLMOD_VERSION)
    file(STRINGS "${CHOLMOD_INCLUDE_DIR}/${header}" version_lines
         REGEX "^#define CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION")
    string(REGEX MATCHALL "[0-9]+" version_numbers "${version_lines}")
    list(JOIN version_numbers "." CHOLMOD_VERSION)
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  CHOLMOD REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR VERSION_VAR CHOLMOD_VERSION)

if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(
    CHOLMOD::CHOLMOD PROPERTIES IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
                                INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")
endif()
