#!/usr/bin/env bash
# examples.sh VERP PROGRAMS SOURCES: the same example gives the same words in C, C++ and Python, and a walk has the digest
# that `verp walk` gives.
set -euo pipefail
verp=$1 programs=$2 sources=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
say() { echo "examples: $*" && exit 1; }

same() { # name argument...: runs it in all languages
  local name=$1 c cpp py
  shift
  c=$("$programs/example_${name}_c" "$@") || say "$name.c failed: $c"
  cpp=$("$programs/example_${name}_cpp" "$@") || say "$name.cpp failed: $cpp"
  py=$(/usr/bin/python3 "$sources/$name.py" "$@") || say "$name.py failed: $py"
  [[ $c == "$cpp" && $c == "$py" ]] || say "$name: C says '$c', C++ '$cpp', Python '$py'"
  words=$c
}

same walk 3
digest=$("$verp" walk --for 3 --json | sed -nE 's/^ *"digest": "(0x[0-9a-f]+)".*/\1/p')
[[ $words == *" $digest" ]] || say "verp walk has digest $digest, the examples say $words"
same record "$scratch/a.mcap" 3
[[ $words == *" $digest" ]] || say "the trace replays to $words, the walk was $digest"
same controller 2
same tune 2
[[ $words == "lift 0.0150 m, trunk 1.122 kg" ]] || say "tune says '$words'"
