# Tests that need CAN sockets share runs of tests/support/with-can; then each reports its own result.
#
#   verp_can_test(START NAME PROGRAM ARGUMENT...)   PROGRAM may be a generator expression. START is
#                                                     start: tests that wait for answers, however long they take
#                                                     slow: robots in real time; the clock inside runs at 1/3 speed
#                                                     start.full, slow.full: likewise, for `./verp test --full`
#   verp_can_split(START NAME TARGET TESTS)         NAME runs these TESTS (of GoogleTest, separated by `:`), and
#                                                     NAME.more the target's others with --full
#   verp_can_tests_end()                            call once, after all tests
#
# VERP_CAN_ONLY='NAME NAME' ctest -R ...  runs only those tests.
function(verp_can_test start name)
  list(TRANSFORM ARGN REPLACE "(.+)" "'\\1'" OUTPUT_VARIABLE words)
  list(JOIN words " " command)
  set_property(GLOBAL APPEND_STRING PROPERTY VERP_CAN_BATCH_${start} "run ${name} ${command}\n")
  add_test(NAME ${name} COMMAND ${CMAKE_SOURCE_DIR}/tests/can/result ${CMAKE_BINARY_DIR}/can/${start} ${name})
  verp_can_labels(${start})
  set_tests_properties(${name} PROPERTIES LABELS "${labels}" FIXTURES_REQUIRED can_${start} REQUIRED_FILES ${ARGV2})
endfunction()

function(verp_can_split start name target tests)
  verp_can_test(${start} ${name} $<TARGET_FILE:${target}> --gtest_filter=${tests})
  verp_can_test(${start}.full ${name}.more $<TARGET_FILE:${target}> --gtest_filter=-${tests})
endfunction()

macro(verp_can_labels start)
  set(labels "hil-can;vm")
  if(${start} MATCHES "full$")
    list(APPEND labels full)
  endif()
endmacro()

function(verp_can_tests_begin start)
  get_property(batch GLOBAL PROPERTY VERP_CAN_BATCH_${start})
  if(NOT batch)
    return()
  endif()
  set(folder ${CMAKE_BINARY_DIR}/can/${start})
  file(GENERATE OUTPUT ${folder}/batch CONTENT "${batch}")
  add_test(NAME can.${start} COMMAND ${CMAKE_SOURCE_DIR}/tests/support/with-can --timeout 1700 ${ARGN}
    --writable ${folder} ${CMAKE_SOURCE_DIR}/tests/can/run_batch ${folder})
  # RUN_SERIAL: some tests use wall-clock time. TIMEOUT: they are many.
  verp_can_labels(${start})
  set_tests_properties(can.${start} PROPERTIES LABELS "${labels}" FIXTURES_SETUP can_${start} RUN_SERIAL TRUE TIMEOUT 1750)
endfunction()

function(verp_can_tests_end)
  verp_can_tests_begin(start)
  verp_can_tests_begin(start.full)
  verp_can_tests_begin(slow --slow 3)
  verp_can_tests_begin(slow.full --slow 3)
endfunction()
