# VFPv3, single precision. Arm state, because exceptions are taken in it.
set(VERP_CPU_FLAGS "-mcpu=cortex-r5 -marm -mfpu=vfpv3-d16 -mfloat-abi=hard")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
