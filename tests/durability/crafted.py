# SPDX-License-Identifier: MIT
"""Copies a recording into ones that must be refused, each with one fault: crafted.py FILE FOLDER [crowd | selected | region]."""
import importlib
import shutil
import sys

import h5py
import numpy as np


def replace(file, name, **how):
    del file[name]
    return file.create_dataset(name, **how)


def external_storage(file):
    # the bytes would come from another file on the disk
    del file["throng/bodies/radius"]
    plist = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    plist.set_external(b"/etc/passwd", 0, 8 * 10)
    space = h5py.h5s.create_simple((10,))
    h5py.h5d.create(file["throng/bodies"].id, b"radius", h5py.h5t.IEEE_F64LE, space, plist)


def external_link(file):
    del file["throng/bodies"]
    file["throng/bodies"] = h5py.ExternalLink("other.h5", "/throng/bodies")


def soft_link(file):
    file.move("throng/walls", "throng/walls2")
    file["throng/walls"] = h5py.SoftLink("/throng/walls2")


def virtual_dataset(file):
    layout = h5py.VirtualLayout(shape=(10,), dtype="<f8")
    layout[:] = h5py.VirtualSource("other.h5", "radius", shape=(10,))
    del file["throng/bodies/radius"]
    file.create_virtual_dataset("throng/bodies/radius", layout)


def huge_dimensions(file):
    replace(file, "throng/bodies/shape", shape=(10**15,), chunks=(1024,), dtype="<u4")


def bomb(file):
    # never written: a file of a few kB that would fill 2 GB with zeros
    replace(file, "throng/shapes/outline", shape=(2**27, 2), chunks=(2**16, 2), dtype="<f8")


def wrong_type(file):
    replace(file, "throng/bodies/radius", data=np.ones(10, dtype="<f4"))


def wrong_rank(file):
    replace(file, "throng/bodies/radius", data=np.ones((10, 1)))


def wrong_size(file):
    replace(file, "throng/bodies/radius", data=np.ones(9))


def not_finite(file):
    replace(file, "throng/bodies/radius", data=np.array([1.0] * 9 + [np.nan]))


def not_finite_position(file):
    file["particles/trajectory/position/value"][3, 2, 1] = np.inf


def altered_position(file):
    file["particles/trajectory/position/value"][3, 2, 1] += 1e-12


def altered_state_hash(file):
    file["throng/frames/state_hash"][2] += np.uint64(1)


def altered_scenario(file):
    text = file["parameters/scenario"]
    text[()] = text[()].replace(b"throng", b"thronG")


def time_going_back(file):
    file["throng/frames/step"][3] = 1
    file["throng/frames/time"][3] = file["throng/frames/time"][1]


def time_off_the_steps(file):
    file["throng/frames/time"][3] += 1e-9


def frame_missing(file):
    for name in ("step", "time", "state_hash", "frame_hash"):
        file["throng/frames"][name].resize((4,))


def value_missing(file):
    file["particles/trajectory/position/value"].resize((4, 10, 2))


def index_beyond(file):
    file["throng/bodies/shape"][4] = 3


def kind_unknown(file):
    file["throng/bodies/kind"][4] = 9


def offset_beyond(file):
    file["throng/walls/offset"][1] = 10**9


def wall_without_points(file):
    # one wall of no points: nothing of it can be drawn
    walls = "throng/walls/"
    replace(file, walls + "points", data=np.zeros((0, 2)))
    replace(file, walls + "offset", data=np.zeros(2, dtype="<u8"))
    replace(file, walls + "closed", data=np.zeros(1, dtype="<u1"))
    replace(file, walls + "material", data=np.zeros(1, dtype="<u4"))


def wall_of_one_point(file):
    file["throng/walls/offset"][1] = 1


def part_without_vertices(file):
    file["throng/shapes/vertex_offset"][1] = 0


def disc_with_parts(file):
    file["throng/shapes/part_offset"][1] = 1


def polygon_without_parts(file):
    file["throng/shapes/part_offset"][2] = 0


def cycle(file):
    del file["throng/bodies"]
    file["throng/bodies"] = file["throng"]


def deflated(file):
    replace(file, "throng/bodies/radius", data=np.ones(10), chunks=(10,), compression="gzip")


def foreign_filter(file):
    replace(file, "throng/bodies/radius", data=np.ones(10), chunks=(10,), compression="lzf")


def scale_offset(file):
    replace(file, "throng/bodies/shape", data=np.zeros(10, dtype="<u4"), chunks=(10,), scaleoffset=0)


def variable_text(file):
    replace(file, "parameters/scenario", data="x" * 10, dtype=h5py.string_dtype())


def no_utf8(file):
    replace(file, "throng/shapes/name", data=np.array([b"\xff\xfe"] * 3))


def dataset_for_a_group(file):
    replace(file, "throng/walls", data=np.zeros(3))


def group_missing(file):
    del file["throng/frames"]


def measures(file, names):
    # lines of no length
    group = file.create_group("throng/measures")
    group["name"] = np.array(names, dtype="S")
    group["line"] = np.zeros((len(names), 4))
    group["size"] = np.zeros(len(names))
    group["points"] = np.zeros((0, 2))
    group["offset"] = np.zeros(1, dtype="<u8")
    group["area_offset"] = np.zeros(len(names) + 1, dtype="<u8")


def equal_measures(file):
    measures(file, ["x", "y", "x"])


def many_measures(file):
    measures(file, [str(i) for i in range(30000)])


def observables_again_and_again(file):
    # a thousand measures whose columns are all the same numbers
    frames, names = len(file["throng/frames/step"]), [str(i) for i in range(1000)]
    measures(file, names)
    one = file.create_group("observables/contacts")
    file["observables"].attrs["every"] = np.int64(1)
    for name in ("step", "time"):
        file["observables"][name] = one[name] = file["throng/frames"][name]
    one["value"] = np.zeros(frames)
    momentum = file.create_group("observables/momentum")
    momentum["value"] = np.zeros((frames, 2))
    for name in ("step", "time"):
        momentum[name] = one[name]
    for name in ("kinetic_energy", "potential_energy", "max_overlap", "mean_overlap", "agents", "arrived"):
        file["observables"][name] = one
    columns = file.create_group("observables/columns")
    for name in ("count", "forward", "back", "flow", "speed"):
        columns[name] = one
    for name in names:
        file["observables/measure/" + name] = columns


def newer(file):
    file["throng"].attrs.modify("version", np.array([2, 0], dtype="<i4"))


def foreign(file):
    del file["throng"]


FAULTS = (external_storage, external_link, soft_link, virtual_dataset, huge_dimensions, bomb, wrong_type, wrong_rank,
          wrong_size, not_finite, not_finite_position, altered_position, altered_state_hash, altered_scenario,
          time_going_back, time_off_the_steps, frame_missing, value_missing, index_beyond, kind_unknown, offset_beyond,
          wall_without_points, wall_of_one_point, part_without_vertices, disc_with_parts, polygon_without_parts,
          cycle, deflated, foreign_filter, scale_offset, variable_text, no_utf8, dataset_for_a_group, group_missing,
          equal_measures, many_measures, observables_again_and_again, newer, foreign)

if __name__ == "__main__":
    kind = sys.argv[3] if len(sys.argv) > 3 else ""
    for fault in importlib.import_module("crafted_" + kind).FAULTS if kind else FAULTS:
        path = f"{sys.argv[2]}/{fault.__name__}.h5"
        shutil.copy(sys.argv[1], path)
        with h5py.File(path, "r+", libver="latest") as opened:
            fault(opened)
