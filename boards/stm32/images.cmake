# The image that goes on an STM32 board: loop_<board>.elf, held to its budget of flash, RAM and stack.
set(VERP_STM32_DIR ${CMAKE_CURRENT_LIST_DIR})

function(verp_add_stm32_loop)
  set(image loop_${VERP_BOARD})
  add_executable(${image} ${VERP_STM32_DIR}/loop_main.cpp ${VERP_STM32_DIR}/hardware.cpp ${VERP_STM32_DIR}/end.cpp)
  target_include_directories(${image} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_link_libraries(${image} PRIVATE verp_boot verp_app verp_core verp_warnings)
  target_link_options(${image} PRIVATE -T ${CMAKE_CURRENT_SOURCE_DIR}/memory.ld)
  set_target_properties(${image} PROPERTIES
    SUFFIX .elf
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/images
    LINK_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/memory.ld;${CMAKE_SOURCE_DIR}/firmware/boot/sections.ld")
  # The bytes as a boot loader wants them, and the budget: too much of anything fails the build.
  add_custom_command(TARGET ${image} POST_BUILD
    COMMAND ${CMAKE_OBJCOPY} -O binary $<TARGET_FILE:${image}> ${CMAKE_BINARY_DIR}/images/${image}.bin
    COMMAND ${VERP_STM32_DIR}/budget $<TARGET_FILE:${image}> ${CMAKE_SOURCE_DIR}/host/board/stack_depth
    VERBATIM)
  add_test(NAME budget.${VERP_BOARD} COMMAND ${VERP_STM32_DIR}/budget
    $<TARGET_FILE:${image}> ${CMAKE_SOURCE_DIR}/host/board/stack_depth)
  set_tests_properties(budget.${VERP_BOARD} PROPERTIES LABELS "gate;target")
  verp_add_dry_run_test()
endfunction()

# The real image through a flash tool, as far as that goes without silicon: `tests` of tests/host/flash.
function(verp_add_flash_tests tests)
  add_test(NAME flash.${VERP_BOARD}.real COMMAND ${VERP_HOST_DIR}/tests/host/flash/verp_flash_test --gtest_filter=${tests})
  set_tests_properties(flash.${VERP_BOARD}.real PROPERTIES LABELS "flash;target" TIMEOUT 120
    ENVIRONMENT "VERP_TEST_BOARD=${VERP_BOARD};VERP_FIRMWARE_DIR=${CMAKE_BINARY_DIR}/images")
endfunction()
