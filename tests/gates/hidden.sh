#!/usr/bin/env bash
# hidden.sh ROOT [one_by_one]: configures ROOT with its tests while all optional packages are hidden. With `one_by_one`, once for each
# package. cmake has to succeed, everything in `all` to have a rule, and left_out.txt to name what is hidden.
set -uo pipefail
cd "$1" || exit 3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0

undo=() # words for cmake that show what was hidden
configured() { # name cmake-argument...
  local name=$1
  shift
  cmake --preset host-release -B "$scratch/build" "${undo[@]}" "$@" >"$scratch/log" 2>&1 &&
    ninja -C "$scratch/build" -n all >"$scratch/rules" 2>&1 && return
  echo "without $name it does not configure:" && grep -h -m 3 -A 3 -E 'CMake Error|error' "$scratch"/{log,rules}
  failed=1 && return 1
}
left_out() { grep -v '^[0-9]* tests ' "$scratch/build/left_out.txt"; }
named() { # package
  left_out | grep -q "$1" || { echo "without $1 left_out.txt says: $(left_out)" && failed=1; }
}

# A pkg-config that does not know the file's module.
printf '#!/bin/sh\nfor m in $(cat %s/modules); do case " $* " in *" $m "*) exit 1 ;; esac; done\nexec pkg-config "$@"\n' "$scratch" >"$scratch/pkg-config"
chmod +x "$scratch/pkg-config" && echo none >"$scratch/modules"
configured nothing -D VERP_TESTS=ON -D PKG_CONFIG_EXECUTABLE="$scratch/pkg-config" || exit 1
! left_out || { echo 'this machine lacks the packages above' && failed=1; }

declare -A how=() # package: words for cmake that hide it
declare -A back=() # and what shows it again
declare -A module=() # of pkg-config
for each in libassimp-dev:assimp:ASSIMP libepoxy-dev:epoxy:EPOXY libpng-dev:libpng:PNG; do
  IFS=: read -r package name variable <<<"$each"
  module[$package]=$name
  how[$package]="-U ${variable}_* -U __pkg_config_checked_$variable" back[$package]=${how[$package]}
done
for each in qt6-base-dev:Qt6 libqcustomplot-dev:QCustomPlotQt6 libbenchmark-dev:benchmark liborocos-kdl-dev:orocos_kdl \
  libgtest-dev:GTest; do
  how[${each%:*}]="-D CMAKE_DISABLE_FIND_PACKAGE_${each#*:}=ON" back[${each%:*}]="-U CMAKE_DISABLE_FIND_PACKAGE_${each#*:}"
done
for each in octave-dev:VERP_MKOCTFILE octave:VERP_OCTAVE mono-mcs:VERP_MCS mono-runtime:VERP_MONO python3-cffi:VERP_PYTHON_cffi \
  python3-numpy:VERP_PYTHON_numpy clang:VERP_CLANG xvfb:VERP_XVFB_RUN mkdocs:VERP_MKDOCS; do
  how[${each%:*}]="-D ${each#*:}=" back[${each%:*}]="-U ${each#*:}" # defined, so not searched
done

set -f # the words above have stars for cmake
if [[ ${2:-} == one_by_one ]]; then
  for package in "${!how[@]}"; do
    echo "${module[$package]:-none}" >"$scratch/modules"
    configured "$package" ${how[$package]} && named "$package"
    undo=(${back[$package]})
  done
  exit "$failed"
fi
echo "${module[@]}" >"$scratch/modules"
configured 'all optional packages' ${how[@]} || exit 1
# Where GTest is hidden no test is configured, and only what is built is named.
unset 'how[libgtest-dev]'
named libgtest-dev
undo=(-U CMAKE_DISABLE_FIND_PACKAGE_GTest)
configured 'all but libgtest-dev' ${how[@]} || exit 1
unset 'how[xvfb]' # named where there is a window to test
for package in "${!how[@]}"; do named "$package"; done
exit "$failed"
