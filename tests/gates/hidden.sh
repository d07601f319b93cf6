#!/usr/bin/env bash
# hidden.sh ROOT: configures ROOT with its tests once for each optional package, with that package hidden. cmake has to
# succeed, everything in `all` to have a rule, and left_out.txt to name the package.
set -uo pipefail
cd "$1" || exit 3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0

undo=() # words for cmake that show what was hidden
configured() { # package cmake-argument...
  local package=$1
  shift
  cmake --preset host-release -B "$scratch/build" "${undo[@]}" "$@" >"$scratch/log" 2>&1 &&
    ninja -C "$scratch/build" -n all >"$scratch/rules" 2>&1 && return
  echo "without $package it does not configure:" && grep -h -m 3 -A 3 -E 'CMake Error|error' "$scratch"/{log,rules}
  failed=1 && return 1
}
left_out() { grep -v '^[0-9]* tests ' "$scratch/build/left_out.txt"; }
hidden() { # package cmake-argument...
  configured "$@" || return
  left_out | grep -q "$1" || { echo "without $1 left_out.txt says: $(left_out)" && failed=1; }
}

# A pkg-config that does not know the file's module.
printf '#!/bin/sh\ncase " $* " in *" $(cat %s/module) "*) exit 1 ;; esac\nexec pkg-config "$@"\n' "$scratch" >"$scratch/pkg-config"
chmod +x "$scratch/pkg-config" && echo none >"$scratch/module"
configured nothing -D VERP_TESTS=ON -D PKG_CONFIG_EXECUTABLE="$scratch/pkg-config" || exit 1
! left_out || { echo 'this machine lacks the packages above' && failed=1; }

for each in libassimp-dev:assimp:ASSIMP libepoxy-dev:epoxy:EPOXY libpng-dev:libpng:PNG; do
  IFS=: read -r package module variable <<<"$each"
  echo "$module" >"$scratch/module"
  hidden "$package" -U "${variable}_*" -U "__pkg_config_checked_$variable"
  undo=(-U "${variable}_*" -U "__pkg_config_checked_$variable")
done
echo none >"$scratch/module"
for each in qt6-base-dev:Qt6 libqcustomplot-dev:QCustomPlotQt6 libbenchmark-dev:benchmark liborocos-kdl-dev:orocos_kdl \
  libgtest-dev:GTest; do
  hidden "${each%:*}" -D "CMAKE_DISABLE_FIND_PACKAGE_${each#*:}=ON"
  undo=(-U "CMAKE_DISABLE_FIND_PACKAGE_${each#*:}")
done
for each in octave-dev:VERP_MKOCTFILE octave:VERP_OCTAVE mono-mcs:VERP_MCS mono-runtime:VERP_MONO python3-cffi:VERP_PYTHON_cffi \
  python3-numpy:VERP_PYTHON_numpy clang:VERP_CLANG xvfb:VERP_XVFB_RUN mkdocs:VERP_MKDOCS; do
  hidden "${each%:*}" -D "${each#*:}=" # defined, so not searched
  undo=(-U "${each#*:}")
done
exit "$failed"
