# SPDX-License-Identifier: MIT
#
# eigen_alignment(result): EIGEN_MAX_ALIGN_BYTES with the compiler and the flags of this build; empty
# if it cannot be found out. Options of single targets are not seen: src/ checks the result.
function(eigen_alignment result)
  set(unit "${PROJECT_BINARY_DIR}/eigen_alignment.cpp")
  file(WRITE "${unit}" "#include <Eigen/Core>\nstatic_assert(EIGEN_MAX_ALIGN_BYTES == EXPECTED);\n")
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
  if(CMAKE_BUILD_TYPE)
    set(CMAKE_TRY_COMPILE_CONFIGURATION "${CMAKE_BUILD_TYPE}")
  endif()
  foreach(bytes IN ITEMS 16 32 64 8 0)
    try_compile(
      is_so "${PROJECT_BINARY_DIR}/eigen_alignment" "${unit}"
      COMPILE_DEFINITIONS "-DEXPECTED=${bytes}"
      LINK_LIBRARIES Eigen3::Eigen
      CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON)
    if(is_so)
      set(${result} ${bytes} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${result} "" PARENT_SCOPE)
endfunction()
