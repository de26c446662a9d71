"""A project: what is in it as arrays, and the commands that change it."""
import io
import os
import pathlib
import tempfile
import weakref

import numpy

from . import command, faces
from .editing import Edit
from .errors import Error
from .survey import Survey

FAULT = [("fault", "i8"), ("name", "U200"), ("status", "U40"), ("locked", "?"), ("surface", "?")]
PILLAR = [("pillar", "i8"), ("fault", "i8"), ("kind", "U20"), ("parents", "i8", 2)]
NODE = [("node", "i8"), ("pillar", "i8"), ("fault", "i8"), ("x", "f8"), ("y", "f8"), ("z", "f8")]
RUN = [("run", "i8"), ("name", "U200"), ("volume", "U200"), ("set_by_hand", "U200"), ("when", "U20")]


def options(**named):
    """Options of a command: a list as one option for each, True as a flag; None and False are left out."""
    words = []
    for name, value in named.items():
        if value is None or value is False:
            continue
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        else:
            for each in value if isinstance(value, (list, tuple)) else [value]:
                words += [option, str(each)]
    return words


class Project:
    """One project file. Nothing of it is kept here: every call reads the file as it is then.

    Numbers are in the project's units: X and Y in the survey's CRS, z in its vertical unit, positive down. Everything
    that fails raises footwall.Error.
    """

    def __init__(self, path):
        self.path = pathlib.Path(path).absolute()
        self._edit = None
        self.info()

    def __repr__(self):
        return f"footwall.open({str(self.path)!r})"

    def info(self):
        """What `footwall info --json` tells, as a dict: volumes, faults, runs, statistics with their units ..."""
        return command.run("info", self.path)

    @property
    def survey(self):
        """The Survey, or None."""
        return Survey.from_facts(self.info()["survey"])

    @property
    def volumes(self):
        """The names of the volumes, in the order in which they were added."""
        return [volume["name"] for volume in self.info()["volumes"]]

    def volume(self, name=None):
        """What is known of a volume (None: the first), as a dict: dims, origin, min, max, checksum ..."""
        volumes = self.info()["volumes"]
        for volume in volumes:
            if name is None or volume["name"] == name:
                return volume
        names = ", ".join(volume["name"] for volume in volumes)
        raise Error("not_found", f"there is no volume '{name}'" if name else "the project has no volume",
                    f"there are: {names}" if names else "footwall import volume adds one")

    def volume_path(self, name=None):
        """Where a volume's file is."""
        return pathlib.Path(str(self.path) + ".volumes") / self.volume(name)["file"]

    # ---- The interpretation ----

    def _faults(self, fault=None):
        return command.run("faults", self.path, *options(fault=fault))["faults"]

    def faults(self):
        """A structured array: fault (number), name, status, locked, surface (True: imported, without pillars)."""
        return numpy.array([(row["fault"], row["name"], row["status"], row["locked"], row["surface"] is not None)
                            for row in self._faults()], dtype=FAULT)

    def pillars(self, fault=None):
        """Pillars of a fault (None: of all) as a structured array: pillar, fault, kind ("interpreted",
        "interpolated", "snapped"), parents (of an interpolated one, else 0)."""
        return numpy.array([(pillar["pillar"], row["fault"], pillar["kind"], pillar.get("parents", (0, 0)))
                            for row in self._faults(fault) for pillar in row["pillars"]], dtype=PILLAR)

    def nodes(self, fault=None):
        """Nodes of a fault (None: of all) as a structured array, in their order along each pillar: node, pillar,
        fault, x, y, z."""
        return numpy.array([(node["node"], pillar["pillar"], row["fault"], node["x"], node["y"], node["z"])
                            for row in self._faults(fault) for pillar in row["pillars"] for node in pillar["nodes"]],
                           dtype=NODE)

    def edit(self):
        """An Edit, for a `with` block: adds, moves and deletes faults, pillars and nodes."""
        self._let_go()
        edit = Edit(self.path)
        self._edit = weakref.ref(edit)
        return edit

    def _let_go(self):
        """Before another writer: an open Edit would hold the project."""
        edit = self._edit() if self._edit is not None else None
        if edit is not None:
            edit.close()

    def _write(self, *words, text=None):
        self._let_go()
        return command.run(words[0], self.path, *words[1:], text=text)

    def undo(self):
        """Takes the last edit back."""
        return self._write("undo")

    def redo(self):
        """Brings it back."""
        return self._write("redo")

    # ---- Meshes and their numbers ----

    def interpolate(self, fault=None, **how):
        """Inserts pillars: every= (lines) or tolerance= (voxels); remove=True takes them away."""
        return self._write("interpolate", *options(fault=fault, **how))

    def triangulate(self, fault=None, **how):
        """Pillars to meshes; detail=, max_edge=, tie= in voxels, rechart=True: as `footwall triangulate`."""
        return self._write("triangulate", *options(fault=fault, **how))

    def extract(self, volume=None, compute=None, **how):
        """EXTRACT-ALL; compute: names (None: the usual ones); fault=, ranks=, threads=, name=, velocity= ...: as
        `footwall extract`. Returns its JSON, with the number of the run."""
        compute = ",".join(compute) if isinstance(compute, (list, tuple)) else compute
        return self._write("extract", *options(volume=volume, compute=compute, **how))

    def faces(self, fault=None, coordinates="world"):
        """The present meshes as Faces, without numbers. coordinates: "world", or "index": the rounded positions
        that the engine works on, in voxels."""
        return faces.read(self.path, "--present", *options(fault=fault, coordinates=coordinates))

    def statistics(self, run=None, fault=None, coordinates="world"):
        """The faces of a run with their numbers, as Faces. run: number or name (None: the last that was computed)."""
        return faces.read(self.path, *options(run=self._run_number(run), fault=fault, coordinates=coordinates))

    def runs(self):
        """A structured array, oldest first: run (number), name, volume, set_by_hand (the statistic, or ""), when
        (UTC)."""
        return numpy.array([(row["run"], row["name"], row["volume"] or "", row["set_by_hand"] or "", row["when"])
                            for row in self.info()["runs"]], dtype=RUN)

    def _run_number(self, run):
        if not isinstance(run, str):
            return None if run is None else int(run)
        runs = self.runs()
        found = runs["run"][runs["name"] == run]
        if len(found) == 0:
            raise Error("not_found", f"there is no run '{run}'", "there are: " + ", ".join(runs["name"]))
        return int(found[-1])

    def set_statistic(self, name, values, unit="1", faces=None, run=None):
        """Keeps a number of your own for each face, as a run that is listed, exported and coloured like any other.

        values: (n,) floats, NaN where undefined, of the n faces in `faces` (Faces; None: all of self.faces(), in
        their order). unit: in words, "1" for none. run: its name (None: that of the statistic); a former run of
        this name and statistic is replaced. Raises Error "invalid" for faces that are no longer there.
        """
        faces = self.faces() if faces is None else faces
        values = numpy.asarray(values, dtype=float)
        if values.shape != (len(faces),):
            raise Error("invalid", f"{name}: numbers of shape {values.shape} for {len(faces)} faces")
        table = io.StringIO()
        table.write("fault,face,value\n")
        quoted = {fault: '"' + fault.replace('"', '""') + '"' for fault in set(faces.fault.tolist())}
        for fault, face, value in zip(faces.fault.tolist(), faces.ids.tolist(), values.tolist()):
            table.write(f"{quoted[fault]},{face},{'' if value != value else repr(value)}\n")
        return self._write("set-statistic", name, "--values", "-", *options(unit=unit, run=run), text=table.getvalue())

    # ---- Volumes and pictures ----

    def section(self, volume=None, *, inline=None, crossline=None, z=None, sample=None):
        """One plane of a volume (None: the first), (rows, columns) float32, NaN where null.

        inline=N: (crosslines, samples). crossline=N: (inlines, samples). z=VALUE in the vertical unit, or sample=N
        from 0: (inlines, crosslines). Lines go by number, or "first", "middle", "last". Raises Error "invalid" for
        a plane that is not there.
        """
        words = section_words(self.survey, inline, crossline, z, sample)
        with tempfile.TemporaryDirectory(prefix="footwall-python-") as folder:
            file = os.path.join(folder, "section")
            answer = command.run("export", self.path, "--raw", file, "--section", words, *options(volume=volume))
            return numpy.fromfile(file, dtype="<f4").reshape(answer["section"]["dims"])

    def render(self, out, **how):
        """A picture of the project as a PNG: faults=True, statistic=, run=, section=, isosurface=, camera=, size=,
        depth= ...: as `footwall render`. Returns its JSON."""
        run = self._run_number(how.pop("run", None))
        return command.run("render", self.path, "--out", out, *options(run=run, **how))


def section_words(survey, inline, crossline, z, sample):
    """One of the four as the command line says it."""
    given = [(name, value) for name, value in (("inline", inline), ("crossline", crossline), ("z", z),
                                               ("sample", sample)) if value is not None]
    if len(given) != 1:
        raise Error("usage", "a section is one plane", "give one of inline=, crossline=, z= or sample=")
    name, value = given[0]
    if name == "sample":
        if survey is None or not 0 <= int(value) < survey.samples:
            raise Error("invalid", f"the survey has no sample {value}")
        return f"z={survey.z0 + int(value) * survey.interval!r}"
    return f"{name}={value}"


def open(path):  # noqa: A001 (footwall.open)
    """Opens a project for reading; calls that change it take it for writing while they last. Raises Error."""
    return Project(path)
