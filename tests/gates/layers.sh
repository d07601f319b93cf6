#!/usr/bin/env bash
# layers.sh ROOT [FOLDER...]: checks every #include at ROOT against layers.txt, and common/ for conditional compilation
# and words that a freestanding, deterministic core must avoid.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$1"
shift
folders=("$@")
[[ ${#folders[@]} -gt 0 ]] || folders=(common hal firmware boards host tests)

mapfile -t files < <(find "${folders[@]}" -type f \( -name '*.[ch]pp' -o -name '*.[chS]' \) | LC_ALL=C sort)
[[ ${#files[@]} -gt 0 ]] || { echo "layers: no sources in $PWD" && exit 1; }

awk -v rules="$here/layers.txt" '
function complain(why) { printf "%s:%d: %s\n", FILENAME, FNR, why; bad = 1 }

# The rule of the longest folder or file name that begins the path.
function rule_of(path,   parent) {
  for (; path != ""; path = parent) {
    if (path in rule) return path
    parent = path
    if (!sub(/\/[^\/]*$/, "", parent)) parent = ""
    if ((parent "/*") in rule) {
      rule[path] = rule[parent "/*"]
      return path
    }
  }
  return ""
}

function allowed(target, own, rules_line,   n, i, words) {
  if (target !~ /^</ && (index(target, own "/") == 1 || rule_of(target) == own)) return 1
  n = split(rules_line, words, " ")
  for (i = 1; i <= n; i++) {
    if (words[i] == target) return 1
    if (target ~ /^</ ? words[i] == "<*>" : index(target, words[i] "/") == 1) return 1
  }
  return 0
}

BEGIN {
  while ((getline line < rules) > 0) {
    if (line ~ /^(#|$)/) continue
    split(line, words, " ")
    name = words[1]
    sub(/^[^ ]+ +/, "", line)
    if (name == "@core") core = line; else { sub(/@core/, core, line); rule[name] = line }
  }
  close(rules)
  forbidden = "(^|[^A-Za-z0-9_])(new|malloc|calloc|realloc|throw|try|catch|virtual|double|dynamic_cast|typeid|" \
              "thread_local|volatile|asm|goto|std::(sin|cos|tan|asin|acos|atan|atan2|exp|log|pow|" \
              "sqrt|floor|ceil|round|fmod|fma|array|span|optional|vector|string|function))($|[^A-Za-z0-9_])"
}

FNR == 1 { own = rule_of(FILENAME); comment = 0; core_file = FILENAME ~ /^common\//
           if (own == "") complain("no rule for this folder in tests/gates/layers.txt") }

/^[ \t]*#[ \t]*include/ {
  target = $0
  sub(/^[ \t]*#[ \t]*include[ \t]*/, "", target)
  if (target ~ /^</) sub(/>.*/, ">", target)
  else if (target ~ /^"/) { sub(/^"/, "", target); sub(/".*/, "", target) }
  else { complain("an #include must name a file"); next }
  if (target !~ /[<\/]/ && !allowed(target, own, rule[own])) { complain("include \"" target "\" by its path from the top of the repository"); next }
  if (own != "" && !allowed(target, own, rule[own])) complain(own " must not include " target)
  next
}

core_file {
  line = $0
  gsub(/"([^"\\]|\\.)*"/, "\"\"", line)
  if (comment) { if (!sub(/^.*\*\//, "", line)) next; comment = 0 }
  gsub(/\/\*([^*]|\*[^\/])*\*\//, "", line)
  if (sub(/\/\*.*$/, "", line)) comment = 1
  sub(/\/\/.*$/, "", line)
  if (own !~ /linear.hpp$/ && line ~ /^[ \t]*#[ \t]*(if|ifdef|ifndef|elif|else)/) complain("common/ has no conditional compilation: make it an input or a parameter")
  if (match(line, forbidden)) {
    word = substr(line, RSTART, RLENGTH)
    gsub(/^[^A-Za-z]|[^A-Za-z0-9_]$/, "", word)
    complain("common/ must not use " word)
  }
}
END { exit bad }
' "${files[@]}"
