#!/usr/bin/env bash
# with_can_test.sh FOLDER: the promises of tests/support/with-can.
set -uo pipefail

with_can=$1/tests/support/with-can
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export TMPDIR=$scratch/tmp
mkdir "$TMPDIR" "$scratch/kept" "$scratch/bin"
failed=0

fail() {
  echo "FAILED: $*"
  failed=1
}
is() { # what got wanted
  [[ $2 == "$3" ]] || fail "$1: got '$2', want '$3'"
}
processes() { pgrep -f "$scratch/tmp"; }
nothing_left() { # after-what
  for _ in {1..600}; do
    [[ -z $(processes) ]] && break
    sleep 0.05
  done
  is "processes after $1" "$(processes)" ''
  is "files after $1" "$(ls -A "$TMPDIR")" ''
}
launch() { # arguments; sets status, output and errors
  status=0
  output=$("$with_can" "$@" 2>"$scratch/errors") || status=$?
  errors=$(<"$scratch/errors")
}
# As a terminal does (own process group, SIGINT not ignored), once the command runs.
launch_and_interrupt() { # signal wanted-status
  local process
  rm -f "$scratch/kept/started"
  env --default-signal=INT setsid "$with_can" --vm --writable "$scratch/kept" \
    sh -c "echo yes >'$scratch/kept/started'; sleep 100" 2>/dev/null &
  process=$!
  for _ in {1..2400}; do
    [[ -s $scratch/kept/started ]] && break
    sleep 0.05
  done
  [[ -s $scratch/kept/started ]] || fail "nothing started before $1"
  kill "-$1" "$process"
  status=0
  wait "$process" 2>/dev/null || status=$?
  is "status after $1" "$status" "$2"
}

cat >"$scratch/command" <<'END'
printf '%s|' "$@" "$GIVEN" "$PWD"
ip link show up dev vcan0 >/dev/null && echo 'vcan0 is up'
candump -n 1 vcan0 | tr -s ' ' &
while [ "$(jobs -r)" ]; do cansend vcan0 123#0102; sleep 0.1; done
[ "$(ls -A "$TMPDIR" | wc -l)" = 0 ] && echo x >"$TMPDIR/mine" && echo 'its own TMPDIR'
echo kept >"$KEPT/file"
touch "$LOST" 2>/dev/null || echo 'the rest is read-only'
read -r line || echo 'no input'
"$NESTED" sh -c 'ip link add vcan1 type vcan && ip -br link | wc -l; exit 7'
echo "natively: $?, and here still $(ip -br link | wc -l) interfaces"
echo complaint >&2
exit 42
END
cd "$scratch/kept" || exit 1
GIVEN=$'a value\nof two lines' KEPT=$scratch/kept LOST=$scratch/lost NESTED=$with_can launch --vm --writable "$scratch/kept" \
  -- bash "$scratch/command" 'two words' "quote's" '' $'line\nbreak'
is 'the exit status is the command'"'"'s' "$status" 42
is 'errors stay apart' "$errors" complaint
is 'what a command finds' "$output" "two words|quote's||line
break|a value
of two lines|$scratch/kept|vcan0 is up
 vcan0 123 [2] 01 02
its own TMPDIR
the rest is read-only
no input
3
natively: 7, and here still 2 interfaces"
is 'a writable folder is the PC'"'"'s' "$(cat "$scratch/kept/file")" kept
[[ ! -e $scratch/lost ]] || fail 'another file was written'
nothing_left 'a command'

launch --vm --timeout 4 sleep 100
is 'a command that does not end' "$status $errors" '124 with-can: the time is over: 4 s (--timeout)'
nothing_left 'the time was over'

launch --vm --slow 4 --writable "$scratch/kept" sh -c ": >'$scratch/kept/before'; sleep 1; : >'$scratch/kept/after'"
stat -c %.3Y "$scratch/kept/before" "$scratch/kept/after" | paste -sd ' ' | awk '{ exit !($2 - $1 >= 3.9) }' ||
  fail "a second of a clock at a quarter of the speed: $(stat -c %.3Y "$scratch/kept/before" "$scratch/kept/after" | paste -sd ' ')"
nothing_left 'a slow clock'

launch_and_interrupt INT 130
nothing_left 'an interrupt'
launch_and_interrupt TERM 143
nothing_left 'a termination'
launch_and_interrupt KILL 137
rm -rf "${TMPDIR:?}"/* # a killed with-can leaves files
nothing_left 'a kill'

# The kernel refuses, and there is no User-Mode Linux.
for each in bash env dirname readlink mktemp rm id sleep; do ln -s "$(command -v "$each")" "$scratch/bin/"; done
PATH=$scratch/bin launch true
is 'without a place to run it is a failure' "$status" 125
[[ $errors == *'missing: linux.uml'*'apt-get install user-mode-linux'* && $errors != *$'\n'* ]] ||
  fail "the remedy is not one line: $errors"
nothing_left 'a refusal'

for arguments in '' '--timeout 0 true' '--timeout' '--memory lots true' '--slow 0 true' '--slow' '--writable /not/there true' '--unknown true'; do
  # shellcheck disable=SC2086
  launch $arguments
  is "usage of '$arguments'" "$status" 125
  [[ $errors == *usage:* ]] || fail "no usage for '$arguments': $errors"
done
exit "$failed"
