"""Pillars as the engine takes them, and what it makes of them."""
import dataclasses
import json

import numpy

from ._messages import engine_pb2
from .numbers import Model


@dataclasses.dataclass
class NewPillar:
    """A pillar between two others. first, second: numbers of these; parameter: 0 at the first to 1 at the second;
    nodes: (n, 3) X, Y, z."""
    first: int
    second: int
    parameter: float
    nodes: numpy.ndarray


@dataclasses.dataclass
class Triangulation:
    """A fault's mesh. vertices: (v, 3) X, Y, z; triangles: (n, 3) rows of vertices; faces: the same as a Model, rounded
    as the engine works on them; notes: what there is to be said of the pillars."""
    vertices: numpy.ndarray
    triangles: numpy.ndarray
    faces: Model
    notes: list


def geometry_json(survey):
    """A Survey as storage/survey/geometry_json.h has it."""
    places = {f"{name}_{axis}": float(at[n]) for name in ("origin", "per_inline", "per_crossline")
              for at in (getattr(survey, name),) for n, axis in enumerate("xy")}
    return json.dumps({"inlines": dataclasses.asdict(survey.inlines), "crosslines": dataclasses.asdict(survey.crosslines),
                       "samples": survey.samples, "z0": survey.z0, "interval": survey.interval, "domain": survey.domain,
                       "vertical_unit": survey.vertical_unit, "horizontal_unit": survey.horizontal_unit,
                       "crs": survey.crs or "", "map": places, "assumed": []})


def messages(nodes_of):
    """{pillar's number: (n, 3) X, Y, z} as messages."""
    return [engine_pb2.Pillar(id=number, nodes=numpy.asarray(nodes, dtype=float).reshape(-1, 3).ravel().tolist())
            for number, nodes in nodes_of.items()]


def new_pillars(reply):
    return [NewPillar(pillar.first, pillar.second, pillar.parameter, numpy.array(pillar.nodes).reshape(-1, 3))
            for pillar in reply.pillars]


def triangulation(mesh):
    return Triangulation(numpy.array(mesh.vertices, dtype=float).reshape(-1, 3),
                         numpy.array(mesh.triangles, dtype=numpy.int64).reshape(-1, 3), Model.joined([mesh.faces]),
                         list(mesh.notes))
