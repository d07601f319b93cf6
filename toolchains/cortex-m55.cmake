# Cortex-M55 with its FPU and integer vectors. Its vectors of floats flush subnormals, whatever FPSCR says: nomve.fp.
set(VERP_CPU_FLAGS "-mcpu=cortex-m55+nomve.fp -mthumb -mfloat-abi=hard")
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
