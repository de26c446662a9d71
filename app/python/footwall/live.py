"""Edits as they are made, numbers as they are ready: newest wins."""
import collections
import dataclasses
import queue
import threading
import time

import grpc
import numpy

from . import channel
from ._messages import engine_pb2
from .errors import Error
from .numbers import LATTICE, Model, Numbers, names_of, on_lattice

WAITING_EDITS = 1000  # that the engine has not taken yet


@dataclasses.dataclass
class LiveNumbers(Numbers):
    """Numbers of the faces that edits touched. edit: the newest one that they know of; those before it that were not
    answered never will be. removed: faults, owners, numbers of faces that are gone. engine_seconds: that it took."""
    removed: tuple = ()
    engine_seconds: float = 0.0


@dataclasses.dataclass
class Mesh:
    """A fault in the engine: vertices (v, 3) in voxels, triangles (n, 3), and faces, the Model that they are of."""
    vertices: numpy.ndarray
    triangles: numpy.ndarray
    faces: Model


class Live:
    """A stream of edits and answers; a `with` block, made by Engine.live()."""

    def __init__(self, engine, caller, volume, options):
        self._engine = engine
        self._caller = caller
        self._waiting = queue.Queue(WAITING_EDITS)
        self._answers = collections.deque()
        self._changed = threading.Condition()
        self._ended = None  # how: None while it runs, True, or an Error
        self._meshes = {}
        self._first = engine_pb2.LiveRequest(volume=volume, options=options)

    def __enter__(self):
        self._call = self._caller.stream("Live", self._requests())
        self._listener = threading.Thread(target=self._listen, daemon=True)
        self._listener.start()
        return self

    def __exit__(self, kind, *_):
        """No more edits; waits for the answers on the way, unless an exception leaves the block."""
        if kind is not None:
            self._call.cancel()
        try:
            self._waiting.put(None, timeout=10)
        except queue.Full:
            self._call.cancel()
        self._listener.join(timeout=60)
        self._call.cancel()
        if kind is None and isinstance(self._ended, Error):
            raise self._ended

    def _requests(self):
        yield self._first
        while True:
            batch = self._waiting.get()
            if batch is None:
                return
            yield engine_pb2.LiveRequest(batch=batch)

    def _listen(self):
        ended = True
        try:
            for reply in self._call:
                with self._changed:
                    self._answers.append(reply)
                    self._changed.notify_all()
        except grpc.RpcError as problem:
            ended = channel.error_of(problem, self._caller.connection)
        with self._changed:
            self._ended = ended
            self._changed.notify_all()

    def _send(self, *edits):
        if isinstance(self._ended, Error):
            raise self._ended
        number = self._engine.next_edit()
        try:
            self._waiting.put(engine_pb2.EditBatch(edit=number, edits=edits), timeout=10)
        except queue.Full:
            raise Error("engine", "the engine takes no more edits", "wait for numbers now and then") from None
        return number

    def mesh(self, fault):
        """The fault (number or name) as the engine holds it, with the moves made here. Vertices at one place are
        one."""
        fault = self._engine.fault_number(fault)
        if fault not in self._meshes:
            faces = self._engine.model(fault)
            places, rows = numpy.unique(on_lattice(faces.corners).reshape(-1, 3), axis=0, return_inverse=True)
            self._meshes[fault] = Mesh(places / LATTICE, rows.reshape(-1, 3), faces)
        return self._meshes[fault]

    def move(self, fault, vertex, position):
        """Moves a vertex, a row of mesh(fault).vertices, to (3,) i, j, k in voxels, rounded to multiples of 1/256.
        Does not wait for the numbers; returns the edit's number."""
        mesh = self.mesh(fault)
        place = on_lattice(position) / LATTICE
        touched = numpy.nonzero((mesh.triangles == vertex).any(axis=1))[0]
        mesh.vertices[vertex] = place
        mesh.faces.corners[touched] = mesh.vertices[mesh.triangles[touched]]
        return self.put(mesh.faces[touched])

    def put(self, faces):
        """Faces (a Model) that are to be there as they stand, whether they were or not. Returns the edit's number."""
        return self._send(engine_pb2.Edit(put=faces.message()))

    def remove(self, faces):
        """Takes faces (a Model) away. Returns the edit's number."""
        return self._send(engine_pb2.Edit(remove=faces.names()))

    def numbers(self, timeout=30):
        """The next answer as LiveNumbers; None where the stream has ended. An edit that was refused raises its
        Error, and the stream goes on. Raises Error "engine" after `timeout` seconds without one."""
        with self._changed:
            if not self._changed.wait_for(lambda: self._answers or self._ended is not None, timeout):
                raise Error("engine", f"no answer within {timeout} seconds")
            if not self._answers:
                if isinstance(self._ended, Error):
                    raise self._ended
                return None
            reply = self._answers.popleft()
        if reply.HasField("failure"):
            raise Error(reply.failure.code, reply.failure.message, reply.failure.hint)
        numbers = Numbers.joined([reply.numbers])
        return LiveNumbers(numbers.faults, numbers.owners, numbers.numbers, numbers.values, reply.edit,
                           names_of([reply.removed]), reply.engine_seconds)

    def wait(self, edit, timeout=30):
        """The first answer that knows of this edit; answers before it are passed over."""
        deadline = time.monotonic() + timeout
        while True:
            answer = self.numbers(max(0.0, deadline - time.monotonic()))
            if answer is None:
                raise Error("engine", f"the stream ended before edit {edit} was answered")
            if answer.edit >= edit:
                return answer
