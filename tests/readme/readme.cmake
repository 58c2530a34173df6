# SPDX-License-Identifier: MIT
#
# Compares the blocks of README.md and of the pages in docs/ with what they were taken from:
#   cmake -DCHECK=code|output|error -DSOURCE=folder -DPROGRAM=path -DCOMPILER=path
#         -DFLAGS=response_file -P readme.cmake
#
# A block to be compared stands below a comment that says what it is, such as
#   <!-- the file examples/first_steps/main.cpp -->
#
# Texts are never made into lists: brackets and semicolons would not survive that.

cmake_minimum_required(VERSION 3.25)
set(ENV{LC_ALL} C)  # plain quotes in the messages of compilers

file(READ "${SOURCE}/README.md" readme)
file(GLOB_RECURSE pages "${SOURCE}/docs/*.md")
foreach(page IN LISTS pages)
  file(READ "${page}" text)
  string(APPEND readme "\n${text}")
endforeach()

# shown_block(comment result): the text between the lines ``` after <!-- comment -->.
function(shown_block comment result)
  set(mark "<!-- ${comment} -->\n```")
  string(FIND "${readme}" "${mark}" begin)
  if(begin EQUAL -1)
    message(FATAL_ERROR "neither README.md nor docs/ has a block below <!-- ${comment} -->")
  endif()
  string(SUBSTRING "${readme}" ${begin} -1 rest)
  string(LENGTH "${mark}" length)
  string(SUBSTRING "${rest}" ${length} -1 rest)
  string(FIND "${rest}" "\n" line_end)
  math(EXPR line_end "${line_end} + 1")
  string(SUBSTRING "${rest}" ${line_end} -1 rest)
  string(FIND "${rest}" "```" end)
  string(SUBSTRING "${rest}" 0 ${end} text)
  if(text STREQUAL "")
    message(FATAL_ERROR "the block below <!-- ${comment} --> is empty")
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# demand_same(what shown actual)
function(demand_same what shown actual)
  if(NOT shown STREQUAL actual)
    message(FATAL_ERROR "README.md and docs/ do not show ${what}, which is now:\n${actual}")
  endif()
endfunction()

# demand_part(what shown whole)
function(demand_part what shown whole)
  string(FIND "${whole}" "${shown}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "this is no part of ${what}:\n${shown}\nwhich is now:\n${whole}")
  endif()
endfunction()

if(CHECK STREQUAL "code")
  set(name examples/first_steps/main.cpp)
  shown_block("the file ${name}" shown)
  file(READ "${SOURCE}/${name}" actual)
  demand_same("${name}" "// SPDX-License-Identifier: MIT\n${shown}" "${actual}")
  file(GLOB tests RELATIVE "${SOURCE}" "${SOURCE}/tests/readme/*_test.cpp")
  foreach(name IN LISTS tests ITEMS examples/first_steps/main.cpp)
    shown_block("part of the file ${name}" shown)
    file(READ "${SOURCE}/${name}" actual)
    demand_part("${name}" "${shown}" "${actual}")
  endforeach()

elseif(CHECK STREQUAL "output")
  shown_block("the output of first_steps" shown)
  execute_process(COMMAND "${PROGRAM}" OUTPUT_VARIABLE actual RESULT_VARIABLE status)
  if(NOT status STREQUAL "0")
    message(FATAL_ERROR "first_steps ended with status ${status}")
  endif()
  demand_same("what first_steps prints" "${shown}" "${actual}")

elseif(CHECK STREQUAL "error")
  set(name tests/readme/wrong_operator.cpp)
  shown_block("part of what g++ says about ${name}" shown)
  execute_process(
    COMMAND "${COMPILER}" "@${FLAGS}" -fsyntax-only -fdiagnostics-color=never "${SOURCE}/${name}"
    RESULT_VARIABLE status
    ERROR_VARIABLE actual)
  if(status STREQUAL "0")
    message(FATAL_ERROR "${name} compiles")
  endif()
  while(NOT shown STREQUAL "")
    string(FIND "${shown}" "\n" line_end)
    string(SUBSTRING "${shown}" 0 ${line_end} line)
    demand_part("what the compiler says" "${line}" "${actual}")
    math(EXPR line_end "${line_end} + 1")
    string(SUBSTRING "${shown}" ${line_end} -1 shown)
  endwhile()

else()
  message(FATAL_ERROR "CHECK is code, output or error")
endif()
