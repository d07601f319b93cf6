# Debian's packages, whatever the environment says: a sourced ROS, a conda, flags of another project. Included before
# project(). Anything foreign is asked for on cmake's command line, such as -DCMAKE_PREFIX_PATH=DIR.
# `toolchains/compile` clears the variables that compilers and linkers read.
set(verp_ignored)
if(CMAKE_TOOLCHAIN_FILE AND CMAKE_TOOLCHAIN_FILE STREQUAL "$ENV{CMAKE_TOOLCHAIN_FILE}")
  unset(CMAKE_TOOLCHAIN_FILE CACHE) # cmake has taken it from there
endif()
foreach(variable CC CXX CFLAGS CXXFLAGS CPPFLAGS LDFLAGS ASM ASMFLAGS
    CMAKE_PREFIX_PATH CMAKE_INCLUDE_PATH CMAKE_LIBRARY_PATH CMAKE_PROGRAM_PATH CMAKE_FRAMEWORK_PATH CMAKE_APPBUNDLE_PATH
    CMAKE_TOOLCHAIN_FILE CMAKE_BUILD_TYPE CMAKE_C_COMPILER_LAUNCHER CMAKE_CXX_COMPILER_LAUNCHER CMAKE_C_LINKER_LAUNCHER
    CMAKE_CXX_LINKER_LAUNCHER PKG_CONFIG PKG_CONFIG_PATH PKG_CONFIG_LIBDIR PKG_CONFIG_SYSROOT_DIR
    CPATH C_INCLUDE_PATH CPLUS_INCLUDE_PATH LIBRARY_PATH COMPILER_PATH GCC_EXEC_PREFIX LD_LIBRARY_PATH LD_RUN_PATH
    PYTHONHOME PYTHONPATH)
  if(DEFINED ENV{${variable}})
    list(APPEND verp_ignored ${variable})
    unset(ENV{${variable}})
  endif()
endforeach()
set(ENV{PATH} /usr/sbin:/usr/bin:/sbin:/bin)
if(verp_ignored)
  list(JOIN verp_ignored " " verp_ignored)
  message(STATUS "Environment variables without effect on this build: ${verp_ignored}")
endif()

# <PackageName>_ROOT, <PackageName>_DIR, packages registered in ~/.cmake, and /usr/local.
set(CMAKE_FIND_USE_CMAKE_ENVIRONMENT_PATH OFF)
set(CMAKE_FIND_USE_PACKAGE_ROOT_PATH OFF)
set(CMAKE_FIND_USE_PACKAGE_REGISTRY OFF)
set(CMAKE_IGNORE_PREFIX_PATH /usr/local)

# verp_left_out(WHAT PACKAGE): WHAT is not built or tested here because PACKAGE is missing. `./verp test` fails if
# left_out.txt of the build tree lists anything.
function(verp_left_out what package)
  message(STATUS "Left out: ${what} (${package} is missing)")
  set_property(GLOBAL APPEND_STRING PROPERTY VERP_LEFT_OUT "${what} (${package} is missing)\n")
endfunction()
