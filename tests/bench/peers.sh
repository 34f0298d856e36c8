#!/usr/bin/env bash
# Edit to pixel beside VTK in the same minutes: tests/bench/peers.sh PEERS_FOLDER [N…]
# Needs g++, the system's python3 with vtk (python3-vtk9) and numpy, xvfb. Prints a table of medians in milliseconds.
set -euo pipefail
peers=${1:?name the folder of the peers\' scripts}
shift
[ $# -gt 0 ] || set -- 128 256
here=$(cd "$(dirname "$0")" && pwd)
voledit=${VOLEDIT:-$here/../../build/release/voledit}
work=$(mktemp -d)
trap 'rm -rf "$work"; [ -z "${xvfb:-}" ] || kill "$xvfb"' EXIT
g++ -O2 -std=c++17 "$peers/make_volume.cpp" -o "$work/make_volume"
if [ -z "${DISPLAY:-}" ]; then
    export DISPLAY=:77
    Xvfb :77 -screen 0 640x640x24 >/dev/null 2>&1 &
    xvfb=$!
    sleep 1
fi
value() { python3 -c "import json,sys; d=json.load(open(sys.argv[1])); print(round(d[sys.argv[2]][sys.argv[3]]['median'], 1))" "$@"; }
echo "volume  VTK edit-to-pixel  slices  ratio  rays  ratio  start: slices  rays"
for n in "$@"; do
    "$work/make_volume" ct "$n" 8 "$work/ct.nrrd"
    /usr/bin/python3 "$here/peer_scene.py" "$peers" "$work/ct.nrrd" "$work/ct.voledit"
    "$voledit" bench "$work/ct.voledit" --size 512x512 --quiet >"$work/ours.json"
    vtk=$(/usr/bin/python3 "$peers/vtk_deform.py" "$work/ct.nrrd" --transform grid --inverse | grep -o 'edit_to_pixel_s=[0-9.]*' | cut -d= -f2)
    slices=$(value "$work/ours.json" slices edit_to_pixel_ms)
    rays=$(value "$work/ours.json" rays edit_to_pixel_ms)
    python3 - "$n" "$vtk" "$slices" "$rays" "$(value "$work/ours.json" slices start_to_first_picture_ms)" \
        "$(value "$work/ours.json" rays start_to_first_picture_ms)" <<'PY'
import sys
n, vtk, slices, rays, start_slices, start_rays = sys.argv[1], *map(float, sys.argv[2:])
vtk *= 1000
print(f"{n}³  {vtk:.0f}  {slices:.0f}  {vtk / slices:.1f}×  {rays:.0f}  {vtk / rays:.1f}×  {start_slices:.0f}  {start_rays:.0f}")
PY
done
