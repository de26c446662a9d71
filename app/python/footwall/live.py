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
from .journal import told_again
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
        self._unanswered = collections.deque()  # (number, edits)
        self._answers = collections.deque()
        self._changed = threading.Condition(threading.RLock())
        self._sending = threading.Lock()
        self._last = False
        self._answered = 0
        self._ended = None  # how: None while it runs, True, or an Error
        self._meshes = {}
        self._first = engine_pb2.LiveRequest(volume=volume, options=options)

    def __enter__(self):
        self._open(())
        self._listener = threading.Thread(target=self._listen, daemon=True)
        self._listener.start()
        return self

    def __exit__(self, kind, *_):
        """No more edits; waits for the answers on the way, unless an exception leaves the block."""
        if kind is not None:
            self._call.cancel()
        with self._changed:
            self._last = True
            waiting = self._waiting
        try:
            waiting.put(None, timeout=10)
        except queue.Full:
            self._call.cancel()
        self._listener.join(timeout=60)
        self._call.cancel()
        self._keep_answered(also_newest=True)
        if kind is None and isinstance(self._ended, Error):
            raise self._ended

    def _open(self, again):
        """A stream to the engine that is there; again: the batches that it is to be told first."""
        self._caller, self._shift, self._known = self._engine.caller, self._engine.shift, self._engine.process
        self._call = self._caller.stream("Live", self._requests(self._waiting, again, self._shift))

    def _requests(self, waiting, again, shift):
        yield self._first
        for number, edits in again:
            yield self._request(number + shift, told_again(edits))
        while True:
            batch = waiting.get()
            if batch is None:
                return
            yield self._request(batch[0] + shift, batch[1])

    @staticmethod
    def _request(number, edits):
        return engine_pb2.LiveRequest(batch=engine_pb2.EditBatch(edit=number, edits=edits))

    def _listen(self):
        ended = None
        while ended is None:
            call, known = self._call, self._known
            try:
                for reply in call:
                    self._take(reply, self._shift)
                ended = True
            except grpc.RpcError as problem:
                ended = self._after(channel.error_of(problem, self._caller.connection), known)
        with self._changed:
            self._ended = ended
            self._changed.notify_all()

    def _after(self, problem, known):
        """How the stream ends with this problem; None where another one was opened, since the engine was started
        again."""
        try:
            self._keep_answered(also_newest=False)
            self._engine.go_on(problem, known)
        except Error as error:
            return error
        with self._changed:
            former, self._waiting = self._waiting, queue.Queue(WAITING_EDITS)
            if not former.full():
                former.put_nowait(None)  # nobody waits there any longer
            if self._last:
                self._waiting.put_nowait(None)
            self._open(tuple(self._unanswered))
        return None

    def _take(self, reply, shift):
        reply.edit -= min(shift, reply.edit)
        with self._changed:
            if reply.HasField("failure"):
                self._unanswered = collections.deque(each for each in self._unanswered if each[0] != reply.edit)
            else:
                self._answered = reply.edit
            self._answers.append(reply)
            self._changed.notify_all()
        self._keep_answered(also_newest=False)

    def _keep_answered(self, also_newest):
        """The engine has them: a fresh one is told. More of the newest answer may come."""
        with self._changed:
            while self._unanswered and self._unanswered[0][0] < self._answered + also_newest:
                self._engine.journal.add(self._unanswered.popleft()[1])

    def _send(self, *edits):
        with self._sending:
            number = self._engine.next_edit()
            with self._changed:
                if isinstance(self._ended, Error):
                    raise self._ended
                self._unanswered.append((number, edits))
                waiting = self._waiting
            try:
                waiting.put((number, edits), timeout=10)
            except queue.Full:
                if waiting is self._waiting:
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
