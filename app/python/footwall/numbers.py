"""Faces and their numbers as the engine sends them."""
import dataclasses

import numpy

from . import faces
from ._messages import engine_pb2

LATTICE = 256  # positions are whole multiples of 1/256 voxel
WHOLE = ("count", "nulls", "outside")
STATISTICS = ("count", "nulls", "outside", "mean", "variance", "min", "max", "discontinuity", "contrast",
              "offset_voxels", "offset_score")


@dataclasses.dataclass
class Model:
    """Faces by name: faults, owners (n,) int64, numbers (n,) int32; corners (n, 3, 3) float64, i, j, k in voxels."""
    faults: numpy.ndarray
    owners: numpy.ndarray
    numbers: numpy.ndarray
    corners: numpy.ndarray

    def __len__(self):
        return len(self.faults)

    @property
    def ids(self):
        """(n,) names, as the project has them: "3-7.12"."""
        return numpy.array([faces.name_of(*name) for name in zip(self.owners, self.numbers)], dtype=str)

    def message(self):
        return engine_pb2.Faces(faults=self.faults.tolist(), owners=self.owners.tolist(), numbers=self.numbers.tolist(),
                                corners=on_lattice(self.corners).ravel().tolist())

    def names(self):
        return engine_pb2.FaceNames(faults=self.faults.tolist(), owners=self.owners.tolist(),
                                    numbers=self.numbers.tolist())

    def __getitem__(self, rows):
        return Model(self.faults[rows], self.owners[rows], self.numbers[rows], self.corners[rows])

    @classmethod
    def joined(cls, messages):
        corners = [numpy.array(part.corners, dtype=numpy.int32).reshape(-1, 3, 3) for part in messages]
        return cls(*names_of(messages), numpy.concatenate([numpy.empty((0, 3, 3)), *corners]) / LATTICE)


def on_lattice(positions):
    """Positions in voxels, rounded once (ties to even) to the lattice, int64."""
    return numpy.rint(numpy.asarray(positions, dtype=float) * LATTICE).astype(numpy.int64)


def names_of(messages):
    """faults, owners and numbers of Faces or FaceNames, joined."""
    return tuple(numpy.concatenate([numpy.empty(0, dtype=kind), *(numpy.array(getattr(part, name), dtype=kind)
                                                                  for part in messages)])
                 for name, kind in (("faults", numpy.int64), ("owners", numpy.int64), ("numbers", numpy.int32)))


@dataclasses.dataclass
class Numbers:
    """Statistics of n faces: faults, owners (n,) int64, numbers (n,) int32; values: a dict of (n,) arrays by
    statistic, NaN where undefined, and where it was not asked for. edit: the newest edit of the model that they
    know of."""
    faults: numpy.ndarray
    owners: numpy.ndarray
    numbers: numpy.ndarray
    values: dict
    edit: int = 0

    def __len__(self):
        return len(self.faults)

    @property
    def ids(self):
        """(n,) names, as the project has them: "3-7.12"."""
        return numpy.array([faces.name_of(*name) for name in zip(self.owners, self.numbers)], dtype=str)

    def __getitem__(self, statistic):
        return self.values[statistic]

    @classmethod
    def joined(cls, messages, edit=0):
        values = {}
        for name in STATISTICS:
            kind = numpy.int64 if name in WHOLE else numpy.float64
            parts = [numpy.array(getattr(part, name), dtype=kind) for part in messages]
            if any(len(part) for part in parts):
                values[name] = numpy.concatenate(parts)
        return cls(*names_of([part.faces for part in messages]), values, edit)
