"""Edits that an engine has taken and the project does not have: what a fresh engine is told after the project."""
import threading

from ._messages import engine_pb2

FACES_IN_BATCH = 100_000


def told_again(edits):
    """The same edits for an engine that may have taken them: a face that is gone cannot be taken away, so it is put
    there first."""
    for edit in edits:
        if edit.HasField("remove"):
            names = edit.remove
            yield engine_pb2.Edit(put=engine_pb2.Faces(faults=names.faults, owners=names.owners, numbers=names.numbers,
                                                       corners=[0] * (9 * len(names.faults))))
        yield edit


class Journal:
    """Grows with the faces that were edited, not with how often."""

    def __init__(self):
        self._faces = {}  # (fault, owner, number) -> nine corners on the lattice, or None where it is gone
        self._lock = threading.Lock()

    def add(self, edits):
        """Edits of faces, put and remove, that the engine has applied."""
        with self._lock:
            for edit in edits:
                names = edit.put if edit.HasField("put") else edit.remove
                for n, name in enumerate(zip(names.faults, names.owners, names.numbers)):
                    self._faces[name] = tuple(names.corners[9 * n:9 * n + 9]) if edit.HasField("put") else None

    def forget(self, fault=None):
        """The project has what is there, of a fault or of all."""
        with self._lock:
            self._faces = {} if fault is None else {name: at for name, at in self._faces.items() if name[0] != fault}

    def batches(self):
        """Lists of edits that bring a fresh engine to where this one was."""
        with self._lock:
            names = sorted(self._faces)
            for first in range(0, len(names), FACES_IN_BATCH):
                part = names[first:first + FACES_IN_BATCH]
                put, gone = engine_pb2.Faces(), engine_pb2.FaceNames()
                for name in part:
                    corners = self._faces[name]
                    for message in (put,) if corners is not None else (put, gone):
                        for field, value in zip((message.faults, message.owners, message.numbers), name):
                            field.append(value)
                    put.corners.extend(corners if corners is not None else [0] * 9)
                yield [engine_pb2.Edit(put=put), engine_pb2.Edit(remove=gone)]
