# 32-bit RISC-V without FPU: libgcc computes float32. Debian has no C++ library for it: the headers are Arm newlib's,
# the C library is picolibc, and tests link the rest from tests/support/gtest_target/newlib.cpp.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR riscv32)
set(CMAKE_C_COMPILER riscv64-unknown-elf-gcc)
set(CMAKE_CXX_COMPILER riscv64-unknown-elf-g++)
# A test program cannot be linked without a board's memory map.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)

# Exactly this name: with _zicsr appended, GCC takes the 64-bit libraries.
set(verp_riscv_cpu "-march=rv32imac -mabi=ilp32")
set(verp_picolibc /usr/lib/picolibc/riscv64-unknown-elf)
file(GLOB verp_riscv_cxx /usr/include/newlib/c++/*)
set(verp_riscv_flags "${verp_riscv_cpu} -ffunction-sections -fdata-sections -ftls-model=local-exec")
set(CMAKE_C_FLAGS_INIT "${verp_riscv_flags} -isystem ${verp_picolibc}/include")
# No library has the headers' extern templates. No threads and no exit, as on Arm.
set(CMAKE_CXX_FLAGS_INIT
  "${verp_riscv_flags} -isystem ${verp_riscv_cxx} -isystem ${verp_riscv_cxx}/arm-none-eabi -isystem ${verp_picolibc}/include \
-D_GLIBCXX_EXTERN_TEMPLATE=0 -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-use-cxa-atexit")
set(CMAKE_EXE_LINKER_FLAGS_INIT
  "${verp_riscv_cpu} -nostartfiles -nodefaultlibs -L${verp_picolibc}/lib/rv32imac/ilp32 -Wl,--gc-sections")
set(CMAKE_CXX_STANDARD_LIBRARIES "-Wl,--start-group -lc -lgcc -Wl,--end-group")
