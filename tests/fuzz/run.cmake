# SPDX-License-Identifier: MIT
#
#   cmake -DPROGRAM=… -DTARGET=small_qp -DINPUTS=tests/fuzz -DOUTPUT=folder -DRUNS=10000 -P run.cmake
#
# All inputs that are kept, one run of the program, then so many new ones, the same ones every time
# (on a slow machine as many as a minute allows). An input that fails is in OUTPUT/failed: once
# mended it belongs into tests/fuzz/found/<target>/.
file(REMOVE_RECURSE "${OUTPUT}")
file(MAKE_DIRECTORY "${OUTPUT}/new" "${OUTPUT}/failed")
file(GLOB kept "${INPUTS}/corpus/${TARGET}/*" "${INPUTS}/found/${TARGET}/*")
set(limits -rss_limit_mb=2048 -timeout=20 "-artifact_prefix=${OUTPUT}/failed/")
execute_process(COMMAND "${PROGRAM}" ${limits} ${kept} RESULT_VARIABLE status ERROR_VARIABLE said)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "an input of ${INPUTS}/{corpus,found}/${TARGET} fails\n${said}")
endif()
execute_process(
  COMMAND "${PROGRAM}" ${limits} -seed=1 -reload=0 -max_len=1024 -runs=${RUNS}
          -max_total_time=60 -print_final_stats=1 "${OUTPUT}/new" "${INPUTS}/corpus/${TARGET}"
  RESULT_VARIABLE status ERROR_VARIABLE said)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "a new input fails; it is in ${OUTPUT}/failed\n${said}")
endif()
string(REGEX MATCH "number_of_executed_units: *[0-9]+" executed "${said}")
message(STATUS "${TARGET}: ${executed}")
