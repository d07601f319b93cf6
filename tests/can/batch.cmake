# Tests that need CAN sockets share one start of tests/support/with-can: the test `can.start` runs them all in there, one
# after another, and each test then shows what its own run said.
#
#   verp_can_test(NAME PROGRAM ARGUMENT...)   PROGRAM may be a generator expression
#   verp_can_tests_end()                              once, behind all of them
#
# VERP_CAN_ONLY='NAME NAME' ctest -R ...  starts only those.
function(verp_can_test name)
  list(TRANSFORM ARGN REPLACE "(.+)" "'\\1'" OUTPUT_VARIABLE words)
  list(JOIN words " " command)
  set_property(GLOBAL APPEND_STRING PROPERTY VERP_CAN_BATCH "run ${name} ${command}\n")
  add_test(NAME ${name} COMMAND ${CMAKE_SOURCE_DIR}/tests/can/result ${CMAKE_BINARY_DIR}/can ${name})
  set_tests_properties(${name} PROPERTIES LABELS "hil-can;vm" FIXTURES_REQUIRED can_start)
endfunction()

function(verp_can_tests_end)
  get_property(batch GLOBAL PROPERTY VERP_CAN_BATCH)
  if(NOT batch)
    return()
  endif()
  file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/can/batch CONTENT "${batch}")
  add_test(NAME can.start COMMAND ${CMAKE_SOURCE_DIR}/tests/support/with-can --timeout 1700
    --writable ${CMAKE_BINARY_DIR}/can ${CMAKE_SOURCE_DIR}/tests/can/run_batch ${CMAKE_BINARY_DIR}/can)
  # RUN_SERIAL: some go by the clock on the wall. TIMEOUT: it is many tests, and a PC that is busy is slow in each.
  set_tests_properties(can.start PROPERTIES LABELS "hil-can;vm" FIXTURES_SETUP can_start RUN_SERIAL TRUE TIMEOUT 1750)
endfunction()
