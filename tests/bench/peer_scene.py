"""Writes the scene that the peers' benchmarks draw (shared/bench/peers/peers_common.py) as a voledit scene.

    python3 peer_scene.py PEERS_FOLDER VOLUME.nrrd OUT.voledit [--shade] [--rest | --deep] [--cells N]

The lattice is a 4x4x4 Bezier volume over the cube, sampled in 16x16x16 cells (17 points a side, as the peer's), whose
control points follow the bend of vtk_deform.py at half its amount; --rest leaves it out, --deep puts a twist and an
opening before it, --cells samples it in N³ cells.
"""
import argparse
import json
import math
import os
import sys

parser = argparse.ArgumentParser()
parser.add_argument("peers")
parser.add_argument("volume")
parser.add_argument("out")
parser.add_argument("--shade", action="store_true")
parser.add_argument("--rest", action="store_true")
parser.add_argument("--deep", action="store_true")
parser.add_argument("--cells", type=int)
arguments = parser.parse_args()
sys.path.insert(0, arguments.peers)
import peers_common as peers  # noqa: E402

header = {}
with open(arguments.volume, "rb") as file:
    for line in iter(file.readline, b"\n"):
        key, _, value = line.decode().strip().partition(": ")
        header[key] = value
size = [int(v) for v in header["sizes"].split()]
spacing = [float(v) for v in header["spacings"].split()]
top = {"uint8": 255, "uint16": 65535}[header["type"]]
half = [(n - 1) * s / 2 for n, s in zip(size, spacing)]


def bent(x, y, z, amount=0.5):
    turn = 0.6 * amount * z / 64
    return (math.cos(turn) * x - math.sin(turn) * y + amount * 14 * math.sin(2 * math.pi * z / 128 * 0.75),
            math.sin(turn) * x + math.cos(turn) * y + amount * 6 * math.sin(2 * math.pi * x / 128), z)


rest = [[h * (2 * i / 3 - 1) for i in range(4)] for h in half]
control = [bent(rest[0][i], rest[1][j], rest[2][k]) for k in range(4) for j in range(4) for i in range(4)]
volume = {"type": "place", "translate": [-h for h in half],
          "of": {"type": "volume", "asset": "ct", "appearance": {
              "color": [[v / 255 * top, *c] for v, c in peers.COLOUR],
              "opacity": [[v / 255 * top, o] for v, o in peers.OPACITY]}}}
lattice = {"type": "ffd", "control": control,
           "frame": {"min": [-h for h in half], "max": half}}
if arguments.cells:
    lattice["cells"] = [arguments.cells] * 3
chain = [{"use": "bend"}]
if arguments.deep:
    frame = lattice["frame"]
    chain = [{"type": "twist", "axis": "z", "angle": 40, "frame": frame},
             {"type": "open", "axis": "x", "hinge": "z", "width": 0.08, "frame": frame}] + chain
scene = {"voledit": 1,
         "assets": {"ct": {"kind": "volume", "path": os.path.relpath(arguments.volume, os.path.dirname(os.path.abspath(arguments.out)))}},
         "transfers": {"bend": lattice},
         "root": volume if arguments.rest else {"type": "transfer", "by": chain, "of": volume},
         "opacityDistance": 1.0,
         "camera": {"eye": peers.camera(0), "target": [0, 0, 0], "up": [0, 0, 1], "fovY": peers.FOV},
         "render": {"background": [0, 0, 0], "step": 1.0, "shading": arguments.shade, "light": "headlight",
                    "ambient": peers.LIGHT["ambient"], "diffuse": peers.LIGHT["diffuse"],
                    "specular": peers.LIGHT["specular"], "shininess": peers.LIGHT["power"]}}
if arguments.rest:
    del scene["transfers"]
with open(arguments.out, "w") as file:
    json.dump(scene, file, indent=1)
