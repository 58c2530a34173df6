# SPDX-License-Identifier: MIT
#
# How much text the compiler has to read behind an include:
#   cmake -DSOURCE=folder -DBINARY=folder -DCOMPILER=path -DFLAGS=response_file -P weight.cmake
#
# In characters after preprocessing, relative to a header of Eigen; the same on every run, unlike
# seconds. Each header of sets/ may add a tenth to <Eigen/Core>, <slant/slant.hpp> a half to
# <Eigen/Sparse>, which contact may double. So a heavy header of the standard library or of Boost is noticed when it comes in.

cmake_minimum_required(VERSION 3.25)

# weight(header result): characters after preprocessing.
function(weight header result)
  set(unit "${BINARY}/weight.cpp")
  file(WRITE "${unit}" "#include <${header}>\n")
  execute_process(
    COMMAND "${COMPILER}" "@${FLAGS}" -E -P "${unit}"
    RESULT_VARIABLE status
    OUTPUT_VARIABLE text
    ERROR_VARIABLE messages)
  if(NOT status STREQUAL "0")
    message(FATAL_ERROR "<${header}> cannot be preprocessed:\n${messages}")
  endif()
  string(LENGTH "${text}" length)
  set(${result} ${length} PARENT_SCOPE)
endfunction()

# limit(header reference percent)
function(limit header reference percent)
  weight("${header}" own)
  math(EXPR share "100 * ${own} / ${weight_of_${reference}}")
  message(STATUS "<${header}>: ${share} % of <${reference}>, at most ${percent} %")
  if(share GREATER percent)
    message(FATAL_ERROR "<${header}> includes too much")
  endif()
endfunction()

weight(Eigen/Core weight_of_Eigen/Core)
weight(Eigen/Sparse weight_of_Eigen/Sparse)

file(GLOB sets RELATIVE "${SOURCE}/include" "${SOURCE}/include/slant/sets/*.hpp")
list(REMOVE_ITEM sets slant/sets/sets.hpp)
foreach(set_header IN LISTS sets)
  limit("${set_header}" Eigen/Core 110)
endforeach()
limit(slant/slant.hpp Eigen/Sparse 150)
limit(slant/contact/contact.hpp Eigen/Sparse 200)
