#!/usr/bin/env bash
# environment.sh ROOT: configures ROOT in an environment that offers foreign packages, tools and flags, and builds one
# program and one module there. Prints what was taken from it.
set -uo pipefail
root=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
foreign=$scratch/foreign build=$scratch/build
mkdir -p "$foreign"/{bin,include/fmt,lib/pkgconfig,lib/cmake} "$scratch/home/.cmake/packages"
failed=0

for package in fmt GTest CLI11 nlohmann_json Qt6 wslay benchmark; do
  mkdir "$foreign/lib/cmake/$package"
  echo "message(FATAL_ERROR \"the foreign package $package\")" | tee "$foreign/lib/cmake/$package/$package-config.cmake" \
    >"$foreign/lib/cmake/$package/${package}Config.cmake"
  mkdir "$scratch/home/.cmake/packages/$package"
  echo "$foreign/lib/cmake/$package" >"$scratch/home/.cmake/packages/$package/registered"
done
for package in ode sdformat12 urdfdom tinyxml2 libserial libzstd libmd assimp epoxy libpng; do
  printf 'Name: %s\nDescription: foreign\nVersion: 99\nLibs: -L%s/lib\nCflags: -I%s/include\n' "$package" "$foreign" "$foreign" \
    >"$foreign/lib/pkgconfig/$package.pc"
done
for tool in cc gcc g++ c++ as ld ar ranlib pkg-config ninja ccache python3 clang++ mcs mono mkoctfile octave-cli; do
  printf '#!/bin/sh\necho "the foreign tool %s: $0" >>"%s/taken"\nexit 1\n' "$tool" "$scratch" >"$foreign/bin/$tool"
  chmod +x "$foreign/bin/$tool"
done
for header in fmt/core.h fmt/format.h stdlib.h stdint.h; do
  echo "#error \"the foreign header $header\"" >"$foreign/include/$header"
done
echo 'message(FATAL_ERROR "the foreign toolchain file")' >"$foreign/toolchain.cmake"

flags="-march=native -O3 -I$foreign/include"
hostile=(HOME="$scratch/home" CCACHE_DIR="$scratch/cache" PATH="$foreign/bin:$PATH"
  CC="$foreign/bin/gcc" CXX="$foreign/bin/g++" CFLAGS="$flags" CXXFLAGS="$flags" CPPFLAGS="$flags" LDFLAGS="-L$foreign/lib --foreign"
  CMAKE_PREFIX_PATH="$foreign" CMAKE_INCLUDE_PATH="$foreign/include" CMAKE_LIBRARY_PATH="$foreign/lib" CMAKE_PROGRAM_PATH="$foreign/bin"
  CMAKE_TOOLCHAIN_FILE="$foreign/toolchain.cmake" CMAKE_BUILD_TYPE=Debug CMAKE_CXX_COMPILER_LAUNCHER="$foreign/bin/ccache"
  CMAKE_CXX_LINKER_LAUNCHER="$foreign/bin/ccache" fmt_DIR="$foreign/lib/cmake/fmt" fmt_ROOT="$foreign" GTest_ROOT="$foreign"
  PKG_CONFIG="$foreign/bin/pkg-config" PKG_CONFIG_PATH="$foreign/lib/pkgconfig" PKG_CONFIG_LIBDIR="$foreign/lib/pkgconfig"
  PKG_CONFIG_SYSROOT_DIR="$foreign" CPATH="$foreign/include" CPLUS_INCLUDE_PATH="$foreign/include" C_INCLUDE_PATH="$foreign/include"
  LIBRARY_PATH="$foreign/lib" COMPILER_PATH="$foreign/bin" GCC_EXEC_PREFIX="$foreign/lib/" LD_RUN_PATH="$foreign/lib"
  PYTHONHOME="$foreign" PYTHONPATH="$foreign")
try() { # what command...
  local what=$1
  shift
  env "${hostile[@]}" "$@" >"$scratch/log" 2>&1 && return
  echo "$what fails:" && grep -m 5 -A 3 -E 'CMake Error|error|foreign' "$scratch/log"
  failed=1
}

cd "$root" || exit 3
try 'configuring' /usr/bin/cmake --preset host-release -B "$build" -DVERP_TESTS=ON
grep -q '^-- Environment variables without effect on this build: .*CXXFLAGS.*CMAKE_PREFIX_PATH' "$scratch/log" ||
  { echo 'the variables without effect are not named' && failed=1; }
# `ninja` alone configures once more.
rm -f "$build/.ninja_deps" && touch -d 2001-01-01 "$build/build.ninja"
try 'building' /usr/bin/ninja -C "$build" replay_contracted verp_instruction_count
grep -rlF -e "$foreign" -e '-march=native -O3' "$build"/{CMakeCache.txt,build.ninja,compile_commands.json} | sed 's/$/ names what is foreign/' |
  grep . && failed=1
[[ ! -e $scratch/taken ]] || { sort -u "$scratch/taken" && failed=1; }
exit "$failed"
