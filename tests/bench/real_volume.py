"""A real volume as the peers read theirs: unsigned 16-bit raw NRRD, values spread over the whole type between LOW and HIGH
(in the data's own units), the longest side 128 units.

    python3 real_volume.py IN OUT.nrrd LOW HIGH

IN is anything that voledit reads. VOLEDIT names the program.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy

source, target, low, high = sys.argv[1], pathlib.Path(sys.argv[2]), float(sys.argv[3]), float(sys.argv[4])
here = pathlib.Path(__file__).resolve().parent
voledit = os.environ.get("VOLEDIT", str(here.parent.parent / "build/release/voledit"))
with tempfile.TemporaryDirectory() as folder:
    plain = pathlib.Path(folder) / "plain.mha"
    subprocess.run([voledit, "convert", source, str(plain), "--quiet"], check=True)
    data = plain.read_bytes()
end = data.index(b"ElementDataFile")
end = data.index(b"\n", end) + 1
header = dict(line.split(" = ", 1) for line in data[:end].decode().splitlines() if " = " in line)
kinds = {"MET_CHAR": "i1", "MET_UCHAR": "u1", "MET_SHORT": "<i2", "MET_USHORT": "<u2", "MET_INT": "<i4",
         "MET_FLOAT": "<f4", "MET_DOUBLE": "<f8"}
size = [int(v) for v in header["DimSize"].split()]
spacing = [float(v) for v in header.get("ElementSpacing", header.get("ElementSize", "1 1 1")).split()]
values = numpy.frombuffer(data[end:], kinds[header["ElementType"]]).astype(float)
values = numpy.clip((values - low) / (high - low), 0, 1) * 65535
scale = 128 / max(n * s for n, s in zip(size, spacing))
text = ("NRRD0004\ntype: uint16\ndimension: 3\nsizes: " + " ".join(map(str, size)) + "\nspacings: " +
        " ".join(str(s * scale) for s in spacing) + "\nendian: little\nencoding: raw\n\n")
target.write_bytes(text.encode() + (values + 0.5).astype("<u2").tobytes())
