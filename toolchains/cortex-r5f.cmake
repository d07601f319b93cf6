# Cortex-R5F: VFPv3 with 16 registers, for single precision only. Arm state, because exceptions are taken in it.
set(VERP_CPU_FLAGS "-mcpu=cortex-r5 -marm -mfpu=vfpv3-d16 -mfloat-abi=hard")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
