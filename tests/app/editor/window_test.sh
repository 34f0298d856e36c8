#!/bin/sh
# A real window under Xvfb, driven by xdotool: opens a volume, adds a lattice, drags a control point, takes it back, does
# it again, saves and quits. Usage: window_test.sh VOLEDIT. Exit status 77: skipped.
set -eu
voledit=$1
for tool in Xvfb xdotool; do
    command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done

work=$(mktemp -d)
pids=
cleanup() {
    for pid in $pids; do kill "$pid" 2>/dev/null || true; done
    rm -rf "$work"
}
trap cleanup EXIT

# Xvfb chooses a display that is free and writes its number.
Xvfb -displayfd 3 -screen 0 1280x800x24 -nolisten tcp 3>"$work/display" 2>/dev/null &
pids="$pids $!"
for _ in $(seq 100); do [ -s "$work/display" ] && break; sleep 0.1; done
[ -s "$work/display" ] || { echo "skipped: Xvfb does not start"; exit 77; }
DISPLAY=:$(cat "$work/display")
export DISPLAY

# A ramp in 16x16x16 voxels.
{
    printf 'NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 16 16 16\nencoding: ascii\n\n'
    seq 0 4095 | awk '{ printf "%d ", ($1 % 16) * 16 }'
} >"$work/ramp.nrrd"

"$voledit" edit "$work/ramp.nrrd" --size 1280x800 --scale 1 --record "$work/session.ev" 2>"$work/log" &
editor=$!
pids="$pids $editor"

fail() {
    echo "failed: $1"
    cat "$work/log" "$work/session.ev" 2>/dev/null
    exit 1
}
# Waits until the recording holds a line.
await() {
    for _ in $(seq 300); do
        grep -q "$1" "$work/session.ev" 2>/dev/null && return 0
        kill -0 $editor 2>/dev/null || fail "the editor ended before \"$1\""
        sleep 0.1
    done
    fail "no \"$1\" within 30 s"
}
await '^wait idle'
window=$(xdotool search --name voledit | tail -1)
[ -n "$window" ] || fail "there is no window"

xdotool mousemove 500 400
sleep 0.3
xdotool key ctrl+l
await '^release L'
# Where the lattice's corner stands is asked of the editor itself, headless: the same events, the same place.
sleep 1
printf 'do lattice.add\nmove @point(lattice,3,0,3)\nframe\n' >"$work/find.ev"
"$voledit" edit "$work/ramp.nrrd" --headless --size 1280x800 --scale 1 --play "$work/find.ev" --record "$work/found.ev"
corner=$(sed -n 's/^move //p' "$work/found.ev" | tail -1)
x=$(echo "${corner%,*}" | awk '{ printf "%d", $1 }')
y=$(echo "${corner#*,}" | awk '{ printf "%d", $1 }')
xdotool mousemove "$x" "$y"
sleep 0.5
xdotool mousedown 1
for step in 10 20 30 40; do
    sleep 0.2
    xdotool mousemove $((x + step)) $((y - step / 2))
done
sleep 0.3
xdotool mouseup 1
await '^up left'
xdotool key ctrl+z
await '^release Z'
sleep 0.5
xdotool key ctrl+shift+z
sleep 1
xdotool key ctrl+shift+s
sleep 1
xdotool type --delay 60 "$work/bent.voledit"
sleep 0.5
xdotool key Return
for _ in $(seq 100); do [ -s "$work/bent.voledit" ] && break; sleep 0.1; done
[ -s "$work/bent.voledit" ] || fail "nothing was saved"
grep -q '"move"' "$work/bent.voledit" || fail "the saved lattice is not bent"
xdotool key ctrl+q
for _ in $(seq 100); do kill -0 $editor 2>/dev/null || break; sleep 0.1; done
kill -0 $editor 2>/dev/null && fail "Ctrl+Q did not close the editor"
wait $editor || fail "the editor's exit status is $?"

# What was recorded in the window replays headless to the same lattice.
mv "$work/bent.voledit" "$work/window.voledit"
echo "state $work/replayed.json" >"$work/state.ev"
# Up to the Enter that saves: the letters of the file's name may hold any key.
sed '/^release Enter/q' "$work/session.ev" | cat - "$work/state.ev" >"$work/replay.ev"
"$voledit" edit "$work/ramp.nrrd" --headless --play "$work/replay.ev" 2>>"$work/log" || fail "the recording does not replay"
[ -s "$work/bent.voledit" ] || fail "the replay saved nothing"
cmp "$work/window.voledit" "$work/bent.voledit" || fail "the replay saved another scene"
echo "passed"
