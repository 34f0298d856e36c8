"""Cost of a frame over voxels, pixels, slices, cells and the depth of the term, as one plot.

    python3 curves.py PEERS_FOLDER WORK_FOLDER OUT.png [--repeats 5]

Uses the peers' synthetic volumes (as table.py leaves them in WORK_FOLDER) and CPU milliseconds of all threads, which
hardly move where other work shares the machine. Needs python3-matplotlib. VOLEDIT names the program.
"""
import argparse
import json
import os
import pathlib
import subprocess

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plot  # noqa: E402

here = pathlib.Path(__file__).resolve().parent
parser = argparse.ArgumentParser()
parser.add_argument("peers", type=pathlib.Path)
parser.add_argument("work", type=pathlib.Path)
parser.add_argument("out", type=pathlib.Path)
parser.add_argument("--repeats", type=int, default=5)
arguments = parser.parse_args()
work = arguments.work.resolve()
voledit = os.environ.get("VOLEDIT", str(here.parent.parent / "build/release/voledit"))


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def volume(n):
    path = work / f"ct_{n}.nrrd"
    if not path.exists():
        run(work / "build/make_volume", "ct", n, 8, path)
    return path


def scene(n, name, *flags, change=None):
    path = work / f"curve_{name}.voledit"
    run("/usr/bin/python3", here / "peer_scene.py", arguments.peers, volume(n), path, "--shade", *flags)
    if change:
        text = json.loads(path.read_text())
        change(text)
        path.write_text(json.dumps(text))
    return path


def frames(path, size="512x512"):
    """CPU milliseconds a frame of both renderers."""
    text = run(voledit, "bench", path, "--size", size, "--repeats", arguments.repeats, "--no-start", "--no-formulas",
               "--quiet")
    return {row["renderer"]: row["frame_cpu_ms"] for row in json.loads(text)["pictures"]}


def step(length):
    return lambda text: text["render"].update(step=length)


def depth(count):
    def change(text):
        frame = text["transfers"]["bend"]["frame"]
        turn = {"type": "twist", "axis": "z", "angle": 60 / max(count, 1), "frame": frame}
        text["root"] = text["root"]["of"] if count == 0 else {"type": "transfer", "by": [turn] * count,
                                                              "of": text["root"]["of"]}
    return change


panels = [
    ("voxels a side", [64, 128, 256, 512], lambda n: frames(scene(n, "voxels", "--rest")), "undeformed"),
    ("voxels a side, lattice", [64, 128, 256, 512], lambda n: frames(scene(n, "bent")), "lattice of 16³ cells"),
    ("pixels a side", [128, 256, 512, 1024], lambda n: frames(scene(256, "pixels"), f"{n}x{n}"), "256³, lattice"),
    ("steps a voxel", [0.5, 1, 2, 4], lambda n: frames(scene(256, "steps", change=step(1 / n))), "256³, lattice"),
    ("cells a side", [4, 8, 16, 32], lambda n: frames(scene(256, "cells", "--cells", n)), "256³"),
    ("twists, one after the other", [0, 1, 2, 4, 6], lambda n: frames(scene(256, "depth", change=depth(n))), "256³"),
]
figure, axes = plot.subplots(2, 3, figsize=(12, 7), dpi=100)
table = {}
for (title, values, measure, note), axis in zip(panels, axes.flat):
    costs = [measure(v) for v in values]
    table[title] = {str(v): c for v, c in zip(values, costs)}
    linear = title.startswith("twists")
    for renderer, color in (("slices", "#d9822b"), ("rays", "#2b7bd9")):
        draw = axis.plot if linear else axis.loglog
        draw(values, [c[renderer] for c in costs], "o-", color=color, label=renderer, base=2) if not linear else \
            draw(values, [c[renderer] for c in costs], "o-", color=color, label=renderer)
    axis.set_title(f"{title} ({note})", fontsize=10)
    axis.set_ylabel("CPU ms a frame", fontsize=9)
    axis.set_xticks(values, [str(v) for v in values])
    axis.minorticks_off()
    axis.set_ylim(bottom=0 if linear else None)
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
figure.tight_layout()
figure.savefig(arguments.out)
print(json.dumps(table, indent=1))
