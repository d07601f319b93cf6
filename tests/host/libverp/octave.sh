#!/usr/bin/env bash
# octave.sh MATLAB MODULES [argument of octave-cli...]: Octave with the interface in its path. An error exits with
# status 1.
matlab=$1 modules=$2
shift 2
errors=$(mktemp)
trap 'rm -f "$errors"' EXIT
octave-cli --norc --no-history -q --path "$matlab" --path "$modules" "$@" 2>"$errors"
status=$?
grep -vE 'X11 DISPLAY|disabling GUI|while preparing to exit' "$errors" >&2
exit $status
