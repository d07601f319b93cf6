#!/usr/bin/env bash
# examples.sh VERP PROGRAMS SOURCES OCTAVE CSHARP GROUP: each example of a group prints the same in C, C++, Python,
# Octave and C#. `walks`: the digest of `verp walk`, and a trace that replays. `others`: your own controller, tuning,
# radio. `pictures`: needs OpenGL; its files are equal too.
set -euo pipefail
verp=$1 programs=$2 sources=$3 octave=$4 csharp=$5
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
say() { echo "examples: $*" && exit 1; }

made() { # the bytes of the last program's picture
  [[ ! -e seen.ppm ]] || { head -c 15 seen.ppm | tr '\n' ' ' && cksum <seen.ppm && rm seen.ppm; }
}

same() { # name argument...: runs all languages
  local name=$1 c cpp py m cs arguments
  shift
  c=$("$programs/example_${name}_c" "$@" && made) || say "$name.c failed: $c"
  cpp=$("$programs/example_${name}_cpp" "$@" && made) || say "$name.cpp failed: $cpp"
  py=$(/usr/bin/python3 "$sources/$name.py" "$@" && made) || say "$name.py failed: $py"
  printf -v arguments "'%s'," "$@"
  arguments=$(sed -E "s/'([0-9]+)'/\1/g" <<<"${arguments%,}") # numbers are no strings
  m=$("$octave" --eval "addpath('$sources'); verp_$name($arguments)" && made) || say "verp_$name.m failed: $m"
  cs=$("$csharp" "$name" "$@" && made) || say "$name.cs failed: $cs"
  [[ $c == "$cpp" && $c == "$py" && $c == "$m" && $c == "$cs" ]] ||
    say "$name: C says '$c', C++ '$cpp', Python '$py', Octave '$m', C# '$cs'"
  words=$c
}

group=$6
if [[ $group == pictures ]]; then
  same camera seen.ppm 2
  [[ $words == "camera: 320x240 at "*" s, mean "*"P6 320 240 255 "* ]] || say "camera says '$words'"
  exit 0
fi
if [[ $group == others ]]; then
  same controller 2
  same tune 2
  [[ $words == "lift 0.0150 m, trunk 1.122 kg" ]] || say "tune says '$words'"
  same radio talk.mcap
  grep -aq verp_msgs/msg/Radio talk.mcap || say "the trace of radio has no /radio"
  exit 0
fi
same walk 3
digest=$("$verp" walk --for 3 --json | sed -nE 's/^ *"digest": "(0x[0-9a-f]+)".*/\1/p')
[[ $words == *" $digest" ]] || say "verp walk has digest $digest, the examples say $words"
bound=$(/usr/bin/python3 "$sources/bind.py" "$VERP_LIBRARY" 3) || say "bind.py failed: $bound"
[[ $bound == "$words" ]] || say "a binding from abi.json says '$bound', the others '$words'"
# ODE must call the library's solver loops (host/twin/sim/solver.hpp), or walks take several times as long.
for language in "$programs/example_walk_c" "/usr/bin/python3 $sources/walk.py"; do
  LD_DEBUG=bindings LD_DEBUG_OUTPUT=bound $language 1 >walked
  grep -qE 'file .*libode\S* .*to \S*libverp\S* .*solveL1Transposed' bound.* || say "$language has ODE's own loops"
  rm bound.*
done
same record a.mcap 3
[[ $words == *" $digest" ]] || say "the trace replays to $words, the walk was $digest"
