# SPDX-License-Identifier: MIT
#
# Checks one program that must not compile:
#   cmake -DCOMPILER=path -DKIND=gcc|clang -DFLAGS=response_file -DFIRST=header -DCASE=file.cpp
#         [-DWITH="SOLVER=qpc WITHOUT_LAWS"] [-DTWIN=ON] -P check.cmake
#
# The file is a complete model minus exactly one thing. That thing stands between
# #ifdef SLANT_COMPLETE and #endif, and the first lines of the file say what the reader must be told:
#   // expect: <regular expression of CMake, matched against the whole output>
#   // expect-clang: <the same for clang, where its wording differs>      (optional)
#   // max-lines-gcc: 20                                                  (optional)
#   // max-lines-clang: 30                                                (optional)
#   // first: nothing      where FIRST must not be included                (optional)
# A file may serve several cases. It lists what is defined for each, and what it says; a definition with
# `=` makes the complete model, one without takes something away from it:
#   // case SOLVER=qpc WITHOUT_LAWS: <regular expression>
#   // case SOLVER=qpc WITHOUT_LAWS, clang: <where clang words it differently>   (optional)
#   // case SOLVER=qpc WITHOUT_LAWS, max-lines-gcc: 15          (optional, and for clang)
# Demanded: without SLANT_COMPLETE, or with all that is defined for the case, the compiler fails, its
# output matches and is not longer than allowed, but for the ways by which headers were included; the
# complete model compiles, if TWIN is set. So the one missing thing is the only cause. The latter is asked
# of g++ only, which takes half of the time: the message is what differs between compilers.

cmake_minimum_required(VERSION 3.25)

file(READ "${CASE}" text)

function(fail reason)
  message("${reason}")  # as it is: FATAL_ERROR would break and indent the lines
  message(FATAL_ERROR "${CASE}")
endfunction()

# directive(name result): the rest of the line "// name: …", or nothing.
function(directive name result)
  if(text MATCHES "(^|\n)// ${name}:[ \t]*([^\n]+)")
    string(STRIP "${CMAKE_MATCH_2}" value)
    set(${result} "${value}" PARENT_SCOPE)
  else()
    set(${result} "" PARENT_SCOPE)
  endif()
endfunction()

# compile(definitions status output): warnings are off, for they are not what is asked here.
function(compile definitions status output)
  set(ENV{LC_ALL} C)  # plain quotes in the messages
  execute_process(
    COMMAND "${COMPILER}" "@${FLAGS}" -fsyntax-only -w -fdiagnostics-color=never ${include_first}
            ${definitions} "${CASE}"
    RESULT_VARIABLE code
    OUTPUT_VARIABLE text
    ERROR_VARIABLE text)
  set(${status} "${code}" PARENT_SCOPE)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# What is defined without and with what is missing.
if(WITH)
  string(REPLACE " " ";-D" incomplete "-D${WITH}")
  set(complete ${incomplete})
  list(FILTER complete INCLUDE REGEX "=")
  directive("case ${WITH}" expected)
  directive("case ${WITH}, clang" expected_of_clang)
  directive("case ${WITH}, max-lines-${KIND}" line_limit)
else()
  set(incomplete "")
  set(complete -DSLANT_COMPLETE)
  directive(expect expected)
  directive(expect-clang expected_of_clang)
endif()
if(NOT line_limit)
  directive("max-lines-${KIND}" line_limit)
endif()
if(KIND STREQUAL "clang" AND NOT expected_of_clang STREQUAL "")
  set(expected "${expected_of_clang}")
endif()
directive(first first)
set(include_first "")
if(NOT first STREQUAL "nothing")
  set(include_first -include "${FIRST}")
endif()
if(expected STREQUAL "")
  fail("no line '// expect: …'")
endif()
if(NOT WITH AND NOT text MATCHES "#ifdef SLANT_COMPLETE")
  fail("nothing is marked as missing by SLANT_COMPLETE")
endif()

compile("${incomplete}" status output)
if(status STREQUAL "0")
  fail("compiled although something is missing")
endif()
if(NOT output MATCHES "${expected}")
  fail("failed, but the output does not match '${expected}':\n${output}")
endif()
string(REGEX REPLACE "(In file included| +) from [^\n]*[,:]\n" "" message "${output}")
string(REGEX MATCHALL "\n" line_ends "${message}")
list(LENGTH line_ends lines)
if(NOT line_limit STREQUAL "" AND lines GREATER line_limit)
  fail("${lines} lines of output, at most ${line_limit} allowed:\n${output}")
endif()

if(TWIN AND (NOT KIND STREQUAL "clang" OR CASE MATCHES "/self_check/"))
  compile("${complete}" status complete_output)
  if(NOT status STREQUAL "0")
    fail("the complete model does not compile either:\n${complete_output}")
  endif()
endif()
message(STATUS "${lines} lines of output, as expected: ${expected}")
