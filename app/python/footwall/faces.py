"""Triangles of faults and their numbers, as arrays."""
import dataclasses
import pathlib
import re
import tempfile

import numpy

from . import command


@dataclasses.dataclass
class Faces:
    """The n triangles of one or all faults.

    vertices: (v, 3) float64. triangles: (n, 3) int32, rows of `vertices`. fault: (n,) names. ids: (n,) names of
    the faces, e.g. "3-7.12", each once in its fault. values: a dict of (n,) float64 arrays by statistic, NaN where
    undefined; empty for present meshes. stale: names of faults that were edited since. run: the run's number, or
    None.
    """
    vertices: numpy.ndarray
    triangles: numpy.ndarray
    fault: numpy.ndarray
    ids: numpy.ndarray
    values: dict
    stale: list
    run: int

    def __len__(self):
        return len(self.triangles)

    @property
    def corners(self):
        """(n, 3, 3): the three vertices of each triangle."""
        return self.vertices[self.triangles]


def read(project, *options):
    """The faces that `footwall faces` writes with these options."""
    with tempfile.TemporaryDirectory(prefix="footwall-python-") as folder:
        file = pathlib.Path(folder) / "faces"
        answer = command.run("faces", project, "--arrays", file, *options)
        described = answer["arrays"]
        arrays = {}
        with open(file, "rb") as opened:
            for array in described["layout"]:
                opened.seek(array["offset"])
                count = int(numpy.prod(array["shape"]))
                arrays[array["name"]] = numpy.fromfile(opened, dtype=array["type"], count=count).reshape(array["shape"])
    names = numpy.array(described["faults"], dtype=str)
    fault = names[arrays["fault"]] if len(names) else numpy.empty(0, dtype=str)
    values = {name.split(":", 1)[1]: array for name, array in arrays.items() if name.startswith("statistic:")}
    return Faces(arrays["vertices"], arrays["triangles"], fault, numpy.char.decode(arrays["face"], "utf-8"), values,
                 answer["stale"], answer["run"])


NAME = re.compile(r"(?:cell ([0-9a-f]+)|(\d+)(?:-(\d+))?)\.(\d+)")


def number_of(face):
    """(owner, number) of a face's name, as the engine counts: two pillars, a cell or a piece, and a number in it."""
    parts = NAME.fullmatch(face)
    if not parts:
        raise ValueError(f"'{face}' is not the name of a face")
    cell, first, second, number = parts.groups()
    if cell is not None:
        owner = int(cell, 16) - (1 << 64)
    else:
        owner = int(first) if second is None else int(first) << 31 | int(second)
    return owner, int(number)


def name_of(owner, number):
    """The inverse of number_of()."""
    owner, number = int(owner), int(number)
    if owner < 0:
        return f"cell {owner + (1 << 64):x}.{number}"
    return f"{owner}.{number}" if owner >> 31 == 0 else f"{owner >> 31}-{owner & ((1 << 31) - 1)}.{number}"
