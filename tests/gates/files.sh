#!/usr/bin/env bash
# files.sh ROOT: only host/os/files makes and replaces files. Exempt are writers into a folder of their own, into a part
# file that the helper has made, and a child's output.
set -euo pipefail

cd "$1"
exempt='^host/(os/(files|process)/|boards/board/replay_on_target|apps/libverp/examples/|apps/tool/study/trace_export)'
found=$(grep -rnE 'ofstream [a-z]+\(|ofstream\(|fopen\(|O_TRUNC|(fs|filesystem|std)::rename\(| ::rename\(' \
  --include='*.[ch]pp' host | grep -vE "$exempt" || true)
[[ -z $found ]] && exit 0
echo "$found"
echo 'written past host/os/files: use replace(), create() or NewFile'
exit 1
