"""Edits of the interpretation, each one undoable, through `footwall edit`: the project's one writer."""
import json
import subprocess
import tempfile

import numpy

from . import command
from .errors import Error


def plain(position):
    """A position as three plain numbers."""
    return [float(value) for value in numpy.asarray(position, dtype=float).reshape(3)]


def named(fault):
    """A fault's name or number as JSON takes it."""
    return str(fault) if isinstance(fault, str) else int(fault)


class Edit:
    """Adds, moves and deletes; every call is one step of undo and on disk when it returns.

    Positions are X, Y, z: the survey's CRS and vertical unit, z positive down. Faults go by name or number,
    pillars and nodes by number. While the `with` block lasts, the project is held: nobody else can write it
    ("held"). A call that is refused raises Error and changes nothing; those before it stay.
    """

    def __init__(self, path):
        self._path = path
        self._process = None
        self._words = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Lets go of the project. Another call takes it again."""
        process, self._process = self._process, None
        if process is None:
            return
        process.stdin.close()
        process.stdout.close()
        status = process.wait()
        self._words.seek(0)
        words = self._words.read()
        self._words.close()
        if status != 0:
            raise command.error_of("", status, words)

    def _drop(self):
        process, self._process = self._process, None
        if process is not None:
            process.stdin.close()
            process.stdout.close()
            process.wait()
            self._words.close()

    def _ask(self, **line):
        if self._process is None:
            self._words = tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace")
            self._process = subprocess.Popen([command.program(), "edit", str(self._path)], stdin=subprocess.PIPE,
                                             stdout=subprocess.PIPE, stderr=self._words, encoding="utf-8")
        try:
            self._process.stdin.write(json.dumps(line, allow_nan=False) + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            pass  # its last line says why
        except ValueError as error:
            self._drop()
            raise Error("invalid", f"a number of this edit is not finite: {error}") from None
        answer = self._process.stdout.readline()
        try:
            reply = json.loads(answer)
        except ValueError:
            reply = {"error": None}
        if "error" not in reply:
            return reply
        self._words.seek(0)
        error = command.error_of(answer, 1, self._words.read())
        self._drop()
        raise error

    def add_fault(self, name, **properties):
        """Adds a fault; properties: colour, interpreter, status, note. Returns its number."""
        return self._ask(op="add", what="fault", name=name, **properties)["fault"]

    def rename_fault(self, fault, name):
        self._ask(op="rename", what="fault", fault=named(fault), name=name)

    def delete_fault(self, fault):
        self._ask(op="delete", what="fault", fault=named(fault))

    def add_pillar(self, fault, nodes):
        """Adds a pillar. nodes: (n, 3). Returns its number and those of its nodes, (n,) int64."""
        reply = self._ask(op="add", what="pillar", fault=named(fault), nodes=[plain(node) for node in nodes])
        return reply["pillar"], numpy.array(reply["nodes"], dtype=numpy.int64)

    def move_pillar(self, pillar, by):
        """Moves a pillar by (3,)."""
        dx, dy, dz = plain(by)
        self._ask(op="move", what="pillar", pillar=int(pillar), dx=dx, dy=dy, dz=dz)

    def delete_pillar(self, pillar):
        self._ask(op="delete", what="pillar", pillar=int(pillar))

    def add_node(self, pillar, position, at=None):
        """Inserts a node at a place in a pillar, from 0 (None: at its end). Returns its number."""
        place = {} if at is None else {"at": int(at)}
        return self._ask(op="add", what="node", pillar=int(pillar), position=plain(position), **place)["node"]

    def move_node(self, node, position):
        self._ask(op="move", what="node", node=int(node), position=plain(position))

    def delete_node(self, node):
        self._ask(op="delete", what="node", node=int(node))
