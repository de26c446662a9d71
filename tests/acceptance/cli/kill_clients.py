"""Clients of kill_test.py, each a process: they use a served engine through the Python package for as long as their
standard input is open. After each line there they do what they were doing to its end, check it, and answer with a line:
"ok", or what is wrong. An engine that dies is theirs to go on with."""
import os
import pathlib
import sys
import threading
import traceback

BIN = pathlib.Path(os.environ["FOOTWALL_BIN"])
sys.path.insert(0, str(BIN.parent / "python"))
os.environ["FOOTWALL_PROGRAM"] = str(BIN / "footwall")

import numpy  # noqa: E402

import footwall  # noqa: E402

PATIENCE = 100
COMPUTED = ["count", "mean", "variance"]
asked = threading.Event()


def rows_of(numbers):
    return {name: n for n, name in enumerate(zip(numbers.faults.tolist(), numbers.owners.tolist(),
                                                 numbers.numbers.tolist()))}


class Mover:
    """Moves vertices of a fault, each some way from its place, and keeps what it was told of the faces."""

    def __init__(self, engine, fault):
        self.engine, self.fault, self.told, self.step = engine, fault, {}, 0
        # What a mover before this one put, which was killed, stands in nobody's journal: it goes with the engine.
        engine.load_model(fault)

    def once(self, done):
        """One stream of moves, until done()."""
        with self.engine.live(compute=COMPUTED) as live:
            mesh = live.mesh(self.fault)
            last = None
            while not done():
                self.step += 1
                vertex = self.step % len(mesh.vertices)
                place = mesh.vertices[vertex] + [0.25 * (-1) ** self.step, 0, 0]
                last = live.move(self.fault, vertex, place)
                while last - self.answered(live, 0) > 20:  # as a hand, which looks
                    self.answered(live, PATIENCE)
            while last is not None and self.edit < last:
                self.answered(live, PATIENCE)
            self.expected = mesh.faces

    edit = 0

    def answered(self, live, timeout):
        try:
            answer = live.numbers(timeout)
        except footwall.Error as error:
            if timeout or error.message != "no answer within 0 seconds":
                raise
            return self.edit
        if answer is None:
            raise footwall.Error("engine", "the stream ended")
        for name, row in rows_of(answer).items():
            self.told[name] = [answer[each][row] for each in COMPUTED]
        self.edit = answer.edit
        return self.edit

    def check(self):
        """The engine has each face where it was put last; and what was told of it is what an extraction finds."""
        held = self.engine.model(self.fault)
        at = rows_of(held)
        order = [at[name] for name in rows_of(self.expected)]
        if not numpy.array_equal(held.corners[order], self.expected.corners):
            return f"{int((held.corners[order] != self.expected.corners).any(axis=(1, 2)).sum())} faces are not where they were put"
        whole = self.engine.extract(compute=COMPUTED)
        at = rows_of(whole)
        wrong = [name for name, values in self.told.items()
                 if not numpy.array_equal([whole[each][at[name]] for each in COMPUTED], values, equal_nan=True)]
        return f"other numbers of {len(wrong)} of {len(self.told)} faces: {wrong[:3]}" if wrong else "ok"


class Caller:
    """Isosurfaces, pictures and extractions in turn, which are the same each time, whatever dies on the way."""

    def __init__(self, engine):
        self.engine, self.first, self.wrong = engine, {}, "ok"

    def once(self, done):
        calls = {"isosurface": lambda: self.engine.isosurface(0.5)[0],
                 "render": lambda: self.engine.render(footwall.Camera(azimuth=40), [(None, 0.5, (200, 160, 60))],
                                                      (200, 150))[0],
                 "extract": lambda: numpy.sort(self.engine.extract(compute=COMPUTED).ids)}
        while not done():
            for name, call in calls.items():
                made = call()
                if not numpy.array_equal(made, self.first.setdefault(name, made)):
                    self.wrong = f"another {name}"

    def check(self):
        return self.wrong


def listen():
    for _ in sys.stdin:
        asked.set()
    os._exit(0)


def main(kind, file, project):
    threading.Thread(target=listen, daemon=True).start()
    project = footwall.open(project)
    engine = footwall.Engine.connect("@" + file, project, patience=PATIENCE)
    client = Mover(engine, str(project.faults()["name"][0])) if kind == "mover" else Caller(engine)
    print("begun", flush=True)
    while True:
        try:
            client.once(asked.is_set)
            answer = client.check()
        except Exception:  # told to the test, which fails with it
            answer = traceback.format_exc().replace("\n", " | ")
        asked.wait()
        asked.clear()
        print(answer, flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
