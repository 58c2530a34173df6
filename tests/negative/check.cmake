# SPDX-License-Identifier: MIT
#
# Checks one program that must not compile:
#   cmake -DCOMPILER=path -DKIND=gcc|clang -DFLAGS=response_file -DFIRST=header -DCASE=file.cpp -P check.cmake
#
# The file is a complete model minus exactly one thing. That thing stands between
# #ifdef SLANT_COMPLETE and #endif, and the first lines of the file say what the reader must be told:
#   // expect: <regular expression of CMake, matched against the whole output>
#   // expect-clang: <the same for clang, where its wording differs>      (optional)
#   // max-lines-gcc: 20                                                  (optional)
#   // max-lines-clang: 30                                                (optional)
#   // first: nothing      where FIRST must not be included                (optional)
# Demanded: without SLANT_COMPLETE the compiler fails, its output matches and is not longer than
# allowed, but for the ways by which headers were included; with it, the same file compiles. So the one missing thing is the only cause. The latter is
# asked of g++ only, which takes half of the time: the message is what differs between compilers.

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

# compile(definition status output): warnings are off, for they are not what is asked here.
function(compile definition status output)
  set(ENV{LC_ALL} C)  # plain quotes in the messages
  execute_process(
    COMMAND "${COMPILER}" "@${FLAGS}" -fsyntax-only -w -fdiagnostics-color=never ${include_first}
            ${definition} "${CASE}"
    RESULT_VARIABLE code
    OUTPUT_VARIABLE text
    ERROR_VARIABLE text)
  set(${status} "${code}" PARENT_SCOPE)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

directive(expect expected)
directive(expect-clang expected_of_clang)
directive("max-lines-${KIND}" line_limit)
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
if(NOT text MATCHES "#ifdef SLANT_COMPLETE")
  fail("nothing is marked as missing by SLANT_COMPLETE")
endif()

compile("" status output)
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

if(NOT KIND STREQUAL "clang" OR CASE MATCHES "/self_check/")
  compile(-DSLANT_COMPLETE status complete_output)
  if(NOT status STREQUAL "0")
    fail("the complete model does not compile either:\n${complete_output}")
  endif()
endif()
message(STATUS "${lines} lines of output, as expected: ${expected}")
