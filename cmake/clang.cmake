# SPDX-License-Identifier: MIT
#
# Toolchain file: the newest installed clang++, at least version 16. Older ones cannot compile the
# constrained templates of the standard library that comes with g++ 12. A compiler given by
# -DCMAKE_CXX_COMPILER=… is left alone.
if(DEFINED CMAKE_CXX_COMPILER)
  return()
endif()
find_program(
  SLANT_CLANGXX
  NAMES clang++-22 clang++-21 clang++-20 clang++-19 clang++-18 clang++-17 clang++-16 clang++
  REQUIRED)
execute_process(COMMAND "${SLANT_CLANGXX}" -dumpversion OUTPUT_VARIABLE version
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(version VERSION_LESS 16)
  message(FATAL_ERROR "${SLANT_CLANGXX} is version ${version}, but slant needs at least 16")
endif()
set(CMAKE_CXX_COMPILER "${SLANT_CLANGXX}")
