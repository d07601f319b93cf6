#!/usr/bin/env bash
# launcher_test.sh ROOT: checks ./verp on a scratch project where every outside command is a stub.
set -uo pipefail

root=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0

stub() { # name script
  printf '#!/bin/bash\n%s\n' "$2" >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}

# Its program echoes its arguments and exits with 7. g++ is missing until apt-get installs it.
fresh_project() {
  rm -rf "${scratch:?}"/*
  mkdir -p "$scratch/bin" "$scratch/toolchains" "$scratch/tests" "$scratch/boards/b1" "$scratch/boards/shared"
  touch "$scratch/boards/b1/memory.ld"
  sed '/^PATH=/d' "$root/verp" >"$scratch/verp" && chmod +x "$scratch/verp" # Debian's own tools would hide the stubs
  cp "$root/toolchains/compile" "$scratch/toolchains/"
  printf 'run cmake why\nrun g++ why\nfw gcc-arm why\nbench libbench why\ntest clang why\npython python3-cffi why\nmanual mkdocs why\n' >"$scratch/toolchains/packages.txt"
  echo '{}' >"$scratch/CMakePresets.json"
  printf '#!/bin/bash\n[[ $1 != --look ]] || { [[ $* != *nonsense* ]] || exit 2; exit 0; }\necho "tests: $*"\n' >"$scratch/tests/run"
  chmod +x "$scratch/tests/run"
  mkdir -p "$scratch/host/apps/tool" && echo 'what there is' >"$scratch/host/apps/tool/help.txt"
  echo cmake >"$scratch/installed"
  stub dpkg-query "sed 's/\$/ installed/' '$scratch/installed'"
  stub apt-get "echo \"\$*\" >>'$scratch/apt'
case \"\$*\" in
*--print-uris*) echo 'Need to get 5 MB of archives.' ;;
*' install '*) printf '%s\n' \"\$@\" >>'$scratch/installed' ;;
esac"
  stub id 'echo 0'
  # shellcheck disable=SC2016
  stub cmake 'mkdir -p "build/${!#}" && echo configured && : >"build/${!#}/build.ninja"
printf "CMAKE_HOME_DIRECTORY:INTERNAL=%s\n" "$PWD" >"build/${!#}/CMakeCache.txt"
[[ $* != *-DVERP_TESTS=ON* ]] || echo VERP_TESTS:BOOL=ON >>"build/${!#}/CMakeCache.txt"
echo "$*" >>configured'
  stub ninja "echo \"\$*\" >>'$scratch/built'; mkdir -p build/host-release/host/apps/tool && touch build/host-release/.ninja_log && echo '[1/1] noise'
printf '#!/bin/bash\necho \"\$*\"\nexit 7\n' >'$scratch/new' && chmod +x '$scratch/new'
mv '$scratch/new' \"build/host-release/host/apps/tool/\${!#}\""
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

# Help answers before anything is installed or built.
fresh_project
mkdir -p "$scratch/build" && exec 7>"$scratch/build/.lock" && flock 7
for word in --help -h; do
  launch "$word"
  check "$word is answered by the launcher" 0 'what there is' ''
done
launch --version
[[ $status == 0 && $output == 'verp '?* && ! $errors ]] || { echo "FAILED: --version: '$output', '$errors'" && failed=1; }
launch test --only nonsense
check 'a wrong word costs no installation' 2 '' ''
[[ ! -e $scratch/apt && ! -e $scratch/built ]] || { echo 'FAILED: installed or built to say so' && failed=1; }
mkdir -p "$scratch/build/host-release/host/apps/tool" && ln -s /bin/echo "$scratch/build/host-release/host/apps/tool/verp"
launch walk --help
check 'help on a command waits for no build elsewhere' 0 'walk --help' ''
exec 7>&-

fresh_project
launch walk --json
check 'with nobody to ask, it names what is missing and stops' 3 '' 'missing: g++'
check 'it says how big it is' 3 '' 'Need to get 5 MB'
grep -q '^.* install -y' "$scratch/apt" && echo 'FAILED: installed without leave' && failed=1

launch doctor
check 'doctor names what a build lacks, and installs nothing' 1 "bad     packages run     missing for every command: g++
        fix: sudo apt-get install --no-install-recommends g++" ''
launch doctor --json
[[ $status == 1 && $(python3 -m json.tool <<<"$output") == *'"good": false'* ]] || { echo "FAILED: doctor --json: $output" && failed=1; }
grep -q '^.* install -y' "$scratch/apt" && echo 'FAILED: doctor installed' && failed=1

launch walk --yes --for '2 0' --json
check '--yes installs, builds, passes the other arguments on, keeps stdout pure' 7 'walk --for 2 0 --json' 'installing'
launch walk
check 'the second time nothing is said' 7 'walk' ''
[[ -z $errors ]] || { echo "FAILED: said: $errors" && failed=1; }

grep -q verp_ "$scratch/built" && echo 'FAILED: a first walk built a program that it does not start' && failed=1
grep -q 'host-release verp$' "$scratch/built" || { echo "FAILED: a first walk built: $(<"$scratch/built")" && failed=1; }
fresh_project
echo g++ >>"$scratch/installed"

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
grep -q 'host-release verp_robot$' "$scratch/built" || { echo "FAILED: flash built: $(<"$scratch/built")" && failed=1; }
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
launch bench --only window --yes
check 'the window is measured with what it needs' 7 'bench --only window' ''
grep -q window_bench "$scratch/built" || { echo 'FAILED: bench --only window built no window' && failed=1; }
! grep -q gcc-arm "$scratch/installed" || { echo 'FAILED: bench --only window installed cross tools' && failed=1; }
[[ ! -e $scratch/build/fw-b1 ]] || { echo 'FAILED: bench --only window built firmware' && failed=1; }
launch bench --yes
check 'bench gets the cross tools too' 7 'bench' 'missing: gcc-arm'
[[ -e $scratch/build/fw-b1 ]] || { echo 'FAILED: bench built no firmware' && failed=1; }
launch --yes test --only unit
check 'verp test is handed to tests/run' 0 'tests: --only unit' ''

# Tests are configured where something of theirs is built, and stay.
configured_for() { # what words-of-cmake command...
  local what=$1 words=$2
  shift 2
  : >"$scratch/configured"
  launch "$@"
  [[ $(<"$scratch/configured") == "$words" ]] || { echo "FAILED: $what: cmake was called with '$(<"$scratch/configured")'" && failed=1; }
}
fresh_project
printf '%s\n' g++ libbench >>"$scratch/installed"
configured_for 'a walk asks for no tests' '--preset host-release' walk
configured_for 'a second walk configures nothing' '' walk
configured_for 'bench asks for them' '--fresh -DVERP_TESTS=ON --preset host-release' bench --pc
configured_for 'a walk keeps them' '' walk
configured_for 'a second bench configures nothing' '' bench --pc
touch "$scratch/build/.packages-run"
sleep 0.01 && touch "$scratch/toolchains/packages.txt"
configured_for 'after packages came or went all is found anew, with the tests' '--fresh -DVERP_TESTS=ON --preset host-release' walk

fresh_project
echo g++ >>"$scratch/installed"
echo 'import os, sys; print(sys.argv[1:], sys.executable, os.environ["PYTHONPATH"]); sys.exit(7)' >"$scratch/a.py"
launch python "$scratch/a.py" 3 --yes
check 'python gets its packages and libverp, and runs' 7 "['3'] /usr/bin/python3 $scratch/host/apps/libverp/python" 'missing: python3-cffi'
grep -q 'host-release verp_shared$' "$scratch/built" || { echo "FAILED: python built: $(<"$scratch/built")" && failed=1; }

# The manual.
fresh_project
echo g++ >>"$scratch/installed"
launch manual --yes
check 'the manual gets its package and says where it is' 0 "$scratch/build/manual/site/index.html" 'missing: mkdocs'
grep -q 'host-release manual$' "$scratch/built" || { echo "FAILED: manual built: $(<"$scratch/built")" && failed=1; }

# A read-only cache is named where it was missed.
fresh_project
echo g++ >>"$scratch/installed"
stub ninja "echo '[1/1] Building CXX object a.o'; mkdir -p build/host-release/host/apps/tool; ln -sf /bin/echo build/host-release/host/apps/tool/verp"
CCACHE_DIR=/proc/nowhere launch walk
check 'what ccache could not keep is compiled all the same' 0 walk 'without ccache: its folder /proc/nowhere cannot be written'

# Debian's tools come first.
fresh_project
cp "$root/verp" "$scratch/" && mkdir -p "$scratch/host/trace/record"
stub cmake "echo taken >'$scratch/foreign'"
launch --version
[[ ! -e $scratch/foreign ]] || { echo 'FAILED: took a foreign cmake' && failed=1; }

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
mkdir -p build/host-release/host/apps/tool; ln -sf /bin/echo build/host-release/host/apps/tool/verp"
for each in 1 2 3; do (launch "$each" && check 'copies at the same time' 0 "$each" '' && exit $failed) & done
for each in 1 2 3; do wait -n || failed=1; done
[[ ! -e $scratch/overlap ]] || { echo 'FAILED: two builds at once' && failed=1; }

# tests/run with stubs for ctest and cmake.
cd "$root" || exit 1
for words in '--only nonesuch' '--only' '--on=' '--on nonesuch' '--filter (' '--nonesuch'; do
  # shellcheck disable=SC2086
  errors=$(tests/run --look $words 2>&1) && echo "FAILED: accepted: $words" && failed=1
  [[ $errors == 'verp test: '* && $errors != *$'\n'* ]] || { echo "FAILED: '$words' is answered '$errors'" && failed=1; }
done
for words in '--only unit' '--only=hil-can' '--only replay --full' '--filter ^host\.' '--on olimex_h405 --only flash'; do
  # shellcheck disable=SC2086
  tests/run --look $words || { echo "FAILED: refused: $words" && failed=1; }
done

fresh_project
cp "$root/tests/run" "$root/tests/full.md" "$scratch/tests/" && stub nproc 'echo 2' && stub ccache true
printf '#!/bin/sh\necho unit_b\n' >"$scratch/tests/wanted" && chmod +x "$scratch/tests/wanted"
stub ctest "cat '$scratch/ctest.txt'; echo \"\$*\" >>'$scratch/asked'; exit 8"
{ for name in One Two Three Four Five Six Seven Eight Nine Ten Eleven Twelve; do
    printf '[ RUN      ] Good.%s\nnoise of %s\n[       OK ] Good.%s (1 ms)\n' $name $name $name
  done
  printf '[ RUN      ] Bad.Thing\na.cpp:3: Failure\nthe robot fell\n[  FAILED  ] Bad.Thing (2 ms)\n'; } >"$scratch/said"
{ echo ' 1/2 Test  #1: good.one .......   Passed    0.10 sec'
  echo ' 2/2 Test  #2: unit.b1 ........***Failed    0.10 sec'
  cat "$scratch/said"; } >"$scratch/ctest.txt"
status=0
output=$(cd "$scratch" && PATH="$scratch/bin:/usr/bin:/bin" tests/run --filter '^unit' 2>&1) || status=$?
[[ $status == 1 && $output == *$'\nthe robot fell\n'* && $output != *'noise of Three'* ]] ||
  { echo "FAILED: of a failed test its own lines are not shown: status $status, $output" && failed=1; }
grep -q -- '-R ^unit' "$scratch/asked" || { echo "FAILED: --filter did not reach ctest: $(<"$scratch/asked")" && failed=1; }

# On a terminal (`script`), tests/run shows a progress line. The build ends when the line was seen, at most after a minute.
stub ninja "echo '[7/9] Building b.o'; for i in \$(seq 600); do grep -qs 'build, .*\[7/9\]' '$scratch/screen' && break; sleep 0.1; done"
stub ctest 'echo " 2/2 Test  #2: unit.b1 ........   Passed    0.10 sec"'
(cd "$scratch" && PATH="$scratch/bin:/usr/bin:/bin" script -qefc 'tests/run --filter x' screen </dev/null >/dev/null)
grep -q 'build, .*\[7/9\]' "$scratch/screen" || { echo "FAILED: no progress on a terminal: $(<"$scratch/screen")" && failed=1; }

# A late stage is reported but does not fail.
stub ninja 'sleep 1.5'
sed -i 's/^    preset "$each" 900 /    preset "$each" 0 /' "$scratch/tests/run"
output=$(cd "$scratch" && PATH="$scratch/bin:/usr/bin:/bin" tests/run --filter x 2>&1)
[[ $output == *$'\nlate: \'host-release build\'\n'* && $output =~ host-release\ build\ +late\ +0\ +0 ]] || { echo "FAILED: not called late: $output" && failed=1; }

# For each command the launcher builds the program that `verp` starts.
eval "$(sed -n '/^programs_of()/,/^}/p' "$root/verp")"
table=$root/host/apps/cli/other_program.cpp rows=0
while read -r word name; do
  rows=$((rows + 1))
  [[ $(programs_of "$word") == "$(grep -oE "$name = \{[^}]*\}" "$table" | grep -oE 'verp_[a-z]+')" ]] ||
    { echo "FAILED: ./verp builds '$(programs_of "$word")' for $word; $table says $name" && failed=1; }
done < <(grep -oE '\{"[a-z]+", k[A-Z][a-z]+' "$table" | tr -d '{",')
((rows > 20)) || { echo "FAILED: $table has $rows commands" && failed=1; }

exit "$failed"
