# SPDX-License-Identifier: MIT
#
#   cmake -DCHECK=same_bits -DFIRST=program -DSECOND=program -P check.cmake
#   cmake -DCHECK=instances -DNM=nm -DOBJECT=file -DASKS=regex -DOWN=regex -P check.cmake
cmake_minimum_required(VERSION 3.25)

if(CHECK STREQUAL "same_bits")
  execute_process(COMMAND "${FIRST}" OUTPUT_VARIABLE first COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND "${SECOND}" OUTPUT_VARIABLE second COMMAND_ERROR_IS_FATAL ANY)
  if(NOT first STREQUAL second)
    message(FATAL_ERROR "with the component:\n${first}\nwithout:\n${second}")
  endif()
  if(NOT first MATCHES "0x1")
    message(FATAL_ERROR "expected numbers, got\n${first}")
  endif()
else()
  execute_process(COMMAND "${NM}" -C "${OBJECT}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  if(NOT symbols MATCHES " U [^\n]*${ASKS}")
    message(FATAL_ERROR "the object does not ask for ${ASKS}")
  endif()
  if(symbols MATCHES " [TWVu] ([^\n]*(${OWN})[^\n]*)")
    message(FATAL_ERROR "the object has an instance of its own: ${CMAKE_MATCH_1}")
  endif()
endif()
