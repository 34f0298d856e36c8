"""The table of figures beside the peers, row by row, all in one run on one machine.

    python3 table.py PEERS_FOLDER WORK_FOLDER [--sizes 128 256 512 | --volumes A.nrrd B.nrrd] [--repeats 7] [--json OUT]

PEERS_FOLDER holds the peers' scripts, WORK_FOLDER takes volumes, scenes and pictures (made once, kept). Needs the
system's python3 with vtk and numpy, g++, cmake, ninja, VTK's and ITK's development files, and xvfb where there is no
display. VOLEDIT names the program (build/release/voledit of this checkout). Prints Markdown.

Ratios are medians of wall clock, of programs that ran one after the other; where other work shares the machine, read
the ratios of CPU seconds in brackets, which hardly move.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
parser = argparse.ArgumentParser()
parser.add_argument("peers", type=pathlib.Path)
parser.add_argument("work", type=pathlib.Path)
parser.add_argument("--sizes", type=int, nargs="+", default=[128, 256, 512])
parser.add_argument("--volumes", type=pathlib.Path, nargs="+", help="instead of synthetic ones: real_volume.py makes them")
parser.add_argument("--repeats", type=int, default=7)
parser.add_argument("--no-deep", action="store_true", help="leave out the term of three transfers")
parser.add_argument("--no-psnr", action="store_true", help="times only: fine references take longest")
parser.add_argument("--json", type=pathlib.Path)
arguments = parser.parse_args()
peers, work = arguments.peers.resolve(), arguments.work.resolve()
voledit = os.environ.get("VOLEDIT", str(here.parent.parent / "build/release/voledit"))


measurements = []


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def words(text):
    """name=value pairs of a peer's output line, numbers as floats."""
    found = {}
    for word in text.split():
        name, _, value = word.partition("=")
        try:
            found[name] = float(value)
        except ValueError:
            found[name] = value
    return found


def peer(script, *flags, runs=2):
    """The last of two runs: Mesa compiles its shaders in the first."""
    for _ in range(runs):
        output = run("/usr/bin/python3", peers / script, *flags)
    return words(output)


def median(value):
    return value["median"] if isinstance(value, dict) else value


def psnr_beside(picture, reference):
    """dB between a PPM and a PNG of one size."""
    import numpy
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    reader = vtk.vtkPNGReader()
    reader.SetFileName(str(reference))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    right = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3].astype(float)
    data = picture.read_bytes()
    left = numpy.frombuffer(data[-width * height * 3:], numpy.uint8).reshape(height, width, 3).astype(float)
    return float(10 * numpy.log10(255 ** 2 / ((left - right) ** 2).mean()))


def build_peers():
    work.mkdir(parents=True, exist_ok=True)
    if not (work / "build/make_volume").exists():
        run("cmake", "-S", peers, "-B", work / "build", "-G", "Ninja")
        run("cmake", "--build", work / "build")


def synthetic(n):
    volume = work / f"ct_{n}.nrrd"
    if not volume.exists():
        run(work / "build/make_volume", "ct", n, 8, volume)
    return volume


def scene(volume, *flags):
    """A scene file of the peers' scene over a volume; flags of peer_scene.py."""
    name = work / f"{volume.stem}{''.join(f.replace('--', '_') for f in flags)}.voledit"
    run("/usr/bin/python3", here / "peer_scene.py", peers, volume, name, *flags)
    return name


def bench(*flags):
    return json.loads(run(voledit, "bench", "--size", "512x512", "--repeats", arguments.repeats, "--quiet",
                          "--allow-outside", "--no-formulas", *flags))


def measured(title, volume):
    n = volume.stem
    scenes = {"rest": scene(volume, "--rest"), "rest shaded": scene(volume, "--rest", "--shade"),
              "bent": scene(volume), "bent shaded": scene(volume, "--shade"), "deep": scene(volume, "--deep"),
              "deep shaded": scene(volume, "--deep", "--shade")}
    if arguments.no_deep:
        del scenes["deep"], scenes["deep shaded"]
    figures = {"title": title}
    for mapper in ("gpu", "fixed"):
        for shaded in (False, True):
            picture = work / f"vtk_{n}_{mapper}{'_shaded' if shaded else ''}.ppm"
            figures[f"vtk {mapper}{' shaded' if shaded else ''}"] = peer(
                "vtk_render.py", volume, "--mapper", mapper, "--step", 1, "--save", picture,
                *(["--shade"] if shaded else []))
    for name, path in scenes.items():
        # Fine references of large volumes and of long terms take minutes each.
        faults = not arguments.no_psnr and (name.startswith("rest") or
                                            name.startswith("bent") and volume.stat().st_size < 32 << 20)
        # Slices draw chains of maps exactly, at rest, which takes seconds without a GPU.
        ours = bench(path, *(["--psnr"] if faults else []), *([] if name == "rest" else ["--no-start"]),
                     *(["--renderer", "rays"] if name.startswith("deep") else []))
        figures[name] = {row["renderer"]: row for row in ours["pictures"]}
        figures[name]["work"] = ours["work"][0]
        if name.startswith("rest") and faults:
            reference = work / f"reference_{n}{'_shaded' if 'shaded' in name else ''}.png"
            run(voledit, "render", path, "-o", reference, "--renderer", "reference", "--step", 1 / 16, "--size",
                "512x512", "--quiet", "--allow-outside")
            for mapper in ("gpu", "fixed"):
                key = f"vtk {mapper}{' shaded' if 'shaded' in name else ''}"
                figures[key]["psnr_db"] = psnr_beside(work / f"vtk_{n}_{mapper}{'_shaded' if 'shaded' in name else ''}.ppm",
                                                      reference)
    figures["vtk edit"] = peer("vtk_deform.py", volume, "--transform", "grid", "--inverse", "--edits", arguments.repeats, runs=1)
    figures["itk"] = words(run(work / "build/itk_resample", 256, 2))
    if arguments.json:
        measurements.append(figures)
        arguments.json.write_text(json.dumps(measurements, indent=1))
    return figures


def ratio(peer_seconds, peer_cpu, ours, name):
    return f"{peer_seconds * 1e3 / median(ours[name + '_ms']):.1f}× ({peer_cpu * 1e3 / ours[name + '_cpu_ms']:.1f}×)"


def frames(f, mapper, renderer, shaded=""):
    vtk, ours = f[f"vtk {mapper}{shaded}"], f["rest" + shaded][renderer]
    faults = f", {vtk['psnr_db']:.1f} / {ours['psnr_db']:.1f} dB" if "psnr_db" in ours else ""
    return (f"{ratio(vtk['frame_s'], vtk['cpu_s'], ours, 'frame')}: {vtk['frame_s'] * 1e3:.0f} / "
            f"{median(ours['frame_ms']):.0f} ms{faults}")


def edits(f, renderer, term="bent"):
    vtk, ours = f["vtk edit"], f[term][renderer]
    fault = f", {ours['psnr_db']:.1f} dB" if "psnr_db" in ours else ""
    return (f"{ratio(vtk['edit_to_pixel_s'], vtk['cpu_s'], ours, 'edit_to_pixel')}: {vtk['edit_to_pixel_s'] * 1e3:.0f} / "
            f"{median(ours['edit_to_pixel_ms']):.0f} ms{fault}")


def voxelising(f):
    ours = f["bent"]["work"]["voxelise_msamples_per_s"]
    return (f"{ours / f['vtk edit']['resample_msamples_per_s']:.1f}×; {ours / f['itk']['msamples_per_s']:.1f}×: "
            f"{ours:.0f} Msamples/s")


def start(f):
    rays, vtk, read = f["rest"]["rays"], f["vtk fixed"], median(f["rest"]["work"]["raw_read_ms"])
    ms = median(rays["start_to_first_picture_ms"])
    return f"{ms / read:.1f}× raw read; {vtk['start_to_first_image_s'] * 1e3 / ms:.1f}×: {ms:.0f} ms"


def memory(f):
    volume = f["rest"]["work"]["volume_mib"]
    return "; ".join(f"{r} {(f['rest'][r]['peak_mib'] - 80) / volume:.2f}×" for r in ("rays", "slices"))


def row(number, title, cell):
    cells = [cell(f) for f in results]
    print(f"| {number} | {title} | " + " | ".join(cells) + " |")


display = None
if not os.environ.get("DISPLAY"):
    os.environ["DISPLAY"] = ":77"
    display = subprocess.Popen(["Xvfb", ":77", "-screen", "0", "640x640x24"], stderr=subprocess.DEVNULL)
try:
    build_peers()
    if arguments.volumes:
        results = [measured(volume.stem, volume.resolve()) for volume in arguments.volumes]
    else:
        results = [measured(f"{n}³", synthetic(n)) for n in arguments.sizes]
    locators = [words(line) for line in run(work / "build/vtk_locate", 16, 200000).splitlines()
                if line.startswith("vtkStaticCellLocator")]
finally:
    if display:
        display.terminate()

print("Ratios of medians, wall clock (CPU seconds): peer / ours\n")
print("| # | | " + " | ".join(f["title"] for f in results) + " |")
print("| --- | --- |" + " --- |" * len(results))
row(1, "slices against VTK's GPU mapper", lambda f: frames(f, "gpu", "slices"))
row(1, "the same, shaded", lambda f: frames(f, "gpu", "slices", " shaded"))
row(2, "CPU rays against VTK's fixed-point mapper", lambda f: frames(f, "fixed", "rays"))
row(2, "the same, shaded", lambda f: frames(f, "fixed", "rays", " shaded"))
row(3, "CPU rays against VTK's GPU mapper", lambda f: frames(f, "gpu", "rays"))
row(4, "edit to pixel, rays", lambda f: edits(f, "rays"))
row(5, "edit to pixel, slices", lambda f: edits(f, "slices"))
if not arguments.no_deep:
    row("", "the same of three transfers, rays", lambda f: edits(f, "rays", "deep"))
row(6, "deformed / undeformed: slices; rays", lambda f: "; ".join(
    f"{f['bent'][r]['deformed_over_rest']:.2f}× (shaded {f['bent shaded'][r]['deformed_over_rest']:.2f}×)"
    for r in ("slices", "rays")))
if not arguments.no_deep:
    row("", "three transfers / undeformed: rays", lambda f: (
        f"{f['deep']['rays']['deformed_over_rest']:.2f}× (shaded {f['deep shaded']['rays']['deformed_over_rest']:.2f}×)"))
row(7, "voxelising against VTK's inverted grid; ITK's B-spline", voxelising)
row(9, "start to first picture; against VTK", start)
row(10, "peak memory less 80 MiB over the volume", memory)
ours = results[0]["bent"]["work"]
print("\n8. Point location in", ours["tetrahedra"], "tetrahedra, million points a second: vtkStaticCellLocator " +
      ", ".join(f"{l['mqueries_per_s']:.2f}" for l in locators) + " with one and two threads; ours " +
      f"{ours['locate_one_thread_mqueries_per_s']:.1f}, {ours['locate_mqueries_per_s']:.1f} with all.")
