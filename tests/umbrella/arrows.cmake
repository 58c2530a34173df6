# SPDX-License-Identifier: MIT
#
# Rooms include rooms to their left in the drawing of CONTRIBUTING.md, and no parts/ of another:
#   cmake -DSOURCE=folder -P arrows.cmake

cmake_minimum_required(VERSION 3.25)

file(STRINGS "${SOURCE}/CONTRIBUTING.md" drawing ENCODING UTF-8 REGEX "^    concepts ←")
string(REPLACE "←" ";" tiers "${drawing}")
set(height 0)
foreach(tier IN LISTS tiers)
  math(EXPR height "${height} + 1")
  string(REGEX MATCHALL "[a-z]+" rooms "${tier}")
  foreach(room IN LISTS rooms)
    set(height_of_${room} ${height})
  endforeach()
endforeach()

set(wrong "")
file(GLOB_RECURSE headers "${SOURCE}/include/slant/*/*.hpp" "${SOURCE}/concepts/slant/*/*.hpp")
foreach(header IN LISTS headers)
  string(REGEX REPLACE "^.*/(include|concepts)/slant/" "" name "${header}")
  string(REGEX MATCH "^[a-z]+" room "${name}")
  file(STRINGS "${header}" includes REGEX "^#include <[A-Za-z]+/")
  foreach(line IN LISTS includes)
    string(REGEX MATCH "<slant/([a-z]+)/(.*)>" included "${line}")
    set(other "${CMAKE_MATCH_1}")
    if(other STREQUAL room OR (NOT included AND NOT room STREQUAL "concepts"))
      continue()
    endif()
    if(NOT included OR NOT height_of_${room} OR NOT height_of_${other}
       OR height_of_${other} GREATER_EQUAL height_of_${room} OR CMAKE_MATCH_2 MATCHES "^parts/")
      list(APPEND wrong "${name}: ${line}")
    endif()
  endforeach()
endforeach()
if(wrong OR height LESS 2 OR NOT headers)
  list(JOIN wrong "\n  " text)
  message(FATAL_ERROR "against the drawing in CONTRIBUTING.md:\n  ${text}")
endif()
