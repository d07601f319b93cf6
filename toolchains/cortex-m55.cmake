# FPU and integer vectors. nomve.fp: float vectors flush subnormals, whatever FPSCR says.
set(VERP_CPU_FLAGS "-mcpu=cortex-m55+nomve.fp -mthumb -mfloat-abi=hard")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
