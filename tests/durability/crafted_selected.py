# SPDX-License-Identifier: MIT
"""What crafted.py does to a recording of some bodies, with contacts, packed positions and rates of their own."""
import struct
import zlib

import numpy as np

from crafted import replace


def contacts_emptied(file):
    for name in ("a", "b", "impulse", "point"):
        file["throng/contacts"][name].resize(0, axis=0)


def contact_of_nobody(file):
    file["throng/contacts/a"][0] = 0


def contact_with_nobody(file):
    file["throng/contacts/b"][1] = 11


def altered_impulse(file):
    file["throng/contacts/impulse"][0] *= 1 + 2.0**-52


def impulse_not_finite(file):
    file["throng/contacts/impulse"][0] = np.nan


def contact_nowhere(file):
    file["throng/contacts/point"][1, 0] = np.inf


def contacts_running_backwards(file):
    file["throng/contacts/offset"][2] = 3


def contacts_of_another_frame(file):
    file["throng/contacts/offset"][1] = 1


def contacts_of_another_rate(file):
    file["throng/contacts"].attrs.modify("every", 3)


def rate_of_nothing(file):
    file["particles/trajectory/velocity"].attrs.modify("every", 0)


def steps_of_another_rate(file):
    del file["particles/trajectory/velocity/step"]
    file["particles/trajectory/velocity/step"] = file["throng/frames/step"]


def velocity_missing(file):
    file["particles/trajectory/velocity/value"].resize(2, axis=0)


def ids_twice(file):
    file["particles/trajectory/id"][1] = 1


def id_beyond(file):
    file["particles/trajectory/id"][4] = 11


def fewer_bodies_than_rows(file):
    file["parameters"].attrs.modify("bodies", 2)


def quantum_of_nothing(file):
    file["throng/quantized"].attrs.modify("quantum", 0.0)


def quantum_not_finite(file):
    file["throng/quantized"].attrs.modify("quantum", np.nan)


def other_key_frames(file):
    file["throng/quantized"].attrs.modify("key_every", 8)


def positions_in_two_ways(file):
    file["particles/trajectory/position"] = file["particles/trajectory/velocity"]


def positions_side_by_side(file):
    numbers = file["throng/quantized/position"][()]
    replace(file, "throng/quantized/position", data=numbers, chunks=(2, 5, 2), shuffle=True, compression="gzip", fletcher32=True)


def altered_place(file):
    file["throng/quantized/position"][2, 1, 0] += np.uint32(2)


def fletcher32(data):
    # as HDF5's filter has it
    first = second = 0
    for (word,) in struct.iter_unpack(">H", data + b"\0" * (len(data) % 2)):
        first = (first + word) % 65535
        second = (second + first) % 65535
    return struct.pack("<I", (second or 65535) << 16 | (first or 65535))


def put_chunk(file, body, skipped=0):
    file["throng/quantized/position"].id.write_direct_chunk((1, 0, 0), body + fletcher32(body), filter_mask=skipped)


def garbled_chunk(file):
    put_chunk(file, b"\x01\x02" * 30)


def chunk_as_it_is(file):
    put_chunk(file, bytes(range(40)), skipped=3)


def chunk_of_much(file):
    # a little of deflate that would be 400 kB
    put_chunk(file, zlib.compress(bytes(400000), 9))


def chunk_of_little(file):
    put_chunk(file, zlib.compress(bytes(39)))


def large_chunk(file):
    put_chunk(file, zlib.compress(bytes(10**6), 9))


FAULTS = (contacts_emptied, contact_of_nobody, contact_with_nobody, altered_impulse, impulse_not_finite, contact_nowhere,
          contacts_running_backwards, contacts_of_another_frame, contacts_of_another_rate, rate_of_nothing,
          steps_of_another_rate, velocity_missing, ids_twice, id_beyond, fewer_bodies_than_rows, quantum_of_nothing,
          quantum_not_finite, other_key_frames, positions_in_two_ways, positions_side_by_side, altered_place, garbled_chunk,
          chunk_as_it_is, chunk_of_much, chunk_of_little, large_chunk)
