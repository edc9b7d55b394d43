# SPDX-License-Identifier: MIT
"""Reads a recording as the field's readers do, checking what they check: read_h5md.py FILE. Prints what it read."""
import sys

import h5py
import numpy as np

file = h5py.File(sys.argv[1], "r")

# pyh5md: h5md with author and creator; elements are groups with value and step, or datasets
assert list(file["h5md"].attrs["version"]) == [1, 1]
assert file["h5md"].attrs["version"].shape == (2,)
assert "name" in file["h5md/author"].attrs
assert {"name", "version"} <= set(file["h5md/creator"].attrs)

# MDAnalysis: the first group of particles, named trajectory; explicit step and time
assert list(file["particles"]) == ["trajectory"]
group = file["particles/trajectory"]
box = group["box"]
assert box.attrs["dimension"] == 2
assert list(box.attrs["boundary"]) == [b"none", b"none"]
assert np.array_equal(box["edges"], [21, 12])

frames, bodies, _ = group["position/value"].shape
for name in ("position", "velocity", "angle", "spin"):
    element = group[name]
    assert {"value", "step", "time"} == set(element)
    assert element["value"].shape[:2] == (frames, bodies)
    assert element["value"].chunks[0] == 1 and element["value"].fletcher32
    assert element["step"].shape == element["time"].shape == (frames,)
    assert element["step"] == group["position/step"], "step is a hard link"
    assert element["time"] == file["throng/frames/time"], "time is a hard link"
assert np.array_equal(group["id"], np.arange(1, bodies + 1))
assert (np.diff(group["position/step"]) > 0).all()


def fixed(name, item):
    if isinstance(item, h5py.Dataset):
        assert h5py.check_string_dtype(item.dtype) is None or h5py.check_string_dtype(item.dtype).length, name
        assert not item.external and not item.is_virtual, name


file.visititems(fixed)
print(file["parameters/scenario"][()].decode(), end="")
print(repr(float(group["position/value"][2, 7, 1])), repr(float(group["angle/value"][2, 7])), file["throng"].attrs["name"].decode())
