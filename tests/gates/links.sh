#!/usr/bin/env bash
# links.sh ROOT: every relative link of a Markdown page resolves to a file or folder, and its anchor to a heading.
# Links of the manual to pages that host/guide/build_manual.py writes must name one of those.
set -uo pipefail
cd "$1" || exit 3
failed=0
complain() { echo "$1: $2" && failed=1; }

links_of() { # line, tab, target of each link outside of code
  awk '/^```/ { code = !code; next } code || /^    / { next }
    { gsub(/`[^`]*`/, "")
      while (match($0, /\]\([^) ]+\)/)) {
        print NR "\t" substr($0, RSTART + 2, RLENGTH - 3)
        $0 = substr($0, RSTART + RLENGTH)
      } }' "$1"
}

anchors_of() { # headings as anchors
  awk '/^```/ { code = !code; next } code { next }
    sub(/^#+ +/, "") { $0 = tolower($0); gsub(/[^a-z0-9_ -]/, ""); gsub(/^ +| +$/, ""); gsub(/ +/, "-"); print }' "$1"
}

while IFS= read -r page; do
  here=.
  [[ $page != */* ]] || here=${page%/*}
  while IFS=$'\t' read -r line target; do
    [[ $target =~ ^[a-z]+: ]] && continue
    file=${target%%#*} anchor=
    [[ $target != *'#'* ]] || anchor=${target#*#}
    if [[ $page == host/guide/* && $file == reference/* ]]; then
      grep -qF "\"${file#reference/}\"" host/guide/build_manual.py || complain "$page:$line" "no page $target: see build_manual.py"
      continue
    fi
    where=$page
    [[ -z $file ]] || where=$here/$file
    [[ -e $where ]] || { complain "$page:$line" "no $target" && continue; }
    [[ -z $anchor ]] || { [[ -f $where ]] && anchors_of "$where" | grep -qxF -- "$anchor"; } || complain "$page:$line" "no heading for $target"
  done < <(links_of "$page")
done < <(if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then git ls-files -co --exclude-standard '*.md'; else find . -name '*.md' -not -path './build/*' -printf '%P\n'; fi)
exit "$failed"
