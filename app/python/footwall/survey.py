"""The survey's grid: which line, sample and place belongs to which index."""
import dataclasses

import numpy

METRES_PER_FOOT = 0.3048


@dataclasses.dataclass(frozen=True)
class Axis:
    """Line numbers: first, first + step, ... count of them."""
    first: int
    step: int
    count: int

    @property
    def last(self):
        return self.first + (self.count - 1) * self.step


@dataclasses.dataclass(frozen=True)
class Survey:
    """The grid of a project, as `footwall info` tells it.

    inlines, crosslines: Axis. samples: how many. z0: of sample 0, interval: between samples, both in vertical_unit
    ("ms", "m" or "ft"), positive down. origin, per_inline, per_crossline: X and Y as (2,) arrays, of the first
    sample's place and of one index further, in horizontal_unit ("m" or "ft"). crs: as it was named, or None.
    domain: "time" or "depth".
    """
    inlines: Axis
    crosslines: Axis
    samples: int
    z0: float
    interval: float
    vertical_unit: str
    domain: str
    horizontal_unit: str
    crs: str
    origin: numpy.ndarray
    per_inline: numpy.ndarray
    per_crossline: numpy.ndarray

    @classmethod
    def from_facts(cls, facts):
        """From the `survey` of `footwall info --json`; None where a project has none."""
        if facts is None:
            return None
        axes = [Axis(lines["first"], lines["step"], lines["count"])
                for lines in (facts["inlines"], facts["crosslines"])]
        return cls(*axes, facts["samples"], facts["z0"], facts["interval"], facts["vertical_unit"], facts["domain"],
                   facts["horizontal_unit"], facts["crs"],
                   *(numpy.array(facts["map"][name]) for name in ("origin", "per_inline", "per_crossline")))

    @property
    def shape(self):
        """(inlines, crosslines, samples)."""
        return (self.inlines.count, self.crosslines.count, self.samples)

    def world_of(self, index):
        """(..., 3) indices i, j, k -> (..., 3) X, Y, z: CRS and vertical unit, z positive down."""
        index = numpy.asarray(index, dtype=float)
        place = self.origin + index[..., :1] * self.per_inline + index[..., 1:2] * self.per_crossline
        return numpy.concatenate([place, self.z0 + index[..., 2:3] * self.interval], axis=-1)

    def index_of(self, world):
        """(..., 3) X, Y, z -> (..., 3) indices i, j, k, not rounded; the inverse of world_of()."""
        world = numpy.asarray(world, dtype=float)
        across = numpy.linalg.inv(numpy.stack([self.per_inline, self.per_crossline], axis=1))
        lines = (world[..., :2] - self.origin) @ across.T
        return numpy.concatenate([lines, (world[..., 2:3] - self.z0) / self.interval], axis=-1)

    def line_of(self, index):
        """(..., 3) indices -> (..., 3) inline number, crossline number, z."""
        index = numpy.asarray(index, dtype=float)
        first = numpy.array([self.inlines.first, self.crosslines.first, self.z0])
        return first + index * numpy.array([self.inlines.step, self.crosslines.step, self.interval])

    def metres_of(self, world, velocity=2000.0):
        """(..., 3) differences in world units -> metres; times by half the velocity in m/s (2000: 1 ms is 1 m)."""
        world = numpy.asarray(world, dtype=float)
        flat = METRES_PER_FOOT if self.horizontal_unit == "ft" else 1.0
        deep = {"ms": velocity / 2000, "ft": METRES_PER_FOOT, "m": 1.0}[self.vertical_unit]
        return world * numpy.array([flat, flat, deep])
