#!/usr/bin/env bash
# replay_page_test.sh VERP: the 3D replay in a browser without network must draw something that scrubbing and turning
# change, with a silent console, and nothing may leave the file.
set -uo pipefail

verp=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
browser=$(command -v chromium) || { echo "FAILED: no chromium (apt-get install chromium)"; exit 1; }
failed=0

# Before the page's scripts: collects complaints. After them: acts as a user and records the result.
probe() { # page: prints a copy with both
  sed 's|<head>|<head><script>window.said=[];window.onerror=function(m){said.push(String(m))};console.error=console.warn=function(m){said.push(String(m))};</script>|' "$1"
  cat <<'JS'
<script>
(function () {
  const result = { said: window.said };
  try {
    const replay = window.verpReplay, canvas = document.querySelector('#replay canvas');
    const picture = () => canvas.toDataURL('image/png');
    const small = document.createElement('canvas');
    small.width = 64; small.height = 36;
    replay.seek(replay.begin);
    const first = picture();
    replay.seek((replay.begin + replay.end) / 2);
    const middle = picture();
    const pen = small.getContext('2d');
    pen.drawImage(canvas, 0, 0, 64, 36);
    const colours = new Set(new Uint32Array(pen.getImageData(0, 0, 64, 36).data.buffer));
    const slider = document.querySelector('#replay .time');
    slider.value = replay.end;
    slider.dispatchEvent(new Event('input'));
    replay.draw();
    const last = picture();
    replay.turn.azimuth += 1;
    replay.draw();
    Object.assign(result, { colours: colours.size, scrubbed: first !== middle && middle !== last,
      slid: Math.abs(replay.time() - replay.end) < 1e-3, turned: picture() !== last,
      requests: performance.getEntriesByType('resource').filter((r) => !/^(data|blob):/.test(r.name)).length });
  } catch (error) { result.said.push(String(error)); }
  const out = document.createElement('p');
  out.textContent = 'PROBE ' + JSON.stringify(result);
  document.body.appendChild(out);
})();
</script>
JS
}

look() { # name page
  local result colours
  probe "$2" >"$scratch/$1-probed.html"
  result=$(timeout 200 "$browser" --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader \
    --user-data-dir="$scratch/profile-$1" --host-resolver-rules='MAP * ~NOTFOUND' --window-size=640,480 \
    --dump-dom "file://$scratch/$1-probed.html" 2>/dev/null | grep -oE '<p>PROBE [^<]*' | sed 's/<p>PROBE //')
  colours=$(grep -oE '"colours":[0-9]+' <<<"$result" | grep -oE '[0-9]+')
  if [[ $result != *'"said":[]'* || $result != *'"scrubbed":true'* || $result != *'"slid":true'* ||
    $result != *'"turned":true'* || $result != *'"requests":0'* || ${colours:-0} -lt 50 ]]; then
    echo "FAILED: $1: ${result:-the browser says nothing}"
    failed=1
  fi
}

cd "$scratch" || exit 1
"$verp" walk generic21 --for 3 --report "$scratch/report" >/dev/null || { echo "FAILED: no walk"; exit 1; }
"$verp" replay report/run.mcap --page page.html >/dev/null || { echo "FAILED: no page"; exit 1; }
look report report/index.html
look page page.html

# The check must fail for an empty run.
sed 's/"frames":"[^"]*"/"frames":""/; s/"count":[0-9]*/"count":0/' page.html >empty.html
( failed=0; look empty empty.html >/dev/null; [[ $failed == 1 ]] ) || { echo "FAILED: an empty run passes"; failed=1; }
exit "$failed"
