# SPDX-License-Identifier: MIT
#
# Follows the include lines from <slant/slant.hpp> and from the umbrella headers of the other folders
# on, and names the headers that are not reached:
#   cmake -DSOURCE=folder -P complete.cmake

cmake_minimum_required(VERSION 3.25)

set(left_out "^slant/(testing/.*|io/vtu\\.hpp|operators/timed\\.hpp)$")

set(all "")
foreach(base IN ITEMS include concepts)
  file(GLOB_RECURSE headers RELATIVE "${SOURCE}/${base}" "${SOURCE}/${base}/slant/*.hpp")
  foreach(header IN LISTS headers)
    set(folder_of_${header} "${SOURCE}/${base}")
  endforeach()
  list(APPEND all ${headers})
endforeach()

set(waiting
    slant/slant.hpp slant/contact/contact.hpp slant/operators/describe.hpp slant/factorizations/factorizations.hpp slant/io/io.hpp
    slant/iteration/iterates.hpp slant/operators/range_sum.hpp slant/sets/block_range.hpp)
set(reached "")
while(waiting)
  list(POP_FRONT waiting header)
  if(header IN_LIST reached)
    continue()
  endif()
  if(NOT header IN_LIST all)
    message(FATAL_ERROR "<${header}> is included but does not exist")
  endif()
  list(APPEND reached ${header})
  file(STRINGS "${folder_of_${header}}/${header}" includes REGEX "^#include <slant/.*>")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^#include <(.*)>.*" "\\1" included "${line}")
    list(APPEND waiting ${included})
  endforeach()
endwhile()

set(wrong "")
foreach(header IN LISTS all)
  if(header MATCHES "${left_out}" AND header IN_LIST reached)
    list(APPEND wrong "reached, though it is to be left out: <${header}>")
  elseif(NOT header MATCHES "${left_out}" AND NOT header IN_LIST reached)
    list(APPEND wrong "not reached; add it to the umbrella of its folder: <${header}>")
  endif()
endforeach()
if(wrong)
  list(JOIN wrong "\n  " text)
  message(FATAL_ERROR "<slant/slant.hpp>\n  ${text}")
endif()
list(LENGTH reached count)
message(STATUS "<slant/slant.hpp> reaches ${count} headers")
