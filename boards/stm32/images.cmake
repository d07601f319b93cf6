# loop_<board>.elf, checked against its budget of flash, RAM and stack.
set(VERP_STM32_DIR ${CMAKE_CURRENT_LIST_DIR})
# Most instructions with interrupts masked, and of an interrupt handler. At 168 MHz a byte of 1 Mbaud lasts 1680 cycles;
# the F4 holds one more.
set(VERP_MOST_MASKED 1000)
set(VERP_MOST_HANDLER 200)

# <image>.elf with the robot_port.hpp of `way`: serial or can. Its main is loop_main.cpp or that of `ARGV2`; further
# folders have the headers that it chooses.
function(verp_add_stm32_image image way)
  set(what loop)
  if(ARGN)
    list(POP_FRONT ARGN what)
  endif()
  add_executable(${image} ${VERP_STM32_DIR}/${what}_main.cpp ${VERP_STM32_DIR}/hardware.cpp ${VERP_STM32_DIR}/end.cpp)
  target_include_directories(${image} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${VERP_STM32_DIR}/${way} ${ARGN})
  target_link_libraries(${image} PRIVATE verp_boot verp_law verp_app verp_core verp_warnings)
  # Flash is scarce here, not time: verp_core has its own flags.
  target_compile_options(${image} PRIVATE -Os)
  target_link_options(${image} PRIVATE -T ${CMAKE_CURRENT_SOURCE_DIR}/memory.ld)
  set_target_properties(${image} PROPERTIES
    SUFFIX .elf
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/images
    LINK_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/memory.ld;${CMAKE_SOURCE_DIR}/firmware/boot/sections.ld")
  # Raw bytes for a boot loader; the budget check can fail the build.
  add_custom_command(TARGET ${image} POST_BUILD
    COMMAND ${CMAKE_OBJCOPY} -O binary $<TARGET_FILE:${image}> ${CMAKE_BINARY_DIR}/images/${image}.bin
    COMMAND ${VERP_STM32_DIR}/budget $<TARGET_FILE:${image}> ${CMAKE_SOURCE_DIR}/host/boards/board/stack_depth
    VERBATIM)
endfunction()

# Through a path with a blank, as a user's folder may have.
function(verp_add_budget_test name image)
  file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/a place")
  file(CREATE_LINK ${CMAKE_BINARY_DIR}/images "${CMAKE_BINARY_DIR}/a place/images" SYMBOLIC)
  add_test(NAME ${name} COMMAND ${VERP_STM32_DIR}/budget "${CMAKE_BINARY_DIR}/a place/images/${image}.elf"
    ${CMAKE_SOURCE_DIR}/host/boards/board/stack_depth)
  set_tests_properties(${name} PROPERTIES LABELS "gate;target")
endfunction()

# For a robot on the servo port.
function(verp_add_stm32_loop)
  verp_add_stm32_image(loop_${VERP_BOARD} serial)
  verp_add_budget_test(budget.${VERP_BOARD} loop_${VERP_BOARD})
  verp_add_dry_run_test()
endfunction()

# For a robot on CAN. One image for both would almost fill the flash before the robot's sector.
function(verp_add_stm32_can_loop)
  verp_add_stm32_image(loop_can_${VERP_BOARD} can)
  verp_add_budget_test(budget.${VERP_BOARD}.can loop_can_${VERP_BOARD})
endfunction()

# The board as a robot's IMU device; board.hpp has kSensorImu. With `machine`, in an emulator, with an IMU that turns.
function(verp_add_stm32_sensor)
  verp_add_stm32_image(sensor_${VERP_BOARD} serial sensor ${VERP_STM32_DIR}/sensor/chip)
  verp_add_budget_test(budget.${VERP_BOARD}.sensor sensor_${VERP_BOARD})
  if(ARGN)
    verp_add_stm32_image(sensor_turning_${VERP_BOARD} serial sensor ${VERP_STM32_DIR}/sensor/turning)
    add_test(NAME hil.${VERP_BOARD}.sensor COMMAND ${CMAKE_SOURCE_DIR}/tests/target/interrupt_cost
      $<TARGET_FILE:sensor_turning_${VERP_BOARD}> ${VERP_HOST_DIR}/tests/bench/libverp_interrupt_cost.so ${VERP_MOST_MASKED}
      ${VERP_MOST_HANDLER} ${CMAKE_SOURCE_DIR}/tests/target/ask_sensor
      ${ARGN} $<TARGET_FILE:sensor_turning_${VERP_BOARD}> ${VERP_HOST_DIR}/host/apps/tool/verp)
    set_tests_properties(hil.${VERP_BOARD}.sensor PROPERTIES LABELS "hil;target")
  endif()
endfunction()

# The board as a robot's foot; board.hpp has kFootPort.
function(verp_add_stm32_foot)
  verp_add_stm32_image(foot_${VERP_BOARD} serial sensor ${VERP_STM32_DIR}/sensor/foot)
  verp_add_budget_test(budget.${VERP_BOARD}.foot foot_${VERP_BOARD})
endfunction()

# The image through a flash tool, without silicon: `tests` of tests/host/flash.
function(verp_add_flash_tests tests)
  add_test(NAME flash.${VERP_BOARD}.real COMMAND ${VERP_HOST_DIR}/tests/host/flash/verp_flash_test --gtest_filter=${tests})
  set_tests_properties(flash.${VERP_BOARD}.real PROPERTIES LABELS "flash;target"
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()
