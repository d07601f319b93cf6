#!/usr/bin/env bash
# symbols.sh ARCHIVE NM OBJDUMP [soft]: checks what the compiler made of the core. `soft` is for cores without an FPU.
#  - it calls nothing outside itself but memcpy, memmove, memset, memcmp and the compiler's integer (soft: and
#    single-precision) arithmetic helpers; so no heap, no libm, no I/O, no double
#  - Eigen chose no general matrix product: those allocate
#  - it holds no data that a run could change, and nothing that runs before main
#  - no fused multiply-add and no double-precision instruction: both would change bits between machines
#  - no Arm vectors of floats: they flush subnormals
set -euo pipefail
shopt -s lastpipe # a pipe's `complain` can set `bad`

archive=$1 nm=$2 objdump=$3 float=${4:-hard}
bad=0
complain() { # reason; offending lines on stdin, if any
  local lines
  lines=$(head -n 5)
  [[ -n $lines ]] || return 0
  printf '%s: %s:\n%s\n' "$archive" "$1" "$lines"
  bad=1
}

allowed='memcpy|memmove|memset|memcmp|_GLOBAL_OFFSET_TABLE_|__aeabi_mem(cpy|move|set|clr)[48]?'
allowed+='|__aeabi_(u?idiv(mod)?|u?ldivmod|lmul|l(lsl|lsr|asr)|u?lcmp|u?l2f|f2u?lz)'
allowed+='|__(u?divdi3|u?moddi3|muldi3|(ashl|ashr|lshr)di3|(clz|ctz|bswap|popcount)[sd]i2)' # for RISC-V
[[ $float != soft ]] || allowed+='|__((add|sub|mul|div|neg)sf3|(eq|ne|lt|le|gt|ge|unord)sf2|float(un)?sisf|fix(uns)?sfsi)'
[[ $float != soft ]] || allowed+='|sqrtf|__aeabi_(c?f(add|sub|rsub|mul|div|neg|cmp(eq|lt|le|ge|gt|un)|cmple|rcmple|cmpeq)|u?i2f|f2u?iz)'

symbols=$("$nm" "$archive" 2>/dev/null)
[[ -n $symbols ]] || { echo "$archive: no symbols: is it the core?" && exit 1; }

awk 'NF == 2 && $1 == "U" { wanted[$2] } NF == 3 { defined[$3] }
     END { for (name in wanted) if (!(name in defined)) print name }' <<<"$symbols" |
  { grep -vxE "$allowed" || true; } | LC_ALL=C sort | complain "calls what the core must not need"
{ grep -E 'general_matrix|gebp' <<<"$symbols" || true; } | complain "Eigen's general products allocate: use smaller fixed sizes"
{ grep -E '^[0-9a-f]+ [bBCsSgG] ' <<<"$symbols" || true; } | complain "has data that a run can change"
"$objdump" -h "$archive" |
  awk '$2 ~ /^\.(data|bss|tdata|tbss|init_array|ctors)/ && $2 !~ /^\.data\.rel\.ro/ && $3 !~ /^0+$/ { print $2, $3 }' |
  complain "has sections that a run can change, or code that runs before main"
"$objdump" -d --no-show-raw-insn "$archive" |
  { grep -iE '[[:space:]](vfn?m[as]|vfmadd|vfmsub|vfnm|fn?m(add|sub)|[a-z.0-9]+\.f64|v?(add|sub|mul|div|sqrt|cvtss2|cvtsi2)sd)' || true; } |
  complain "has fused or double-precision instructions"
"$objdump" -d --no-show-raw-insn "$archive" |
  { grep -iE '[[:space:]]v[a-z]+\.f(16|32)(\.[a-z0-9]+)?[[:space:]]+q[0-7]' || true; } |
  complain "has vectors of floats, which flush subnormals on Arm"
exit "$bad"
