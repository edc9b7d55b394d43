# SPDX-License-Identifier: MIT
"""Recordings of throng as numpy arrays: one file, on h5py and numpy alone.

    import throng_read
    with throng_read.open("pile.h5") as recording:      # also the pile.h5.part of a run that was killed
        print(recording.name, len(recording), "frames of", len(recording.ids), "bodies")
        last = recording.position[-1]                   # (x, y) in m, a row a body in the order of recording.ids
        some = recording.velocity[100:200:10]           # frame, body, (vx, vy) in m/s
        then = recording.position[recording.index_at(2.5)]   # the frame nearest to 2.5 s
        second = recording.position[recording.between(1, 2), :10]

Indices are frames of the recording. A field that has a rate of its own is not in all of them:
recording.velocity.frames are those that have it, recording.velocity.index_at(2.5) and .between(1, 2) choose of
these, and recording.velocity[recording.velocity.frames] is all there is. With record.within, and of crowds, bodies come
and go: recording.ids has all that ever may be there, who is away has NaN, and recording.frame(i).present is a mask of
those who are there. recording.contacts(i) gives where bodies pressed, recording.observables the measurements, of
agents also "agents", "arrived" and "measure/NAME/count" and so on, recording.bins("speeds") the edges of a histogram's
bins; recording.sensed("NAME", i) whom a sensor found; recording.arrivals who of a crowd left for good, and when;
recording.bodies, .shapes, .materials, .domain, .walls, of crowds .walkable (rings), .areas, .queues, .measures and
.groups, which [[agents]] of the scenario each of ids is of, the scene: recording.position[-1][recording.groups == 0] is the first group.

Whatever isn't there, be it a frame, a field, a sample, a sensor, an observable or a time, raises NotRecorded, which
says what there is. To ask before: .frames of a field (none where it was not recorded), recording.contact_frames,
.sensed_frames("NAME"), .who of what was sensed, `in recording.observables`. Only a Frame, which is all that there
is of one, has None instead.

Nothing is read before it is asked for. Only frames that the run committed are there. Positions, angles,
velocities, spins and arrivals carry checksums: a damaged chunk raises OSError with file and frame when it is read. Contacts,
sensed and observables carry none, nor do the lists of frames: `throng replay --verify`, or any export by throng,
holds them against the hash of their frame. Where a file is no recording, `open` raises NotARecording with one
sentence. The layout is that of sim/recording/layout.h, which says what each name means.
"""
import contextlib
import dataclasses
import errno
import functools
import math
import operator
import os
from collections import namedtuple
from urllib.parse import unquote

import h5py
import numpy as np

MAJOR = 1  # of the layouts that this file reads
SIGNATURE = b"\x89HDF\r\n\x1a\n"
MOST_CHUNK = 16 << 20  # bytes, unpacked
SLACK = 64_000_000  # bytes by which the file of a run that did not end may fall short of what it declares
MOST_SENSORS = 8
DENSEST = 1032  # bytes that deflate can make of one

FIELDS = ("position", "angle", "velocity", "spin")


class Contacts(namedtuple("Contacts", "a b impulse point")):  # ids; N s; (x, y) in m
    """Where bodies pressed in a frame: b is 0 for a wall, the border of the domain and whatever is static."""

    def __repr__(self):
        return f"<{len(self.a)} contacts: {', '.join(self._fields)}>"


class Arrivals(namedtuple("Arrivals", "id step time")):  # s
    """Who got to their goals and left, and when: by step, and then by id."""

    def __repr__(self):
        return f"<{len(self.id)} arrivals: {', '.join(self._fields)}>"


class Bodies(namedtuple("Bodies", "shape material kind radius mass ids")):
    """A row a body that is recorded: rows of shapes and materials; m, kg."""

    def __repr__(self):
        kinds = ", ".join(f"{count} {kind}" for kind, count in zip(*np.unique(self.kind, return_counts=True)))
        return f"<{len(self.ids)} bodies{f' ({kinds})' if kinds else ''}: {', '.join(self._fields)}>"


class Shape(namedtuple("Shape", "name kind radius area centre outline parts holes")):  # parts: (vertices, radius)
    def __repr__(self):
        return f"<shape {self.name!r}: {self.kind}>"


Sensor = namedtuple("Sensor", "name every radius fov_degrees sight")  # steps, m
Material = namedtuple("Material", "name density restitution friction")
Wall = namedtuple("Wall", "points closed material")
Domain = namedtuple("Domain", "kind min max")
Area = namedtuple("Area", "name use rings")  # use: none, goal, wait; inside is what an odd number of rings encloses
Queue = namedtuple("Queue", "name spacing service line")  # m, s; the first of its points is the head
Measure = namedtuple("Measure", "name line rings")  # line: from and to (m), None where an area is measured, of rings


@dataclasses.dataclass(frozen=True, eq=False)
class Frame:
    """All that was recorded of a frame: a row a body in the order of `ids`; None where the frame has none."""
    step: int
    time: float  # s
    hash: int
    ids: np.ndarray
    position: np.ndarray | None  # m
    angle: np.ndarray | None  # rad
    velocity: np.ndarray | None  # m/s
    spin: np.ndarray | None  # rad/s
    present: np.ndarray | None  # a mask of the bodies that are there, as in position[present]; all others have NaN

    def __repr__(self):
        there = [name for name in FIELDS if getattr(self, name) is not None]
        count = "" if self.present is None else f", {np.count_nonzero(self.present)} of {len(self.ids)} bodies"
        return f"<frame of step {self.step}, {self.time:.9g} s{count}: {', '.join(there) or 'no fields'}>"


class NotRecorded(IndexError, KeyError):
    """What was asked for isn't in the recording, or not in this frame; the text says what there is."""

    __str__ = Exception.__str__  # as it is, where KeyError quotes it


class Sensed:
    """Whom a sensor found in a frame: ids of those who have it in `who`, ascending; sensed[id] are those found."""

    def __init__(self, where, who, count, whom):
        self._where, self.who, self.count = where, who, count
        self.whom, self.begin = whom, np.concatenate((np.zeros(1, "u8"), np.cumsum(count, dtype="u8")))
        if len(who) != len(count) or self.begin[-1] != len(whom) or (np.diff(who.astype("i8")) <= 0).any():
            raise ValueError("its rows don't fit each other")

    def __getitem__(self, id):
        if id not in self:
            raise NotRecorded(f"{self._where}: body {id} was not there or doesn't have it; .who lists those who looked")
        row = np.searchsorted(self.who, id)
        return self.whom[int(self.begin[row]):int(self.begin[row + 1])]

    def __contains__(self, id):
        row = np.searchsorted(self.who, id)
        return bool(row < len(self.who) and self.who[row] == id)

    def __iter__(self):
        return iter(self.who)

    def __len__(self):
        return len(self.who)

    def __repr__(self):
        return f"<sensed by {len(self.who)}: {len(self.whom)} ids; who, count, whom, [id]>"


class Measured(dict):
    """Observables by name."""

    def __init__(self, path, values):
        super().__init__(values)
        self._path = path

    def __missing__(self, name):
        raise NotRecorded(f"{self._path} has no observable {name!r}: {_listed(self)}")

    def __repr__(self):
        return f"<observables: {_listed(self)}>"


class NotARecording(ValueError):
    """The file is no recording of throng, or one that this reader can't read; the text says why."""


class Field:
    """A recorded quantity, read as it is indexed: [frame], [frames, bodies], ...

    Indices mean what they mean for numpy arrays, but for lists of both: [frames, bodies] gives these bodies in
    each of these frames, as with np.ix_. np.asarray(field) reads all of it. A frame that lacks the field raises
    NotRecorded.
    """

    def __init__(self, path, name, values, frames, time):
        self._path, self._name, self._values, self._time = path, name, values, time
        self.frames = frames  # of the recording, in which it is; none where it was not recorded
        self.shape = (len(time),) + values.shape[1:]
        self.dtype = values.dtype

    def __len__(self):
        return self.shape[0]

    def __getitem__(self, key):
        first, *rest = key if isinstance(key, tuple) else (key,)
        if first is Ellipsis:
            return self[(slice(None),) * (len(self.shape) - len(rest)) + tuple(rest)]
        if not isinstance(first, slice) and np.ndim(first) == 0:
            frame = _frame(self._path, len(self), first)
            sample = int(self._samples([frame])[0])
            with _damage_named(self._path, f"frame {frame}, {self._name}"):
                values = self._values[sample]
            return values[tuple(rest)]
        if not isinstance(first, slice):
            first = _frames(self._path, len(self), first)
        frames = np.arange(len(self))[first]
        samples = self._samples(frames)
        result = np.empty((len(samples),) + self.shape[1:], self.dtype)
        for row, sample in enumerate(samples):
            with _damage_named(self._path, f"frame {frames[row]}, {self._name}"):
                self._values.read_direct(result, np.s_[int(sample)], np.s_[row])
        return result[(slice(None), *rest)]

    def _samples(self, frames):
        """The rows of the file that are these frames."""
        for frame in frames:
            if not self.is_in(frame):
                self._expect_recorded()
                raise NotRecorded(f"{self._path}: frame {frame} has no {self._name}; {self._name}.frames are those that have")
        return np.searchsorted(self.frames, frames)

    def _expect_recorded(self):
        if not len(self.frames):
            raise NotRecorded(f"{self._path} has no {self._name}: it was not recorded")

    def is_in(self, frame):
        sample = np.searchsorted(self.frames, frame)
        return bool(sample < len(self.frames) and self.frames[sample] == frame)

    def index_at(self, time):
        """Of the frames that have it, the nearest to a time (s); the earlier of two."""
        self._expect_recorded()
        return int(self.frames[_nearest(self._path, self._time[self.frames], time)])

    def between(self, start, end):
        """The frames from `start` to `end` (s), both included, that have it; none where none is between."""
        self._expect_recorded()
        return self.frames[_span(self._path, self._time[self.frames], start, end)]

    def __iter__(self):
        return (self[i] for i in range(len(self)))

    def __array__(self, dtype=None):
        return self[:].astype(dtype or self.dtype, copy=False)

    def __repr__(self):
        return f"<{self._name}: {len(self.frames)} of {len(self)} frames, {self.dtype} {self.shape[1:]} each>"


class Quantized:
    """Positions that are stored as whole multiples of a quantum, packed (sim/recording/packed.h), in metres."""

    def __init__(self, group):
        self._stored = group["position"]
        self._quantum, self._key_every = float(group.attrs["quantum"]), int(group.attrs["key_every"])
        if not self._quantum > 0 or not 0 < self._key_every <= 1024:
            raise ValueError("throng/quantized has attributes out of range")
        self.shape, self.dtype = self._stored.shape, np.dtype("f8")
        self._at, self._now, self._before = None, None, None

    def _next(self, i):
        v = self._stored[i]
        grown = (v >> 1) ^ (np.uint32(0) - (v & np.uint32(1)))
        order = min(i % self._key_every, 2)
        if order == 1:
            grown = grown + self._now
        elif order == 2:
            grown = grown + 2 * self._now - self._before
        self._before, self._now, self._at = self._now, grown, i

    def __getitem__(self, i):
        key = i - i % self._key_every
        with np.errstate(over="ignore"):
            follows = self._at is not None and key <= self._at <= i
            for k in range(self._at + 1 if follows else key, i + 1):
                self._next(k)
        return self._now.view(np.int32) * self._quantum

    def read_direct(self, result, sample, row):
        result[row] = self[sample]


class Region:
    """A field of bodies that come and go, a row for each that ever may: NaN while it is away."""

    def __init__(self, values, present, samples, frames, ids):
        self._values, self._present, self._samples, self._frames, self._ids = values, present, samples, frames, ids
        self._keeps_rows = isinstance(values, Quantized)
        self.shape, self.dtype = values.shape, values.dtype

    def __getitem__(self, sample):
        found = _ids_in_front(self._present[int(self._samples[sample])], self._ids, self._frames[sample])
        result = np.full(self.shape[1:], np.nan, self.dtype)
        rows, values = np.searchsorted(self._ids, found), self._values[sample]
        result[rows] = values[rows] if self._keeps_rows else values[:len(found)]
        return result

    def read_direct(self, result, sample, row):
        result[row] = self[sample]


class Recording:
    """A recording; `time` (s), `step` and `hash` have an entry a frame, the fields a row a frame."""

    def __init__(self, path):
        self._path = os.fsdecode(path)
        self._file = _open_file(self._path)
        try:
            self._read()
        except NotARecording:
            self.close()
            raise
        except Exception as error:  # whatever h5py and numpy say of a damaged file
            self.close()
            raise NotARecording(f"{self._path} is damaged: {error}") from error

    def _read(self):
        if "throng" not in self._file or "h5md" not in self._file:
            raise NotARecording(f"{self._path} is HDF5 but not throng's")
        about = self._file["throng"].attrs
        if int(about["version"][0]) > MAJOR:
            raise NotARecording(f"{self._path} was written by a newer throng: its layout is {about['version'][0]}, "
                                f"this reader knows {MAJOR}")
        self.name, self.description = _text(about["name"]), _text(about["description"])
        self.parameters = {key: _text(value) for key, value in self._file["parameters"].attrs.items()}
        self.scenario = _text(self._get("parameters/scenario")[()])
        self.resolved = _text(self._get("parameters/resolved")[()])
        self.command_line = _text(self._get("parameters/command_line")[()])
        self._read_frames()
        changes = "throng/bodies/id" in self._file  # bodies come into a region, and leave it
        self.ids = self._all("throng/bodies/id" if changes else "particles/trajectory/id")
        self._read_scene()
        self._present = self._bounded("particles/trajectory/id/value", sparse=True) if changes else None
        self._present_step = self._all("particles/trajectory/id/step") if changes else None
        self.sensors = self._sensors()
        for field in FIELDS:
            setattr(self, field, self._field(f"particles/trajectory/{field}"))
        if "throng/quantized" in self._file:
            self.position = self._quantized("throng/quantized")

    def _read_frames(self):
        """The frames that count: those whose hash row stands (sim/recording/layout.h)."""
        committed = self._all("throng/frames/frame_hash")
        self.complete = int(self._get("throng/finished")[()]) != 0 and not self._file.swmr_mode
        written = np.flatnonzero(committed)
        count = int(written[-1]) + 1 if len(written) else 0
        if len(written) != count or (self.complete and count != len(committed)):
            raise ValueError("the list of frames has holes")
        self.step, self.time, self.hash = (self._rows(name, count) for name in ("step", "time", "state_hash"))
        if not (np.diff(self.step) > 0).all() or not np.array_equal(self.time, self.step * self.parameters["dt"]):
            raise ValueError("the list of frames is wrong")

    def _rows(self, name, count):
        rows = self._all(f"throng/frames/{name}")[:count]
        if len(rows) != count:
            raise ValueError("the lists of frames differ in length")
        return rows

    def _read_scene(self):
        domain = self._file["throng/domain"].attrs
        self.domain = Domain(_text(domain["kind"]), domain["min"], domain["max"])
        self.materials = [Material(_text(name), *map(float, numbers)) for name, *numbers in
                          self._columns("throng/materials", Material._fields)]
        kinds = np.array(["dynamic", "static", "kinematic", "agent"])
        shape, material, kind, radius, mass = (self._all(f"throng/bodies/{name}") for name in Bodies._fields[:-1])
        self.bodies = Bodies(shape, material, kinds[kind], radius, mass, self.ids)
        self.shapes = self._shapes()
        offset, points = self._all("throng/walls/offset"), self._all("throng/walls/points")
        self.walls = [Wall(points[a:b], bool(closed), int(material)) for a, b, closed, material in
                      zip(offset, offset[1:], self._all("throng/walls/closed"), self._all("throng/walls/material"))]
        self.walkable = self._lists("throng/walkable")
        self.areas = self._areas()
        self.queues = [Queue(_text(name), float(spacing), float(service), line) for (name, spacing, service), line in zip(
            self._columns("throng/queues", ("name", "spacing", "service")), self._lists("throng/queues"))]
        self.measures = self._measures()

    @functools.cached_property
    def groups(self):
        """Which [[agents]] of the scenario each of `ids` is of, counted from 0; -1 for whoever is no agent."""
        import tomllib  # of Python 3.11
        with _damage_named(self._path, "parameters/resolved"):
            count = [_count_of_group(group) for group in tomllib.loads(self.resolved).get("agents", ())]
            behind = int(self.parameters.get("bodies", len(self.ids))) + 1  # agents have the last ids of the run
            first = np.cumsum([behind - sum(count), *count])
            group = np.searchsorted(first, self.ids, "right") - 1
            group[self.ids >= behind] = -1
            if not np.array_equal(group >= 0, self.bodies.kind == "agent"):
                raise ValueError("its agents are others")
        return group

    def _areas(self):
        """None in files of before 1.6, but in `resolved`."""
        if "throng/areas" not in self._file:
            return []
        rings, offset, uses = self._lists("throng/areas"), self._all("throng/areas/area_offset"), ("none", "goal", "wait")
        return [Area(_text(name), uses[use], rings[a:b]) for (name, use), a, b in zip(
            self._columns("throng/areas", ("name", "use")), offset, offset[1:])]

    def _measures(self):
        if "throng/measures" not in self._file:
            return []
        rings, offset = self._lists("throng/measures"), self._all("throng/measures/area_offset")
        return [Measure(_text(name), None if b > a else line.reshape(2, 2), rings[a:b]) for (name, line), a, b in zip(
            self._columns("throng/measures", ("name", "line")), offset, offset[1:])]

    def _lists(self, group):
        """The lists of points of a group; none where that isn't there."""
        if group not in self._file:
            return []
        offset, points = self._all(f"{group}/offset"), self._all(f"{group}/points")
        return [points[a:b] for a, b in zip(offset, offset[1:])]

    def _shapes(self):
        names = ("outline_offset", "outline", "part_offset", "part_radius", "vertex_offset", "vertices")
        outline_at, outline, part_at, radius, vertex_at, vertices = (self._all(f"throng/shapes/{n}") for n in names)
        parts = [(vertices[a:b], float(r)) for a, b, r in zip(vertex_at, vertex_at[1:], radius)]
        holes = self._holes(len(outline_at) - 1)
        rows = self._columns("throng/shapes", ("name", "kind", "radius", "area", "centre"))
        return [Shape(_text(name), ("disc", "polygon", "composite")[kind], float(r), float(area), centre,
                      outline[outline_at[i]:outline_at[i + 1]], parts[part_at[i]:part_at[i + 1]], holes[i])
                for i, (name, kind, r, area, centre) in enumerate(rows)]

    def _holes(self, shapes):
        if "throng/shapes/hole_offset" not in self._file:  # written before polygons had any
            return [[] for _ in range(shapes)]
        hole_at, ring_at, points = (self._all(f"throng/shapes/{n}") for n in ("hole_offset", "ring_offset", "rings"))
        rings = [points[a:b] for a, b in zip(ring_at, ring_at[1:])]
        return [rings[a:b] for a, b in zip(hole_at, hole_at[1:])]

    def _columns(self, group, names):
        return () if group not in self._file else zip(*(self._all(f"{group}/{name}") for name in names))

    def _frames_of(self, path):
        """The frames that hold what has this attribute `every`; before 1.2 there was none, and all did."""
        every = self._file[path].attrs.get("every")
        if every is None:
            return np.arange(len(self))
        if every < 1:
            raise ValueError(f"{path} has a rate out of range")
        return np.flatnonzero(self.step % every == 0)

    def _field(self, path):
        name, changes = path.rpartition("/")[2], self._present is not None
        of_body = (2,) if name in ("position", "velocity") else ()
        if path not in self._file:
            none = np.empty((0, len(self.ids), *of_body))
            return Field(self._path, name, none, np.arange(0), self.time)
        frames = self._frames_of(path)
        values = self._bounded(path + "/value", sparse=changes)
        if values.dtype.kind != "f" or values.shape[1:] != (len(self.ids), *of_body) or values.shape[0] < len(frames):
            raise ValueError(f"{path} has another form")
        if changes:
            values = Region(values, self._present, self._samples_of_ids(frames), frames, self.ids)
        return Field(self._path, name, values, frames, self.time)

    def _samples_of_ids(self, frames):
        """The rows of id that are these frames."""
        samples = np.searchsorted(self._present_step, self.step[frames])
        if self._present.dtype != np.dtype("u4") or self._present.shape[1:] != (len(self.ids),) or \
                (samples >= len(self._present)).any() or \
                not np.array_equal(self._present_step[samples], self.step[frames]):
            raise ValueError("particles/trajectory/id has another form")
        return samples

    def _quantized(self, path):
        frames, stored = self._frames_of(path), self._bounded(path + "/position", DENSEST)
        if stored.dtype != np.dtype("u4") or stored.shape[0] < len(frames) or stored.shape[1:] != (len(self.ids), 2):
            raise ValueError(f"{path} has another form")
        rows, bodies, columns = stored.chunks or (0, 0, 0)
        if rows != 1 or not 0 < bodies <= max(1, len(self.ids)) or columns != 2:
            raise ValueError(f"{path} has chunks of another form")
        values = Quantized(self._file[path])
        if self._present is not None:
            values = Region(values, self._present, self._samples_of_ids(frames), frames, self.ids)
        return Field(self._path, "position", values, frames, self.time)

    def _sample(self, group, i, what):
        """Frame i, and which of a group's samples it is."""
        i, frames = _frame(self._path, len(self), i), self._frames_with(group)
        if not len(frames):
            raise NotRecorded(f"{self._path} has no {what}: nothing of it was recorded")
        sample = np.searchsorted(frames, i)
        if sample == len(frames) or frames[sample] != i:
            raise NotRecorded(f"{self._path}: frame {i} has no {what}; the nearest that has is "
                              f"{min(frames[max(0, sample - 1):sample + 1], key=lambda frame: abs(int(frame) - i))}")
        return i, int(sample)

    def _frames_with(self, group):
        return self._frames_of(group) if group in self._file else np.arange(0)

    def _run(self, group, offset, names, sample):
        """The rows of a sample in these columns."""
        begin, end = (int(k) for k in self._get(f"{group}/{offset}")[sample:sample + 2])
        return [self._bounded(f"{group}/{name}")[begin:end] for name in names]

    def _ids(self, group, offset, names, sample):
        """The same of columns of ids or counts."""
        columns = self._run(group, offset, names, sample)
        if any(column.dtype != np.dtype("u4") or column.ndim != 1 for column in columns):
            raise ValueError(f"{group} has another form")
        return columns

    @property
    def contact_frames(self):
        """The frames that hold contacts."""
        return self._frames_with("throng/contacts")

    def contacts(self, i):
        """Where bodies pressed on each other or on obstacles in frame i, as Contacts."""
        i, sample = self._sample("throng/contacts", i, "contacts")
        with _damage_named(self._path, f"frame {i}, contacts"):
            return Contacts(*self._run("throng/contacts", "offset", Contacts._fields, sample))

    def _sensors(self):
        """The recorded sensors, as rows of throng/sensors."""
        found = []
        while len(found) < MOST_SENSORS and f"throng/sensors/{len(found)}" in self._file:
            path = f"throng/sensors/{len(found)}"
            if not self._is_own(path):
                raise ValueError(f"{path} is no hard link")
            found.append(Sensor(*(_text(self._file[path].attrs[name]) for name in Sensor._fields)))
        return found

    def _sensor(self, name):
        """Where a sensor's rows stand."""
        for k, sensor in enumerate(self.sensors):
            if sensor.name == name:
                return f"throng/sensors/{k}"
        raise NotRecorded(f"{self._path} has no sensor {name!r}: {_listed(sensor.name for sensor in self.sensors)}")

    def sensed_frames(self, name):
        """The frames in which the sensor of that name looked."""
        return self._frames_with(self._sensor(name))

    def sensed(self, name, i):
        """Whom the sensor of that name found in frame i, as a Sensed."""
        group, what = self._sensor(name), f"rows of sensor {name!r}"
        i, sample = self._sample(group, i, what)
        with _damage_named(self._path, f"frame {i}, {what}"):
            return Sensed(f"{self._path}: frame {i}, {what}", *self._ids(group, "offset", ("who", "count"), sample),
                          *self._ids(group, "whom_offset", ("whom",), sample))

    def _steps(self):
        """The fewest steps that reach the end of the run, up to rounding."""
        steps = self.parameters["until"] / self.parameters["dt"]
        return int(np.ceil(steps - max(1e-9, 4 * np.finfo(float).eps * steps)))

    @functools.cached_property
    def arrivals(self):
        """Who got to their goals and left, as Arrivals; of a run that has ended."""
        if "throng/arrivals" not in self._file or not self.complete:
            raise NotRecorded(f"{self._path} doesn't say who arrived: " + (
                "no agents are in it, or throng was older" if self.complete else "the run hasn't ended"))
        with _damage_named(self._path, "arrivals"):
            id, step = self._all("throng/arrivals/id"), self._all("throng/arrivals/step")
            if not (id.ndim == step.ndim == 1 and id.dtype == np.uint32 and step.dtype == np.int64 and len(id) == len(step)):
                raise ValueError("their lists are wrong")
            ascends = (step[1:] > step[:-1]) | (step[1:] == step[:-1]) & (id[1:] > id[:-1])
            others = self.ids[self.bodies.kind != "agent"]  # agents have the last ids of the run
            first, last = int(others.max(initial=0)) + 1, int(self.parameters["bodies"])
            if not ascends.all() or len(np.unique(id)) < len(id) or len(id) and not (
                    step[0] > 0 and step[-1] <= self._steps() and id.min() >= first and id.max() <= last):
                raise ValueError("no run leaves such lists")
            return Arrivals(id, step, step * self.parameters["dt"])

    @functools.cached_property
    def observables(self):
        """What was measured, read whole once: {name: (value, time in s)}."""
        if "observables" not in self._file:
            return Measured(self._path, {})
        time = self.time[self._frames_of("observables")]
        with _damage_named(self._path, "observables"):
            found = {name: self._all(f"observables/{name}/value") for name in self._elements("observables")}
            for name, value in found.items():
                if len(value) < len(time):
                    raise ValueError(f"{name} has too few rows")
        return Measured(self._path, {unquote(name): (value[:len(time)], time) for name, value in found.items()})

    def bins(self, name):
        """The edges of the bins of an observable that is a histogram, one more than it has numbers a row."""
        value, _ = self.observables[name]
        up_to = self._file[f"observables/{name}"].attrs.get("up_to")
        if up_to is None:
            raise NotRecorded(f"{self._path}: observable {name!r} is no histogram")
        return np.linspace(0.0, float(up_to), value.shape[1] + 1)

    def _elements(self, path, before=""):
        """What holds values below a group: paths, those of measures in groups of their own."""
        for name in self._file[path]:
            if not isinstance(self._file[path].get(name, getlink=True), h5py.HardLink):
                raise ValueError(f"{path}/{name} is no hard link")
            if self._file.get(f"{path}/{name}/value", getclass=True) is h5py.Dataset:
                yield before + name
            elif path.count("/") < 2:
                yield from self._elements(f"{path}/{name}", f"{before}{name}/")

    def _is_own(self, path):
        """Whether all links of a path are to what the file itself holds."""
        parts = path.split("/")
        return all(isinstance(self._file.get("/".join(parts[:k + 1]), getlink=True), h5py.HardLink) for k in range(len(parts)))

    def _get(self, path):
        """A dataset of the file's own; crafted files point at others."""
        if not self._is_own(path):
            raise ValueError(f"{path} is no hard link")
        dataset = self._file[path]
        if not isinstance(dataset, h5py.Dataset) or dataset.is_virtual or dataset.external:
            raise ValueError(f"{path} is no dataset of its own")
        if math.prod(dataset.chunks or ()) * dataset.dtype.itemsize > MOST_CHUNK:
            raise ValueError(f"{path} has chunks that are too large")
        return dataset

    def _bounded(self, path, density=1, sparse=False):
        """One that claims no more than the file can hold; nor does a row of a sparse one, which may lack chunks."""
        dataset = self._get(path)
        room = os.path.getsize(self._path) + (SLACK if self._file.swmr_mode else 0)
        if math.prod(dataset.shape[1:] if sparse else dataset.shape) * dataset.dtype.itemsize > density * room:
            raise ValueError(f"{path} claims more than the file can hold")
        return dataset

    def _all(self, path):
        dataset = self._bounded(path)
        try:
            return dataset[:]
        except OSError as error:
            raise OSError(f"{path}: {error}") from error

    def __len__(self):
        """The number of frames."""
        return len(self.step)

    def frame(self, i):
        """All that was recorded of frame i, as a Frame."""
        i = _frame(self._path, len(self), i)
        fields = (getattr(self, name) for name in FIELDS)
        return Frame(int(self.step[i]), float(self.time[i]), int(self.hash[i]), self.ids,
                     *(field[i] if field.is_in(i) else None for field in fields), self._mask(i))

    __getitem__ = frame

    def _mask(self, i):
        """Which of `ids` are in frame i; None where it has no fields of bodies that come and go."""
        if self._present is None:
            return np.ones(len(self.ids), bool)
        sample = int(np.searchsorted(self._present_step, self.step[i]))
        if sample == min(len(self._present), len(self._present_step)) or self._present_step[sample] != self.step[i]:
            return None
        with _damage_named(self._path, f"frame {i}, id"):
            return np.isin(self.ids, _ids_in_front(self._present[sample], self.ids, i))

    def index_at(self, time):
        """The frame nearest to a time (s); the earlier of two."""
        return _nearest(self._path, self.time, time)

    def between(self, start, end):
        """The frames from `start` to `end` (s), both included, as a slice; an empty one where none is between."""
        return _span(self._path, self.time, start, end)

    def close(self):
        self._file.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        up_to = "" if self._present is None else "up to "
        return f"<recording {self.name!r}: {len(self)} frames of {up_to}{len(self.ids)} bodies>"


def open(path):
    """Opens a recording, or raises NotARecording; FileNotFoundError and the like where there is no file."""
    return Recording(path)


def _count_of_group(group):
    """How many agents an entry of [[agents]] makes."""
    appear = group.get("appear", {})
    return int(group.get("count", len(appear.get("times", (0,))) * appear.get("together", 1) if "times" in appear else 1))


def _open_file(path):
    """As throng does: superblocks of version 3 only, and what a run didn't close is read as SWMR readers do."""
    try:
        with os.fdopen(os.open(path, os.O_RDONLY), "rb") as file:
            head, size = file.read(36), os.path.getsize(path)
    except FileNotFoundError as error:
        if not os.path.exists(path + ".part"):
            raise
        raise FileNotFoundError(errno.ENOENT, f"No such file; {path}.part has the frames of a run that did not end", path) from error
    if not head.startswith(SIGNATURE):
        raise NotARecording(f"{path} is no HDF5 file")
    if len(head) < 12 or head[8] != 3:
        raise NotARecording(f"{path} is HDF5 but not throng's")
    whole = int.from_bytes(head[28:36], "little") if len(head) == 36 else 48  # where it ends, once it was closed
    if head[11] == 0 and size < whole:
        raise NotARecording(f"{path} is cut short: {size} of {whole} bytes are there; copy it once more from where it is whole")
    try:
        return h5py.File(path, "r", libver="latest", swmr=head[11] != 0)
    except OSError as error:
        raise NotARecording(f"{path} is damaged: {error}") from error


@contextlib.contextmanager
def _damage_named(path, where):
    """Whatever h5py and numpy say of what can't be read says where."""
    try:
        yield
    except Exception as error:
        raise OSError(f"{path} is damaged: {where}: {error}") from error


def _ids_in_front(row, ids, frame):
    """The ids of a frame, of a row that has 0 behind them."""
    found = row[:np.count_nonzero(row)]
    if row[len(found):].any() or not np.isin(found, ids).all() or not (np.diff(found.astype("i8")) > 0).all():
        raise OSError(f"frame {frame} has ids that are not in order")
    return found


def _frame(path, count, i):
    """Frame i, counted from the end where it is negative; a time is no frame."""
    i = operator.index(i)
    if not -count <= i < count:
        raise NotRecorded(f"{path} has no frame {i}: " + (f"they go from 0 to {count - 1}" if count else "it has none"))
    return range(count)[i]


def _frames(path, count, some):
    """Frames by number or as a mask; as an index."""
    some = np.asarray(some)
    if some.dtype != bool:
        some = some.astype(int, casting="same_kind") if len(some) else some.astype(int)
        for outside in some[(some < -count) | (some >= count)]:
            _frame(path, count, outside)
    return some


def _nearest(path, times, time):
    _expect_within(path, times, time, time)
    after = int(np.searchsorted(times, time))
    return after - 1 if after and time - times[after - 1] <= times[after] - time else after


def _span(path, times, start, end):
    if start > end:
        raise ValueError(f"from {start} to {end} s goes back in time")
    _expect_within(path, times, start, end)
    return slice(int(np.searchsorted(times, start)), int(np.searchsorted(times, end, "right")))


def _expect_within(path, times, start, end):
    """Throws where nothing from start to end (s) is in the recording."""
    if len(times) and start <= times[-1] and end >= times[0]:
        return
    asked = f"{start} s" if start == end else f"{start} to {end} s"
    raise NotRecorded(f"{path}: {asked} is outside of it, " +
                      (f"it goes from {times[0]:.9g} to {times[-1]:.9g} s" if len(times) else "it has no frames"))


def _listed(names):
    """For a message."""
    names = sorted(names)
    return "there are " + ", ".join(names) if names else "none was recorded"


def _text(value):
    return value.decode() if isinstance(value, bytes) else value
