# Images that every emulated MPS2 board has, as executables <what>_<board>.elf. Called in the board's own folder.
set(VERP_MPS2_DIR ${CMAKE_CURRENT_LIST_DIR})

function(verp_add_mps2_image what machine)
  set(image ${what}_${VERP_BOARD})
  add_executable(${image} ${VERP_MPS2_DIR}/${what}_main.cpp ${VERP_MPS2_DIR}/emulator.cpp ${ARGN})
  target_include_directories(${image} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${image} PRIVATE verp_boot verp_app verp_core verp_chip_semihosting verp_warnings)
  target_link_options(${image} PRIVATE -T ${CMAKE_CURRENT_SOURCE_DIR}/memory.ld)
  set_target_properties(${image} PROPERTIES
    SUFFIX .elf
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/images
    CROSSCOMPILING_EMULATOR "${CMAKE_SOURCE_DIR}/tests/target/run_qemu;${machine}"
    LINK_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/memory.ld;${CMAKE_SOURCE_DIR}/firmware/boot/sections.ld")
endfunction()

function(verp_add_mps2_images machine)
  file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/unit/*_test.cpp)
  verp_add_mps2_image(unit ${machine} ${VERP_MPS2_DIR}/newlib.cpp ${tests})
  target_include_directories(unit_${VERP_BOARD} SYSTEM PRIVATE ${CMAKE_SOURCE_DIR}/tests/support/gtest_target)
  add_test(NAME unit.${VERP_BOARD} COMMAND unit_${VERP_BOARD})
  set_tests_properties(unit.${VERP_BOARD} PROPERTIES LABELS "unit;target" TIMEOUT 300)

  verp_add_mps2_image(replay ${machine})
  verp_add_mps2_image(loop ${machine})
  verp_add_mps2_image(link ${machine})
  add_custom_target(benchmarks DEPENDS replay_${VERP_BOARD} link_${VERP_BOARD})  # what `verp bench` runs

  # Tests with a half on the PC: that half comes from a PC build, which must be there.
  set(VERP_HOST_DIR ${CMAKE_SOURCE_DIR}/build/host-release CACHE PATH "PC build whose programs test this board")
  foreach(each replay:TargetReplay loop:ClosedLoop)
    string(REPLACE ":" ";" each "${each}")
    list(GET each 0 name)
    list(GET each 1 suite)
    add_test(NAME ${name}.${VERP_BOARD}
      COMMAND ${VERP_HOST_DIR}/target/target_tests --gtest_filter=${suite}.*)
    set_tests_properties(${name}.${VERP_BOARD} PROPERTIES LABELS "${name};target" TIMEOUT 600)
  endforeach()
  # The long trace of tests/replay: whole where floats are hardware; elsewhere a fifth of each run, and the rest with --full.
  set(trace_ticks 100000)
  if(NOT CMAKE_CXX_FLAGS MATCHES "-mfloat-abi=hard")
    set(trace_ticks 20000)
    add_test(NAME trace_full.${VERP_BOARD} COMMAND ${VERP_HOST_DIR}/target/target_tests --gtest_filter=LongTrace.*)
    set_tests_properties(trace_full.${VERP_BOARD} PROPERTIES LABELS full TIMEOUT 3600
      ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_TEST_TICKS=100000;VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
  endif()
  add_test(NAME trace.${VERP_BOARD} COMMAND ${VERP_HOST_DIR}/target/target_tests --gtest_filter=LongTrace.*)
  set_tests_properties(trace.${VERP_BOARD} PROPERTIES LABELS "replay;target" TIMEOUT 300
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_TEST_TICKS=${trace_ticks};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
  add_test(NAME bench.${VERP_BOARD} COMMAND ${VERP_HOST_DIR}/target/target_bench --check ${VERP_BOARD})
  # Times the link, so it runs alone.
  set_tests_properties(bench.${VERP_BOARD} PROPERTIES LABELS "bench;target" TIMEOUT 600 RUN_SERIAL ON)
  set_tests_properties(replay.${VERP_BOARD} loop.${VERP_BOARD} bench.${VERP_BOARD} PROPERTIES
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()
