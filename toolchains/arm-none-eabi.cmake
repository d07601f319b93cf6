# Bare-metal Arm. cortex-*.cmake set VERP_CPU_FLAGS (core and FPU) and include this file.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_ASM_COMPILER arm-none-eabi-gcc)
# A test program cannot be linked without a board's memory map.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)

# The linker drops unused sections. Without threads statics need no guards; without exit no destructors.
set(verp_arm_flags "${VERP_CPU_FLAGS} -ffunction-sections -fdata-sections")
set(CMAKE_C_FLAGS_INIT "${verp_arm_flags}")
set(CMAKE_CXX_FLAGS_INIT
  "${verp_arm_flags} -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-use-cxa-atexit")
set(CMAKE_EXE_LINKER_FLAGS_INIT "${VERP_CPU_FLAGS} -nostartfiles -Wl,--gc-sections")
