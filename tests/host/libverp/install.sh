#!/usr/bin/env bash
# install.sh CMAKE BUILD: program, library by pkg-config, Python package, completion and manual work where they are
# installed, and find their robots.
set -euo pipefail
cmake=$1 build=$2 here=$(cd "$(dirname "$0")" && pwd)
to=$(mktemp -d)
trap 'rm -rf "$to"' EXIT
"$cmake" --install "$build" --component verp --prefix "$to" >"$to/log"
cd "$to"
say() { echo "install: $*" && exit 1; }

"$to/bin/verp" check generic21 >check.txt || say "verp check failed"
grep -q "$to/share/verp/common/robots/generic21/robot.sdf" check.txt || say "verp does not read its own robots: $(head -3 check.txt)"
for command in check run tune; do "$to/bin/verp" $command --help >/dev/null || say "verp $command has no program"; done
# Debian's multiarch folder is for /usr only.
PC=$(dirname "$(find "$to" -name verp.pc)")
LIB=$(dirname "$PC")
[[ $(env -u VERP_LIBRARY PYTHONPATH="$to/lib/python3/dist-packages" PYTHONDONTWRITEBYTECODE=1 LD_LIBRARY_PATH="$LIB" \
  /usr/bin/python3 -c 'import verp; print(len(verp.Core().joint_names))') == 21 ]] || say "the Python package does not run"
if [[ -e $to/libexec/verp/verp_camera ]]; then # needs the OpenGL packages
  render() {
    env -u VERP_LIBRARY -u VERP_CAMERA_PROGRAM PYTHONPATH="$to/lib/python3/dist-packages" PYTHONDONTWRITEBYTECODE=1 LD_LIBRARY_PATH="$LIB" \
      /usr/bin/python3 -c 'import verp; s = verp.Session(); s.add(); print(s.render("front", width=64, height=48).shape)' 2>&1
  }
  [[ $(render) == "(48, 64, 3)" ]] || say "no picture: $(render)"
  printf '#!/bin/sh\nexit 7\n' >"$to/libexec/verp/verp_camera"
  [[ $(render) == *"has ended, with status 7"* ]] || say "pictures come from elsewhere than libexec: $(render)"
fi
cat >a.c <<'END'
#include <verp/verp.h>
int main(void) {
  verp_core core;
  return verp_core_open("generic21", 0, 0, &core) != VERP_OK || verp_core_close(core) != VERP_OK;
}
END
# shellcheck disable=SC2046
gcc a.c -o a $(PKG_CONFIG_PATH="$PC" pkg-config --cflags --libs verp)
LD_LIBRARY_PATH="$LIB" ./a || say "a program that was built by pkg-config fails"
/usr/bin/python3 "$here/abi_asserts.py" "$to/include/verp/abi.json" | sed 's,"verp.h",<verp/verp.h>,' >abi.c
gcc -std=gnu11 -fsyntax-only -I "$to/include" abi.c || say "the list of the ABI is not that of the header beside it"
cat >CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(user C)
find_package(verp REQUIRED)
add_executable(user a.c)
target_link_libraries(user PRIVATE verp::verp_shared)
END
"$cmake" -G Ninja -S . -B user -DCMAKE_PREFIX_PATH="$to" >log && "$cmake" --build user >>log || { cat log && say "find_package(verp) fails"; }
user/user || say "a program that was built by find_package fails"
for each in share/man/man1/verp.1 share/bash-completion/completions/verp share/zsh/vendor-completions/_verp \
  share/fish/vendor_completions.d/verp.fish; do
  grep -q replay "$each" || say "$each does not know the commands"
done
functions=$(grep -oE '\bverp_[a-z_]+\(' include/verp/verp.h | tr -d '(' | sort -u)
[[ $(wc -l <<<"$functions") -gt 40 ]] || say "the header declares only $functions"
for each in $functions; do
  grep -q "^\.B .*[ *]$each(" share/man/man3/libverp.3 || say "libverp.3 does not know $each"
  [[ $(cat "share/man/man3/$each.3") == ".so man3/libverp.3" ]] || say "there is no page $each.3"
done
grep -q 'no element of R R(haT' <(tr -d '\\' <share/man/man3/libverp.3) || say "libverp.3 has not the words of verp_core_leg_ik"
grep -q 'typedef struct verp_core_handle\* verp_core;' share/man/man3/libverp.3 || say "libverp.3 has no types"
if command -v groff >/dev/null; then
  wrong=$(groff -man -Tutf8 -ww share/man/man3/libverp.3 2>&1 >libverp.txt)
  [[ -z $wrong ]] || say "groff finds in libverp.3: $wrong"
fi
