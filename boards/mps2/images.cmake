# Images <what>_<board>.elf for emulated boards, by semihosting. Called in the board's folder.
set(VERP_MPS2_DIR ${CMAKE_CURRENT_LIST_DIR})
set(VERP_GTEST_TARGET_DIR ${CMAKE_SOURCE_DIR}/tests/support/gtest_target)  # test support on boards
include(${CMAKE_SOURCE_DIR}/tests/together.cmake)

# <name>_<board>.elf from <what>_main.cpp and further sources; `machine` is QEMU's.
function(verp_add_emulated_image name what machine)
  set(image ${name}_${VERP_BOARD})
  set(folder ${VERP_MPS2_DIR})
  if(what STREQUAL unit)
    set(folder ${VERP_GTEST_TARGET_DIR})
  endif()
  add_executable(${image} ${folder}/${what}_main.cpp ${ARGN})
  if(NOT what STREQUAL fault)  # has its own exit
    target_sources(${image} PRIVATE ${VERP_MPS2_DIR}/emulator.cpp)
  endif()
  target_include_directories(${image} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${image} PRIVATE verp_boot verp_law verp_app verp_core verp_chip_semihosting verp_warnings)
  target_link_options(${image} PRIVATE -T ${CMAKE_CURRENT_SOURCE_DIR}/memory.ld -Wl,--defsym,verp_test_image=1)
  set_target_properties(${image} PROPERTIES
    SUFFIX .elf
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/images
    CROSSCOMPILING_EMULATOR "${CMAKE_SOURCE_DIR}/tests/target/run_qemu;${machine}"
    LINK_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/memory.ld;${CMAKE_SOURCE_DIR}/firmware/boot/sections.ld")
endfunction()

# <name>_<board>.elf runs the unit tests in `VERP_WITH`'s sources; ctest name: `test`.
function(verp_add_unit_image name test machine)
  set(library newlib.cpp)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL riscv32)
    list(APPEND library riscv_library.cpp)
  endif()
  list(TRANSFORM library PREPEND ${VERP_GTEST_TARGET_DIR}/)
  verp_add_emulated_image(${name} unit ${machine} ${library} ${VERP_WITH} ${ARGN})
  verp_compile_together(${name}_${VERP_BOARD} ${ARGN})
  target_include_directories(${name}_${VERP_BOARD} SYSTEM PRIVATE ${VERP_GTEST_TARGET_DIR})
  add_test(NAME ${test} COMMAND ${name}_${VERP_BOARD})
  set_tests_properties(${test} PROPERTIES LABELS "unit;target")
endfunction()

# All unit tests in one image, for boards with much memory.
function(verp_add_unit_tests machine)
  file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/unit/*_test.cpp)
  verp_add_unit_image(unit unit.${VERP_BOARD} ${machine} ${tests})
endfunction()

# One image per folder, for boards whose RAM holds one folder's variables only.
function(verp_add_unit_tests_by_folder machine)
  file(GLOB folders CONFIGURE_DEPENDS LIST_DIRECTORIES true ${CMAKE_SOURCE_DIR}/tests/unit/*)
  foreach(folder ${folders})
    file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${folder}/*_test.cpp)
    if(tests)
      cmake_path(GET folder FILENAME module)
      verp_add_unit_image(unit_${module} unit.${VERP_BOARD}.${module} ${machine} ${tests})
    endif()
  endforeach()
endfunction()

# tests/contract against the fakes and, where emulators lack the hardware, drivers against chip models. CAN has its own
# image: one chip's RAM does not hold both models.
function(verp_add_contract_tests machine)
  file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/contract/*_test.cpp)
  file(GLOB models CONFIGURE_DEPENDS
    ${CMAKE_SOURCE_DIR}/tests/support/stm32/*.cpp ${CMAKE_SOURCE_DIR}/tests/support/can/*.cpp)
  set(can ${CMAKE_SOURCE_DIR}/tests/contract/can_bus_test.cpp)
  list(REMOVE_ITEM tests ${can})
  set(VERP_WITH ${models})
  verp_add_unit_image(contract contract.${VERP_BOARD} ${machine} ${tests})
  verp_add_unit_image(contract_can contract_can.${VERP_BOARD} ${machine} ${can})
  set_tests_properties(contract.${VERP_BOARD} contract_can.${VERP_BOARD} PROPERTIES LABELS "contract;target")
endfunction()

# tests/host/stm32_drivers as the STM32 boards compile their drivers: same core, -Os (boards/stm32/images.cmake). Models of
# the chip stand in for its registers. Two files would take minutes in an emulator.
function(verp_add_driver_tests machine)
  file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/host/stm32_drivers/*_test.cpp)
  list(FILTER tests EXCLUDE REGEX "(shared_sector|imu_long)_test")
  file(GLOB models CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/support/stm32/*.cpp ${CMAKE_SOURCE_DIR}/tests/support/can/*.cpp)
  set(VERP_WITH ${models})
  verp_add_unit_image(drivers drivers.${VERP_BOARD} ${machine} ${tests})
  target_compile_options(drivers_${VERP_BOARD} PRIVATE -Os)
endfunction()

# Tests with a PC half take it from a PC build, which must exist.
set(VERP_HOST_DIR ${CMAKE_SOURCE_DIR}/build/host-release CACHE PATH "PC build whose programs test this board")
function(verp_add_target_test name suite)
  set(image loop_${VERP_BOARD})
  if(TARGET ${name}_${VERP_BOARD})
    set(image ${name}_${VERP_BOARD})
  endif()
  add_test(NAME ${name}.${VERP_BOARD} COMMAND ${VERP_HOST_DIR}/target/target_tests --gtest_filter=${suite}.*)
  set_tests_properties(${name}.${VERP_BOARD} PROPERTIES LABELS "${name};target" REQUIRED_FILES $<TARGET_FILE:${image}>
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()

# Dry run of `verp flash` with the board's image.
function(verp_add_dry_run_test)
  add_test(NAME flash.${VERP_BOARD}.dry_run COMMAND ${CMAKE_SOURCE_DIR}/tests/target/dry_run
    ${VERP_BOARD} $<TARGET_FILE:loop_${VERP_BOARD}> ${VERP_HOST_DIR}/host/apps/tool/verp)
  set_tests_properties(flash.${VERP_BOARD}.dry_run PROPERTIES LABELS "flash;target")
endfunction()

# From a model to the emulated board; with `can`, also for the robot on CAN.
function(verp_add_deploy_test)
  foreach(bus "" ${ARGN})
    set(name deploy.${VERP_BOARD})
    if(bus)
      string(APPEND name .${bus})
    endif()
    add_test(NAME ${name} COMMAND ${CMAKE_SOURCE_DIR}/tests/target/deploy ${VERP_BOARD} ${VERP_HOST_DIR}/host/apps/tool/verp ${bus})
    set_tests_properties(${name} PROPERTIES LABELS "flash;target"
      ENVIRONMENT "VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
  endforeach()
endfunction()

# A user's controller, from its folder to the same digest as on the PC.
function(verp_add_own_controller_test)
  add_test(NAME own.${VERP_BOARD} COMMAND ${CMAKE_SOURCE_DIR}/tests/host/own/own_controller.sh ${VERP_HOST_DIR}/host/apps/tool/verp ${VERP_BOARD})
  set_tests_properties(own.${VERP_BOARD} PROPERTIES LABELS "loop;target")
endfunction()

# gdb on these images; with `loop`, also on the board's own loop.
function(verp_add_debug_test)
  add_test(NAME debug.${VERP_BOARD} COMMAND ${CMAKE_SOURCE_DIR}/tests/target/debug ${VERP_BOARD} ${VERP_HOST_DIR}/host/apps/tool/verp ${ARGN})
  set_tests_properties(debug.${VERP_BOARD} PROPERTIES LABELS "replay;target" REQUIRED_FILES $<TARGET_FILE:replay_${VERP_BOARD}>
    ENVIRONMENT "VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()

# The first `ticks` of the long trace of tests/replay.
function(verp_add_trace_test name ticks labels)
  add_test(NAME ${name}.${VERP_BOARD} COMMAND ${VERP_HOST_DIR}/target/target_tests --gtest_filter=LongTrace.*)
  set_tests_properties(${name}.${VERP_BOARD} PROPERTIES LABELS "${labels}" REQUIRED_FILES $<TARGET_FILE:replay_${VERP_BOARD}>
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_TEST_TICKS=${ticks};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()

# Recorded inputs through the core: short ones and the long trace of tests/replay.
function(verp_add_replay_tests machine)
  verp_add_emulated_image(replay replay ${machine})
  verp_add_target_test(replay TargetReplay)
  if(ARGN) # ticks in the merge gate, for a slow core
    verp_add_trace_test(trace ${ARGN} "replay;target")
    verp_add_trace_test(trace_full 100000 full)
  else()
    verp_add_trace_test(trace 100000 "replay;target")
  endif()
endfunction()

# The board's CAN driver in the emulator, on a CAN bus of this PC.
function(verp_add_can_tests machine)
  verp_add_emulated_image(can can ${machine})
  verp_add_emulated_image(loop can_loop ${machine})
  add_custom_target(benchmarks DEPENDS loop_${VERP_BOARD})  # for `verp bench`
  add_test(NAME can.${VERP_BOARD} COMMAND ${CMAKE_SOURCE_DIR}/tests/support/with-can --timeout 1700 --slow 3 --memory 1500M
    ${VERP_HOST_DIR}/target/target_tests --gtest_filter=CanBoard.*)
  # RESOURCE_LOCK: two virtual machines would share a processor.
  set_tests_properties(can.${VERP_BOARD} PROPERTIES LABELS "hil-can;target" RESOURCE_LOCK vm
    REQUIRED_FILES $<TARGET_FILE:can_${VERP_BOARD}>
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()

# Standing takes 5.5 seconds of it (tests/target/twin_run.cpp).
function(verp_add_can_loop_test ticks)
  add_test(NAME can_loop.${VERP_BOARD} COMMAND ${CMAKE_SOURCE_DIR}/tests/support/with-can --timeout 1700 --memory 1500M
    ${VERP_HOST_DIR}/target/target_tests --gtest_filter=CanLoop.*)
  set_tests_properties(can_loop.${VERP_BOARD} PROPERTIES LABELS "loop;hil-can;target" RESOURCE_LOCK vm
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_TEST_TICKS=${ticks};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()

# Walk, turn, push, fall, get up, kick and wave over CAN.
function(verp_add_can_tour_test)
  add_test(NAME can_tour.${VERP_BOARD} COMMAND ${CMAKE_SOURCE_DIR}/tests/support/with-can --timeout 1700 --memory 1500M
    ${VERP_HOST_DIR}/target/target_tests --gtest_filter=CanTour.*)
  set_tests_properties(can_tour.${VERP_BOARD} PROPERTIES LABELS "loop;hil-can;target" RESOURCE_LOCK vm
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()

# The crash record for the next start.
function(verp_add_fault_tests machine)
  verp_add_emulated_image(fault fault ${machine})
  foreach(how overflow jump read)
    add_test(NAME fault.${VERP_BOARD}.${how} COMMAND fault_${VERP_BOARD} ${how})
    set_tests_properties(fault.${VERP_BOARD}.${how} PROPERTIES LABELS "unit;target")
  endforeach()
endfunction()

# The loop's image through its emulated serial ports.
function(verp_add_serial_tests machine)
  add_test(NAME hil.${VERP_BOARD}.operator COMMAND ${CMAKE_SOURCE_DIR}/tests/target/interrupt_cost
    $<TARGET_FILE:loop_${VERP_BOARD}> ${VERP_HOST_DIR}/tests/bench/libverp_interrupt_cost.so ${VERP_MOST_MASKED}
    ${VERP_MOST_HANDLER} ${CMAKE_SOURCE_DIR}/tests/target/ask_operator
    ${machine} $<TARGET_FILE:loop_${VERP_BOARD}> $<TARGET_FILE:loop_can_${VERP_BOARD}> ${VERP_HOST_DIR}/host/apps/tool/verp)
  set_tests_properties(hil.${VERP_BOARD}.operator PROPERTIES LABELS "hil;target")
  # Sends actions while it runs, with a power cut.
  add_test(NAME hil.${VERP_BOARD}.actions COMMAND ${CMAKE_SOURCE_DIR}/tests/target/write_flash
    ${machine} $<TARGET_FILE:loop_${VERP_BOARD}> ${VERP_HOST_DIR}/host/apps/tool/verp)
  # gdb plays the flash: beside other emulators that takes longer than a real board may.
  set_tests_properties(hil.${VERP_BOARD}.actions PROPERTIES LABELS "hil;target" PROCESSORS 2)
  # Walks over a bad cable.
  add_test(NAME hil.${VERP_BOARD}.faults COMMAND ${VERP_HOST_DIR}/target/target_tests --gtest_filter=SerialFaults.*)
  set_tests_properties(hil.${VERP_BOARD}.faults PROPERTIES LABELS "hil;target"
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_TEST_TICKS=700;VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
  # Standing before and after the walk takes 5.5 seconds. `tour.mps2_an386` also gets up by actions.
  foreach(ticks 850 1550)
    set(name hil.${VERP_BOARD}.walk)
    set(labels "hil;target")
    set(suite SerialLoop.*-*.GetsUpByTheActionsInItsFlash)
    if(ticks GREATER 850)
      set(name hil_full.${VERP_BOARD}.walk)
      set(labels full)
      set(suite SerialLoop.*)
    endif()
    add_test(NAME ${name} COMMAND ${VERP_HOST_DIR}/target/target_tests --gtest_filter=${suite})
    set_tests_properties(${name} PROPERTIES LABELS "${labels}"
      ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_TEST_TICKS=${ticks};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
  endforeach()
endfunction()

function(verp_add_mps2_images machine)
  verp_add_fault_tests(${machine})
  verp_add_unit_tests(${machine})
  verp_add_contract_tests(${machine})
  verp_add_replay_tests(${machine})
  verp_add_emulated_image(loop loop ${machine})
  verp_add_target_test(loop ClosedLoop)
  verp_add_dry_run_test()
  verp_add_deploy_test()
  verp_add_emulated_image(link link ${machine})
  add_custom_target(benchmarks DEPENDS replay_${VERP_BOARD} link_${VERP_BOARD})  # for `verp bench`
  add_test(NAME bench.${VERP_BOARD} COMMAND ${VERP_HOST_DIR}/target/target_bench --check ${VERP_BOARD})
  # Measures the link, so it runs alone.
  set_tests_properties(bench.${VERP_BOARD} PROPERTIES LABELS "bench;target" RUN_SERIAL ON
    REQUIRED_FILES "$<TARGET_FILE:replay_${VERP_BOARD}>;$<TARGET_FILE:link_${VERP_BOARD}>"
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()
