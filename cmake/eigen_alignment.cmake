# SPDX-License-Identifier: MIT
#
# eigen_alignment(result): EIGEN_MAX_ALIGN_BYTES with the compiler and the flags of this build.
function(eigen_alignment result)
  get_target_property(includes Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
  list(TRANSFORM includes PREPEND "-I")
  set(unit "${PROJECT_BINARY_DIR}/eigen_alignment.cpp")
  file(WRITE "${unit}" "#include <Eigen/Core>\nalignment: EIGEN_MAX_ALIGN_BYTES\n")
  string(TOUPPER "${CMAKE_BUILD_TYPE}" config)
  separate_arguments(flags UNIX_COMMAND "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${config}}")
  execute_process(
    COMMAND "${CMAKE_CXX_COMPILER}" -std=c++20 ${flags} ${includes} -E -P "${unit}"
    OUTPUT_VARIABLE text
    ERROR_VARIABLE messages
    RESULT_VARIABLE status)
  if(NOT status STREQUAL "0" OR NOT text MATCHES "alignment: ([0-9]+)")
    message(FATAL_ERROR "the alignment of Eigen's arrays cannot be found out:\n${messages}")
  endif()
  set(${result} ${CMAKE_MATCH_1} PARENT_SCOPE)
endfunction()
