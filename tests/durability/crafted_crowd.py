# SPDX-License-Identifier: MIT
"""What crafted.py does to a recording of a crowd, whose table of contacts is empty."""
import h5py
import numpy as np

from crafted import replace


def area_of_unknown_use(file):
    file["throng/areas/use"][0] = 3


def area_of_two_points(file):
    areas = file["throng/areas"]
    areas["offset"][1] = 2


def area_beyond_its_rings(file):
    file["throng/areas/area_offset"][1] = 10**9


def area_nowhere(file):
    file["throng/areas/points"][0] = (np.nan, 0.0)


def fewer_uses_than_areas(file):
    replace(file, "throng/areas/use", data=np.zeros(1, dtype="<u1"))


def areas_elsewhere(file):
    file.move("throng/areas", "throng/kept")
    file["throng/areas"] = h5py.SoftLink("/throng/kept")


def areas_of_a_bomb(file):
    replace(file, "throng/areas/points", shape=(2**27, 2), chunks=(2**16, 2), dtype="<f8")


def queue_of_one_point(file):
    queues = file["throng/queues"]
    replace(file, "throng/queues/points", data=queues["points"][:1])
    queues["offset"][1] = 1


def queue_without_spacing(file):
    file["throng/queues/spacing"][0] = 0.0


def floor_of_two_points(file):
    replace(file, "throng/walkable/offset", data=np.array([0, 2, 4], dtype="<u8"))


def measure_of_nothing(file):
    replace(file, "throng/measures/line", data=np.zeros((1, 4)))


def measure_without_columns(file):
    del file["observables/measure"]


def column_of_few_rows(file):
    file["observables/agents/value"].resize((2,))


def column_too_large(file):
    file["observables/arrived/value"].resize((10**13,))


def column_elsewhere(file):
    del file["observables/arrived"]
    file["observables/arrived"] = h5py.ExternalLink("other.h5", "/arrived")


def altered_density(file):
    (name,) = (name for name in file["observables/measure"] if "density" in file["observables/measure"][name])
    file["observables/measure"][name]["density/value"][1] += 1e-12


def sensor_without_a_rate(file):
    file["throng/sensors/0"].attrs["every"] = np.int64(0)


def sensor_of_no_width(file):
    file["throng/sensors/0"].attrs["fov_degrees"] = 0.0


def sensor_without_end(file):
    file["throng/sensors/0/whom_offset"][1:] = 10**12


def sensor_running_backwards(file):
    file["throng/sensors/0/offset"][1] = 4
    file["throng/sensors/0/offset"][2] = 3


def altered_sensed(file):
    file["throng/sensors/0/whom"][1] += 1


def altered_count(file):
    file["throng/sensors/0/count"][0] += 1


def contacts_too_many(file):
    file["throng/contacts/offset"][1:] = 10**12


def contacts_never_written(file):
    # rows of an empty table that read as zeros
    for name in ("a", "b", "impulse", "point"):
        file["throng/contacts"][name].resize(3, axis=0)
    file["throng/contacts/offset"][1:] = 3


def contacts_of_a_bomb(file):
    file["throng/contacts/point"].resize(10**13, axis=0)


def contacts_without_a_column(file):
    del file["throng/contacts/b"]


def contacts_without_offsets(file):
    file["throng/contacts/offset"].resize((0,))


def presence_of_another(file):
    file["particles/trajectory/id/value"][2, 0] = 9


FAULTS = (area_of_unknown_use, area_of_two_points, area_beyond_its_rings, area_nowhere, fewer_uses_than_areas, areas_elsewhere,
          areas_of_a_bomb, queue_of_one_point, queue_without_spacing, floor_of_two_points, measure_of_nothing,
          measure_without_columns, column_of_few_rows, column_too_large, column_elsewhere, altered_density,
          sensor_without_a_rate, sensor_of_no_width, sensor_without_end, sensor_running_backwards, altered_sensed,
          altered_count, contacts_too_many, contacts_never_written, contacts_of_a_bomb, contacts_without_a_column,
          contacts_without_offsets, presence_of_another)
