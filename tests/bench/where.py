"""Where a frame's time goes, as Markdown: what grows with the pixels, what a frame costs without them, and what an edit adds.

    python3 where.py SCENE.voledit [SCENE.voledit …] [--repeats 5]

A picture of 32×32 pixels costs all that does not depend on their number: the program's own work, vertices and geometry
of slices, the search for what can be seen. An edit of it adds compiling the scene, cells or a baked map made anew, and
their upload. CPU milliseconds of all threads. VOLEDIT names the program.
"""
import argparse
import json
import os
import pathlib
import subprocess

here = pathlib.Path(__file__).resolve().parent
parser = argparse.ArgumentParser()
parser.add_argument("scenes", type=pathlib.Path, nargs="+")
parser.add_argument("--repeats", type=int, default=5)
arguments = parser.parse_args()
voledit = os.environ.get("VOLEDIT", str(here.parent.parent / "build/release/voledit"))

print("| scene | | pixels | the rest of a frame | an edit adds | of it compiling |\n| --- | --- | --- | --- | --- | --- |")
for scene in arguments.scenes:
    text = subprocess.run([voledit, "bench", scene, "--size", "32x32,512x512", "--repeats", str(arguments.repeats),
                           "--no-start", "--no-formulas", "--quiet", "--allow-outside"], check=True, capture_output=True,
                          text=True).stdout
    rows = {(row["renderer"], row["size"]): row for row in json.loads(text)["pictures"]}
    for renderer in ("slices", "rays"):
        small, large = rows[renderer, "32x32"], rows[renderer, "512x512"]
        rest, edit = small["frame_cpu_ms"], small.get("edit_to_pixel_cpu_ms")
        added = f"{edit - rest:.1f} | {small['compile_cpu_ms']:.1f}" if edit else "– | –"
        print(f"| {scene.stem} | {renderer} | {large['frame_cpu_ms'] - rest:.0f} | {rest:.1f} | {added} |")
