# SPDX-License-Identifier: MIT
"""What crafted.py does to a recording of who is in a region, of five bodies: 1, 2, 3, 4 and 6 of ten."""
import numpy as np


def region_turned_round(file):
    file["particles/trajectory/id"].attrs.modify("min", np.array([9.0, 9.0]))


def region_without_end(file):
    file["particles/trajectory/id"].attrs.modify("max", np.array([np.inf, 9.0]))


def present(file, ids):
    file["particles/trajectory/id/value"][1] = ids


def ids_that_descend(file):
    present(file, [3, 2, 0, 0, 0])


def ids_with_a_gap(file):
    present(file, [2, 0, 3, 0, 0])


def id_of_nobody(file):
    present(file, [2, 5, 0, 0, 0])


def id_that_came(file):
    present(file, [1, 2, 3, 0, 0])


def id_that_went(file):
    present(file, [2, 0, 0, 0, 0])


def ids_of_few_frames(file):
    file["particles/trajectory/id/value"].resize(1, axis=0)


def ids_of_other_steps(file):
    file["particles/trajectory/id/step"][1] += 1


def ids_at_other_times(file):
    file["particles/trajectory/id/time"][1] += 1e-9


def region_without_ids(file):
    del file["throng/bodies/id"]


FAULTS = (region_turned_round, region_without_end, ids_that_descend, ids_with_a_gap, id_of_nobody, id_that_came, id_that_went,
          ids_of_few_frames, ids_of_other_steps, ids_at_other_times, region_without_ids)
