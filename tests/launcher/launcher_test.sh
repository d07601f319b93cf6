#!/usr/bin/env bash
# launcher_test.sh ROOT: what ./verp promises, checked on a scratch project in which every outside command is a stub.
set -uo pipefail

root=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0

stub() { # name script
  printf '#!/bin/bash\n%s\n' "$2" >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}

# A project whose build makes a program that echoes its arguments and exits 7; g++ is missing until apt-get installs it.
fresh_project() {
  rm -rf "${scratch:?}"/*
  mkdir -p "$scratch/bin" "$scratch/toolchains" "$scratch/tests" "$scratch/boards/b1" "$scratch/boards/shared"
  touch "$scratch/boards/b1/memory.ld"
  cp "$root/verp" "$scratch/"
  printf 'run cmake why\nrun g++ why\nfw gcc-arm why\nbench libbench why\ntest clang why\n' >"$scratch/toolchains/packages.txt"
  echo '{}' >"$scratch/CMakePresets.json"
  printf '#!/bin/bash\necho "tests: $*"\n' >"$scratch/tests/run" && chmod +x "$scratch/tests/run"
  echo cmake >"$scratch/installed"
  stub dpkg-query "sed 's/\$/ installed/' '$scratch/installed'"
  stub apt-get "echo \"\$*\" >>'$scratch/apt'
case \"\$*\" in
*--print-uris*) echo 'Need to get 5 MB of archives.' ;;
*' install '*) printf '%s\n' \"\$@\" >>'$scratch/installed' ;;
esac"
  stub id 'echo 0'
  # shellcheck disable=SC2016
  stub cmake 'mkdir -p "build/${!#}" && echo configured && : >"build/${!#}/build.ninja"'
  stub ninja "echo \"\$*\" >>'$scratch/built'; mkdir -p build/host-release/host/tool && touch build/host-release/.ninja_log && echo '[1/1] noise'
printf '#!/bin/bash\necho \"\$*\"\nexit 7\n' >'$scratch/new' && chmod +x '$scratch/new'
mv '$scratch/new' build/host-release/host/tool/verp"
}

launch() { # arguments of ./verp; sets status, output and errors
  status=0
  output=$(cd / && env -u CI PATH="$scratch/bin:/usr/bin:/bin" "$scratch/verp" "$@" </dev/null 2>"$scratch/errors") || status=$?
  errors=$(<"$scratch/errors")
}

check() { # what status output-on-stdout part-of-stderr
  [[ $status == "$2" && $output == "$3" && $errors == *"$4"* ]] && return
  echo "FAILED: $1: status $status (want $2), stdout '$output' (want '$3'), stderr '$errors' (want '$4')"
  failed=1
}

fresh_project
launch walk --json
check 'with nobody to ask, it names what is missing and stops' 3 '' 'missing: g++'
check 'it says how big it is' 3 '' 'Need to get 5 MB'
grep -q '^.* install -y' "$scratch/apt" && echo 'FAILED: installed without leave' && failed=1

launch walk --yes --for '2 0' --json
check '--yes installs, builds, passes the other arguments on, keeps stdout pure' 7 'walk --for 2 0 --json' 'installing'
launch walk
check 'the second time nothing is said' 7 'walk' ''
[[ -z $errors ]] || { echo "FAILED: said: $errors" && failed=1; }

launch run m --yes --json
check 'after run --yes reaches the program' 7 'run m --yes --json' ''
launch --yes run m
check 'before run it is about packages only' 7 'run m' ''

launch walk --on b9
check 'an unknown board is left to the program' 7 'walk --on b9' ''
[[ ! -e $scratch/build/fw-b1 ]] || { echo 'FAILED: built a board that nobody named' && failed=1; }
launch walk --on=b1 --yes
check 'a board that is named gets its firmware built' 7 'walk --on=b1' 'missing: gcc-arm'
[[ -e $scratch/build/fw-b1 ]] || { echo 'FAILED: no firmware built' && failed=1; }
: >"$scratch/built"
launch flash --board b1
check 'flash builds the images of which it writes one' 7 'flash --board b1' ''
grep -q 'fw-b1 loops$' "$scratch/built" || { echo "FAILED: flash built: $(<"$scratch/built")" && failed=1; }
: >"$scratch/built"
launch deploy m --board b1
check 'deploy builds for itself' 7 'deploy m --board b1' ''
! grep -q fw-b1 "$scratch/built" || { echo 'FAILED: built before deploy' && failed=1; }

fresh_project
echo g++ >>"$scratch/installed"
launch bench --help
check 'help needs nothing but the program' 7 'bench --help' ''
echo 'older than the packages' >"$scratch/build/host-release/build.ninja"
launch bench --pc --yes
check 'bench --pc gets its libraries' 7 'bench --pc' 'missing: libbench'
[[ ! -s $scratch/build/host-release/build.ninja ]] || { echo 'FAILED: new packages, but not configured anew' && failed=1; }
! grep -q gcc-arm "$scratch/installed" || { echo 'FAILED: bench --pc installed cross tools' && failed=1; }
launch bench --yes
check 'bench gets the cross tools too' 7 'bench' 'missing: gcc-arm'
[[ -e $scratch/build/fw-b1 ]] || { echo 'FAILED: bench built no firmware' && failed=1; }
launch --yes test --only unit
check 'verp test is handed to tests/run' 0 'tests: --only unit' ''

fresh_project
stub apt-get 'echo "E: no network"; exit 100'
launch walk --yes
check 'no network: device trouble, with what apt said' 3 '' 'no network'

fresh_project
stub id 'echo 1000'
mkdir "$scratch/base" && for tool in awk dirname readlink mkdir flock sed tr cat touch bash env mv chmod; do
  ln -s "$(command -v "$tool")" "$scratch/base/"
done
status=0
output=$(PATH="$scratch/bin:$scratch/base" "$scratch/verp" walk --yes </dev/null 2>&1) || status=$?
errors=$output output=''
check 'neither root nor sudo' 3 '' 'needs root'

fresh_project
echo g++ >>"$scratch/installed"
stub ninja "echo 'FAILED: a.o'; echo 'a.cpp:3: error: no such thing'; exit 1"
launch walk --json
check 'a build that fails shows the error on stderr only' 1 '' 'a.cpp:3: error: no such thing'

fresh_project
echo g++ >>"$scratch/installed"
stub ninja "[[ ! -e '$scratch/busy' ]] || echo overlap >>'$scratch/overlap'
touch '$scratch/busy'; sleep 0.2; rm '$scratch/busy'
mkdir -p build/host-release/host/tool; ln -sf /bin/echo build/host-release/host/tool/verp"
for each in 1 2 3; do (launch "$each" && check 'copies at the same time' 0 "$each" '' && exit $failed) & done
for each in 1 2 3; do wait -n || failed=1; done
[[ ! -e $scratch/overlap ]] || { echo 'FAILED: two builds at once' && failed=1; }

exit "$failed"
