#!/usr/bin/env bash
# How an interaction feels in a window without a GPU: tests/bench/drag.sh VOLUME [PRESET [VOLEDIT FLAG…]]
# Under Xvfb, an event file drags a control point of a lattice over VOLUME, then turns the view, in a viewport of 960×720.
# Prints pictures a second, the median time between them, the time from release to full quality, and who draws.
set -euo pipefail
volume=$(realpath "${1:?name a volume}")
preset=${2:-ct-bone}
shift $(($# > 1 ? 2 : 1))
here=$(cd "$(dirname "$0")" && pwd)
voledit=${VOLEDIT:-$here/../../build/release/voledit}
work=$(mktemp -d)
trap 'rm -rf "$work"; [ -z "${xvfb:-}" ] || kill "$xvfb"' EXIT
Xvfb -displayfd 3 -screen 0 1400x900x24 -nolisten tcp 3>"$work/display" 2>/dev/null &
xvfb=$!
for _ in $(seq 100); do [ -s "$work/display" ] && break; sleep 0.1; done
DISPLAY=:$(cat "$work/display")
export DISPLAY

# Panels, menu and status bar take 330 × 56 pixels of the window.
cat >"$work/drag.ev" <<EVENTS
wait idle
do appearance.preset $preset
do lattice.add
wait idle
drag @point(lattice,3,0,3) to @point(lattice,3,0,3)+90,-60 steps 30
drag @point(lattice,3,0,3) to @point(lattice,3,0,3)+-90,60 steps 60
state $work/dragging.json
wait idle
state $work/drag.json
drag @view(0.05,0.05) to @view(0.6,0.1) steps 90
state $work/turning.json
wait idle
state $work/turn.json
do file.quit
EVENTS
# The scene is changed: leaving asks.
printf 'click @widget("Unsaved changes/Discard")\n' >>"$work/drag.ev"
"$voledit" edit "$volume" --size 1290x776 --scale 1 --play "$work/drag.ev" "$@"
python3 - "$work" <<'PY'
import json, sys
print("interaction          pictures/s  between, ms  refined after, ms  drawn by")
for what, moving, rest in ("control point", "dragging", "drag"), ("view", "turning", "turn"):
    a, b = (json.load(open(f"{sys.argv[1]}/{name}.json")) for name in (moving, rest))
    x, y, width, height = a["viewport"]
    print(f"{what + f' {width}×{height}':21}{a['pictures_per_second']:8.1f}{a['frame_ms']:13.1f}{b['refined_ms']:15.0f}      {a['renderer']}")
PY
