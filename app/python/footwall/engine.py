"""A running engine: started for the script, or one that somebody serves."""
import atexit
import functools
import os
import pathlib
import secrets
import threading
import time
import weakref

import numpy

from . import command, connection, faces, pillars
from ._messages import engine_pb2
from .channel import Caller
from .errors import Error
from .journal import Journal
from .live import Live
from .numbers import Model, Numbers, on_lattice
from .project import Project, options, section_words
from .scene import Camera
from .serving import Served
from .tiles import inflated, put_tile

ANSWERED_AT_ONCE = 1.9  # seconds
TIME_TO_DIE = 1.0       # between an error of a dying engine and its end
TIME_TO_HANG = 6.0      # of an engine of this script that is there and does not answer
TIME_TO_COME = 60.0     # until an engine that died answers again
USUAL = ("count", "mean", "variance", "min", "max", "discontinuity", "contrast")  # as `footwall extract`
running = weakref.WeakSet()


def goes_on(method):
    """A call that is made again where the engine died on the way and was started again."""
    @functools.wraps(method)
    def call(self, *words, **named):
        while True:
            known = self.process
            try:
                return method(self, *words, **named)
            except Error as problem:
                self.go_on(problem, known)
    return call


@atexit.register
def end_all():
    for engine in list(running):
        engine.close()


class Engine:
    """A client of an engine. One call at a time in each thread; a script may use it from several.

    A volume goes by its name in the project, or by its checksum; None is the project's first. Index space: i, j, k in
    voxels; of the model and of faces from the survey's first sample, of boxes and isosurfaces from the volume's.

    Where an engine of this machine dies, whoever serves it starts it again with the project as it is by then; the call
    under way is made again, and edits that the project does not have are told again.
    """

    def __init__(self, found, project=None, served=None, file=None, patience=TIME_TO_COME):
        self.project = project
        self._served = served
        self._patience = patience
        self._file = file  # where it is written how to reach it, should that change
        self.caller = Caller(found)
        self._edit = None
        self._lock = threading.Lock()
        self._recovering = threading.Lock()
        self.journal = Journal()
        self.shift = 0  # of this script's edit numbers in the engine that is there now
        self.process = self._told().process
        self._bind()

    @classmethod
    def start(cls, project, ranks=None, threads=None, timeout=60, **how):
        """Starts an engine for this script, with the project's volumes and model, and ends it with the script,
        however that ends. how: further options of `footwall serve`. Raises Error "engine" with its last words."""
        project = project if isinstance(project, Project) else Project(project)
        # In a folder that stays: whatever ends the script, `footwall serve` or its keeper removes the file.
        file = pathlib.Path(connection.home()) / f"python-{os.getpid()}-{secrets.token_hex(4)}.json"
        served = Served([command.program(), "serve", str(project.path), "--connection", str(file),
                         *options(ranks=ranks, threads=threads, **how)], file)
        try:
            served.wait_until_ready(timeout)
            engine = cls(connection.read(file), project, served, file)
        except BaseException:
            served.end()
            raise
        running.add(engine)
        return engine

    @classmethod
    def connect(cls, where, project=None, patience=0):
        """Uses a running engine: "@FILE", the connection file of `footwall serve`, or "unix:PATH" or
        "tcp:HOST:PORT" with the token in FOOTWALL_ENGINE_TOKEN. project: what names of volumes and faults mean. patience: seconds
        for which calls wait until an engine of this machine that died was started again, to go on then."""
        return cls(connection.connection_from(where), project if project is None or isinstance(project, Project)
                   else Project(project), file=where[1:] if where.startswith("@") else None,
                   patience=patience)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Leaves the engine; ends it where this script started it."""
        self.caller.close()
        served, self._served = self._served, None
        if served is not None:
            served.end()
        running.discard(self)

    # ---- What it is doing ----

    def _told(self):
        return self.caller.ask("Status", engine_pb2.StatusRequest(), ANSWERED_AT_ONCE)

    def _bind(self):
        """One that was started since must not answer before it was told what this script has done."""
        if self._file is not None and self._patience > 0:
            self.caller.process = self.process

    def go_on(self, problem, known):
        """Returns where an engine answers that was started since `known` was its process, or that only was silent for
        a while; it has been told all edits then. Raises the problem where it is a call's own, or nobody answers."""
        if problem.code != "engine" or not self.caller.connection.is_here or self._file is None or self._patience <= 0:
            raise problem
        with self._recovering:
            if self.process != known:
                return  # another thread has seen to it
            began = asked = time.monotonic()
            while True:
                if self._served is not None:
                    served, self._served = self._served, self._served.revived()
                    asked = asked if served is self._served else time.monotonic()
                try:
                    found = connection.read(self._file)
                    fresh = Caller(found)  # calls under way keep theirs
                    told = fresh.ask("Status", engine_pb2.StatusRequest(), ANSWERED_AT_ONCE)
                    # One that answers before its file is written has not been told the project.
                    if told.process == found.process and (told.process != known or problem.gone):
                        break
                    if told.process == known and time.monotonic() - began > TIME_TO_DIE:
                        raise problem
                except Error as still:
                    if still is problem or still.code not in ("engine", "not_found"):
                        raise
                    if time.monotonic() - began > self._patience:
                        raise problem from None
                    if self._served is not None and still.code == "engine" and time.monotonic() - asked > TIME_TO_HANG:
                        self._served.kill()
                time.sleep(0.02)
            self._tell_again(told, fresh)

    def _tell_again(self, told, fresh):
        with self._lock:
            edit = told.edit
            for edits in self.journal.batches():
                edit += 1
                fresh.ask("EditModel", engine_pb2.EditBatch(edit=edit, edits=edits))
            # Edits that were not answered come again, under numbers that are new there.
            self.shift = edit
            self.caller, self.process = fresh, told.process
            self._bind()

    @goes_on
    def status(self):
        """The StatusReply of engine.proto: version, host, ranks, threads, volumes, faces, edit, state_hash, jobs
        ..."""
        return self._told()

    def cancel(self, job):
        """Cancels a job of status().jobs by its number; False where there is none."""
        return self.caller.ask("Cancel", engine_pb2.CancelRequest(job=job), ANSWERED_AT_ONCE).found

    def shutdown(self):
        """Ends the engine, for all its clients."""
        self.caller.ask("Shutdown", engine_pb2.ShutdownRequest(), ANSWERED_AT_ONCE)

    # ---- Volumes ----

    def _of_project(self):
        if self.project is None:
            raise Error("usage", "the engine knows no project", "Engine.connect(where, project) takes one")
        return self.project

    def _checksum(self, volume):
        if self.project is None:
            if volume is None:
                raise Error("usage", "which volume?", "name its checksum, or give Engine.connect a project")
            return volume
        known = self.project.info()["volumes"]
        if volume in [each["checksum"] for each in known]:
            return volume
        return self.project.volume(volume)["checksum"]

    @goes_on
    def open_volume(self, volume=None, progress=None):
        """Loads a volume's voxels; quick where they are there. The engine finds it by its checksum (`serve
        --volumes`), or, on this machine, where the project has it. progress(fraction, phase, amounts) is called
        now and then."""
        name = engine_pb2.VolumeName(checksum=self._checksum(volume))
        if self.project is not None and self.caller.connection.is_here:
            name.path = str(self.project.volume_path(self._name(name.checksum)))
        for reply in self.caller.listen("OpenVolume", engine_pb2.OpenVolumeRequest(volume=name), progress):
            if reply.HasField("opened"):
                return reply.opened
        raise Error("engine", "the engine did not say that the volume is open")

    def _name(self, checksum):
        return next(each["name"] for each in self.project.info()["volumes"] if each["checksum"] == checksum)

    @goes_on
    def close_volume(self, volume=None):
        """Frees a volume's memory."""
        self.caller.ask("CloseVolume", engine_pb2.CloseVolumeRequest(volume=self._checksum(volume)))

    @goes_on
    def box(self, volume, lo, hi):
        """Voxels [lo, hi), a float32 array of shape hi - lo, NaN where null."""
        shape = tuple(int(b) - int(a) for a, b in zip(lo, hi))
        ends = [engine_pb2.Index(i=int(end[0]), j=int(end[1]), k=int(end[2])) for end in (lo, hi)]
        request = engine_pb2.ReadBoxRequest(volume=self._checksum(volume), box=engine_pb2.Box(lo=ends[0], hi=ends[1]),
                                            compress=not self.caller.connection.is_here)
        size = 4 * int(numpy.prod(shape, dtype=numpy.int64))
        pieces = bytearray()
        for reply in self.caller.listen("ReadBox", request):
            pieces += inflated(reply.values, size - len(pieces)) if request.compress else reply.values
        if len(pieces) != size:
            raise Error("engine", f"the engine sent {len(pieces)} bytes of a box of {size}")
        return numpy.frombuffer(pieces, dtype="<f4").reshape(shape)

    def section(self, volume=None, *, inline=None, crossline=None, z=None, sample=None):
        """One plane of a volume, read by the engine: as Project.section()."""
        survey = self._of_project().survey
        axis, index = plane(survey, section_words(survey, inline, crossline, z, sample))
        known = self.project.volume(self._name(self._checksum(volume)))
        lo, hi = [0, 0, 0], list(known["dims"])
        lo[axis] = index - known["origin"][axis]
        hi[axis] = lo[axis] + 1
        if not 0 <= lo[axis] < known["dims"][axis]:
            raise Error("invalid", f"volume {known['name']} does not have this plane")
        return self.box(known["checksum"], lo, hi).squeeze(axis=axis)

    # ---- The model ----

    def next_edit(self):
        """A number for an edit: larger than all before it."""
        if self._edit is None:
            edit = self.status().edit - self.shift
            with self._lock:
                self._edit = edit if self._edit is None else self._edit
        with self._lock:
            self._edit += 1
            return self._edit

    def fault_number(self, fault):
        """The number of a fault, by name."""
        if not isinstance(fault, str):
            return int(fault)
        known = self._of_project().faults()
        found = known["fault"][known["name"] == fault]
        if len(found) == 0:
            raise Error("not_found", f"there is no fault '{fault}'", "there are: " + ", ".join(known["name"]))
        return int(found[0])

    @goes_on
    def model(self, fault=None):
        """The faces that the engine holds, of a fault or of all, as a Model."""
        request = engine_pb2.ReadModelRequest(faults=[] if fault is None else [self.fault_number(fault)])
        return Model.joined([reply.faces for reply in self.caller.listen("ReadModel", request)])

    @goes_on
    def load_model(self, fault=None):
        """Puts the project's present meshes in place of the engine's, of a fault or of all; faces that stay as
        they are do not count as changed. Engine.start() has done so."""
        meshes = self._of_project().faces(fault=fault, coordinates="index")
        corners = meshes.corners
        edits = []
        for name in dict.fromkeys(meshes.fault.tolist()):
            rows = numpy.nonzero(meshes.fault == name)[0]
            owners, numbers = zip(*map(faces.number_of, meshes.ids[rows].tolist()))
            number = self.fault_number(name)
            part = Model(numpy.full(len(rows), number), numpy.array(owners, dtype=numpy.int64),
                         numpy.array(numbers, dtype=numpy.int32), corners[rows])
            edits.append(engine_pb2.Edit(replace=engine_pb2.ReplaceFault(fault=number, faces=part.message())))
        self.caller.ask("EditModel", engine_pb2.EditBatch(edit=self.next_edit() + self.shift, edits=edits))
        self.journal.forget(None if fault is None else self.fault_number(fault))

    @goes_on
    def extract(self, volume=None, compute=USUAL, changed_only=False, progress=None, **how):
        """EXTRACT-ALL over the model: Numbers of all faces, or with changed_only of those that changed since the
        last time with these options. compute: names as `footwall extract --compute`. how:
        exchange, balance, voxelizer. Nothing is stored."""
        request = engine_pb2.ExtractRequest(volume=self._checksum(volume), changed_only=changed_only,
                                            options=engine_pb2.ExtractOptions(compute=compute, **how))
        parts, edit = [], 0
        for reply in self.caller.listen("Extract", request, progress):
            if reply.HasField("numbers"):
                parts.append(reply.numbers)
            elif reply.HasField("done"):
                edit = reply.done.edit
        return Numbers.joined(parts, edit)

    def live(self, volume=None, compute=USUAL, **how):
        """A Live, for a `with` block: edits as they are made, numbers as they are ready. compute, how: as for
        extract()."""
        return Live(self, self.caller, self._checksum(volume), engine_pb2.ExtractOptions(compute=compute, **how))

    @goes_on
    def voxels(self, face, volume=None, voxelizer=""):
        """The voxels that a triangle cuts: (indices (n, 3) int32, values (n,) float32, NaN where null). face:
        (fault, id), e.g. ("F1", "3-7.12"), or its corners, (3, 3) in voxels."""
        if isinstance(face, tuple) and len(face) == 2:
            known = self.model(face[0])
            owner, number = faces.number_of(face[1])
            found = numpy.nonzero((known.owners == owner) & (known.numbers == number))[0]
            if len(found) == 0:
                raise Error("not_found", f"the engine has no face {face[1]} of fault {face[0]}")
            face = known.corners[found[0]]
        corners = on_lattice(face)
        if corners.shape != (3, 3):
            raise Error("usage", f"a face has three corners of three numbers, not {corners.shape}")
        request = engine_pb2.FaceVoxelsRequest(volume=self._checksum(volume), corners=corners.ravel().tolist(),
                                               code="voxels", voxelizer=voxelizer)
        places, values = [numpy.empty(0, dtype=numpy.int32)], [numpy.empty(0, dtype=numpy.float32)]
        for reply in self.caller.listen("FaceVoxels", request):
            places.append(numpy.array(reply.places, dtype=numpy.int32))
            values.append(numpy.array(reply.values, dtype=numpy.float32))
        return numpy.concatenate(places).reshape(-1, 3), numpy.concatenate(values)

    # ---- Pillars ----

    def _pillars(self, fault, picked_only=False):
        """Of a fault by name or number, or as they are given."""
        if isinstance(fault, dict):
            return pillars.messages(fault)
        project, fault = self._of_project(), self._fault_name(fault)
        known, nodes = project.pillars(fault), project.nodes(fault)
        places = numpy.stack([nodes[axis] for axis in "xyz"], axis=1)
        return pillars.messages({int(pillar["pillar"]): places[nodes["pillar"] == pillar["pillar"]] for pillar in known
                                 if not (picked_only and pillar["kind"] == "interpolated")})

    def _fault_name(self, fault):
        if isinstance(fault, str):
            return fault
        known = self._of_project().faults()
        found = known["name"][known["fault"] == fault]
        if len(found) == 0:
            raise Error("not_found", f"there is no fault {fault}")
        return str(found[0])

    @goes_on
    def interpolate(self, fault, every=None, tolerance=None):
        """Pillars between those of a fault, a list of NewPillar: every so many lines, or as the surface needs them to
        within `tolerance` voxels. fault: name or number, or {pillar's number: (n, 3) nodes X, Y, z}. Stores nothing;
        Project.interpolate() does."""
        if (every is None) == (tolerance is None):
            raise Error("usage", "how many pillars?", "give one of every= (lines) and tolerance= (voxels)")
        request = engine_pb2.InterpolateRequest(geometry_json=pillars.geometry_json(self._of_project().survey),
                                                pillars=self._pillars(fault, True), every=every, tolerance=tolerance)
        return pillars.new_pillars(self.caller.ask("Interpolate", request))

    @goes_on
    def triangulate(self, fault, detail=0, max_edge=0, tie=0, progress=None):
        """A fault's mesh from its pillars, a Triangulation. fault: as for interpolate(); detail, max_edge, tie in voxels
        (0: the usual), as `footwall triangulate`. Stores nothing; Project.triangulate() does."""
        number = 0 if isinstance(fault, dict) else self.fault_number(fault)
        request = engine_pb2.TriangulateRequest(geometry_json=pillars.geometry_json(self._of_project().survey),
                                                fault=number, pillars=self._pillars(fault), detail=detail,
                                                max_edge=max_edge, tie=tie)
        for reply in self.caller.listen("Triangulate", request, progress):
            return pillars.triangulation(reply.mesh)
        raise Error("engine", "the engine sent no mesh")

    # ---- Isosurfaces and pictures ----

    @goes_on
    def isosurface(self, value, volume=None, normals=True, progress=None):
        """Where a volume has a value: (vertices (v, 3) float32 in voxels, normals (v, 3) or None, triangles (n, 3)
        int64). Normals point to lower values; triangles run counter-clockwise as seen from there."""
        request = engine_pb2.IsosurfaceRequest(volume=self._checksum(volume), value=value, normals=normals)
        replies = self.caller.listen("Isosurface", request, progress)
        parts = [reply.piece for reply in replies if reply.HasField("piece")]

        def joined(name, kind):
            return numpy.concatenate([numpy.empty(0, kind), *(numpy.array(getattr(part, name), kind) for part in parts)]
                                     ).reshape(-1, 3)
        return (joined("positions", numpy.float32), joined("normals", numpy.float32) if normals else None,
                joined("triangles", numpy.int64))

    @goes_on
    def render(self, camera, isosurfaces, size, visible=False, progress=None):
        """A picture of isosurfaces: (rgba (height, width, 4) uint8, depth (height, width) float32), row 0 on top.
        depth: OpenGL window depth, 0 to 1, 1 where nothing is seen (and rgba 0).

        camera: a Camera. isosurfaces: [(volume or None, value, (red, green, blue) 0 to 255)]. size: (width, height).
        visible: extracts only what can be seen; the picture is the same.
        """
        width, height = map(int, size)
        view = (camera or Camera()).view(self._of_project().survey, width, height)
        request = engine_pb2.RenderRequest(width=width, height=height, camera=engine_pb2.Camera(
            view_projection=view.matrix.ravel().tolist(), eye=view.eye.tolist(), right=view.right.tolist(),
            up=view.up.tolist(), forward=view.forward.tolist(), perspective=view.perspective))
        for volume, value, (red, green, blue) in isosurfaces:
            checksum = self._checksum(volume)
            linear, shift = view.scene.placement(self.project.volume(self._name(checksum))["origin"])
            request.isosurfaces.append(engine_pb2.DrawnIsosurface(
                volume=checksum, value=value, colour=0xFF000000 | blue << 16 | green << 8 | red,
                placement=engine_pb2.Placement(linear=linear.ravel().tolist(), shift=shift.tolist())))
        if visible:
            request.visible.SetInParent()
        rgba = numpy.zeros((height, width, 4), dtype=numpy.uint8)
        depth = numpy.ones((height, width), dtype=numpy.float32)
        for reply in self.caller.listen("Render", request, progress):
            if reply.HasField("tile"):
                put_tile(reply.tile, rgba, depth)
        return rgba, depth


def plane(survey, words):
    """(axis, index) of "inline=N", "crossline=N" or "z=VALUE"; first, middle and last are numbers too."""
    name, at = words.split("=", 1)
    axis = ("inline", "crossline", "z").index(name)
    count = survey.shape[axis]
    if at in ("first", "middle", "last"):
        return axis, {"first": 0, "middle": count // 2, "last": count - 1}[at]
    if axis == 2:
        index = float(numpy.rint((float(at) - survey.z0) / survey.interval))
    else:
        lines = (survey.inlines, survey.crosslines)[axis]
        index = (float(at) - lines.first) / lines.step
    if index != int(index) or not 0 <= index < count:
        raise Error("invalid", f"the survey has no {words}")
    return axis, int(index)
