#!/usr/bin/env bash
# walk_test.sh ROOT: `./verp walk --for 20 --json` succeeds, does not fall, and writes one JSON object to stdout.
set -euo pipefail

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
"$1/verp" walk --for 20 --json >out.json
cat out.json
grep -qE '"fallen": *false' out.json
[[ $(head -c 1 out.json) == '{' && $(tr -d '\n' <out.json | tail -c 1) == '}' ]]
