"""A small server of the engine's service, whose answers a test can foresee."""
import concurrent.futures
import threading
import zlib

import grpc
import numpy

from footwall._messages import engine_pb2, engine_pb2_grpc

TOKEN = "0123456789abcdef0123456789abcdef"


def voxel(i, j, k):
    """The fake volume's value; null at its first sample."""
    return numpy.where((i == 0) & (j == 0) & (k == 0), numpy.nan, i + 100 * j + 10000 * k).astype("<f4")


class FakeEngine(engine_pb2_grpc.EngineServicer):
    def __init__(self):
        self.faces = {}     # (fault, owner, number) -> nine corners
        self.edit = 7
        self.batches = []   # of Live, as they came
        self.requests = []
        self.hold = threading.Event()  # Extract waits for it
        self.hold.set()
        self.left = threading.Event()  # a client left Extract
        self.bad_tile = False
        self.ends = False      # Extract is left as by an engine that ends

    def check(self, context):
        if dict(context.invocation_metadata()).get("footwall-token") != TOKEN:
            context.abort(grpc.StatusCode.UNAUTHENTICATED, "")

    def fail(self, context, code, message, hint):
        failure = engine_pb2.Failure(code=code, message=message, hint=hint)
        context.set_trailing_metadata((("footwall-error-bin", failure.SerializeToString()),))
        context.abort(grpc.StatusCode.FAILED_PRECONDITION, message)

    def Status(self, request, context):
        self.check(context)
        return engine_pb2.StatusReply(version="fake", ranks=3, edit=self.edit)

    def ReadModel(self, request, context):
        self.check(context)
        for key in sorted(self.faces):  # a piece for each
            if not request.faults or key[0] in request.faults:
                yield engine_pb2.ReadModelReply(faces=engine_pb2.Faces(
                    faults=[key[0]], owners=[key[1]], numbers=[key[2]], corners=self.faces[key]))

    def apply(self, batch):
        for edit in batch.edits:
            faces = edit.replace.faces if edit.HasField("replace") else edit.put
            if edit.HasField("replace"):
                self.faces = {key: value for key, value in self.faces.items() if key[0] != edit.replace.fault}
            for n, key in enumerate(zip(faces.faults, faces.owners, faces.numbers)):
                self.faces[key] = list(faces.corners[9 * n:9 * n + 9])
            for key in zip(edit.remove.faults, edit.remove.owners, edit.remove.numbers):
                del self.faces[key]
        self.edit = batch.edit

    def EditModel(self, request, context):
        self.check(context)
        self.apply(request)
        return engine_pb2.EditModelReply(edit=request.edit, faces=len(self.faces))

    def numbers(self, keys):
        """The mean of a face is the sum of its corners."""
        faults, owners, numbers = zip(*keys) if keys else ((), (), ())
        return engine_pb2.FaceNumbers(faces=engine_pb2.FaceNames(faults=faults, owners=owners, numbers=numbers),
                                      count=[30] * len(keys), mean=[float(sum(self.faces[key])) for key in keys])

    def Extract(self, request, context):
        self.check(context)
        self.requests.append(request)
        context.add_callback(self.left.set)
        yield engine_pb2.ExtractReply(progress=engine_pb2.Progress(fraction=0.5, phase="compute"))
        while not self.hold.wait(0.05):
            if not context.is_active():
                return
        if self.ends:
            context.abort(grpc.StatusCode.CANCELLED, "")
        if request.volume != "cafe":
            self.fail(context, "not_found", "there is no volume " + request.volume, "open one")
        keys = sorted(self.faces)
        for part in (keys[:1], keys[1:]):
            yield engine_pb2.ExtractReply(numbers=self.numbers(part))
        yield engine_pb2.ExtractReply(done=engine_pb2.ExtractDone(edit=self.edit, faces=len(keys)))

    def Live(self, requests, context):
        self.check(context)
        for request in requests:
            if not request.HasField("batch"):
                self.requests.append(request)
                continue
            self.batches.append(request.batch)
            keys = [key for edit in request.batch.edits for key in zip(edit.put.faults, edit.put.owners, edit.put.numbers)]
            gone = [key for edit in request.batch.edits
                    for key in zip(edit.remove.faults, edit.remove.owners, edit.remove.numbers)]
            if any(key not in self.faces for key in gone):
                yield engine_pb2.LiveReply(edit=request.batch.edit, failure=engine_pb2.Failure(
                    code="not_found", message="there is no such face", hint=""))
                continue
            removed = self.numbers(gone).faces
            self.apply(request.batch)
            yield engine_pb2.LiveReply(edit=self.edit, numbers=self.numbers(keys), removed=removed, engine_seconds=0.25)

    def FaceVoxels(self, request, context):
        self.check(context)
        self.requests.append(request)
        yield engine_pb2.FaceVoxelsReply(places=[1, 2, 3], values=[4.5])
        yield engine_pb2.FaceVoxelsReply(places=[1, 2, 4, 1, 2, 5], values=[float("nan"), 6.5])

    def ReadBox(self, request, context):
        self.check(context)
        lo, hi = request.box.lo, request.box.hi
        i, j, k = numpy.meshgrid(numpy.arange(lo.i, hi.i), numpy.arange(lo.j, hi.j), numpy.arange(lo.k, hi.k),
                                 indexing="ij")
        data = voxel(i, j, k).tobytes()
        for at in range(0, len(data), 100):
            piece = data[at:at + 100]
            yield engine_pb2.ReadBoxReply(values=zlib.compress(piece) if request.compress else piece)

    def Isosurface(self, request, context):
        self.check(context)
        yield engine_pb2.IsosurfaceReply(progress=engine_pb2.Progress(fraction=0.1))
        yield engine_pb2.IsosurfaceReply(piece=engine_pb2.SurfacePiece(
            positions=[0, 0, 0, 1, 0, 0, 0, 1, 0], normals=[0, 0, 1] * 3 if request.normals else [], triangles=[0, 1, 2]))
        yield engine_pb2.IsosurfaceReply(piece=engine_pb2.SurfacePiece(
            positions=[1, 1, 0], normals=[0, 0, 1] if request.normals else [], triangles=[1, 3, 2]))
        yield engine_pb2.IsosurfaceReply(done=engine_pb2.IsosurfaceDone(vertices=4, triangles=2))

    def Render(self, request, context):
        self.check(context)
        self.requests.append(request)
        rows = 2
        colours = bytes([1, 2, 3, 4]) * (rows * request.width)
        depths = numpy.full(rows * request.width, 0.25, "<f4").tobytes()
        first = request.height if self.bad_tile else 1
        yield engine_pb2.RenderReply(tile=engine_pb2.Tile(first_row=first, rows=rows, colours=zlib.compress(colours),
                                                          depths=zlib.compress(depths)))
        yield engine_pb2.RenderReply(done=engine_pb2.RenderDone(report_json="{}"))


def serve(engine, address):
    server = grpc.server(concurrent.futures.ThreadPoolExecutor(max_workers=8))
    engine_pb2_grpc.add_EngineServicer_to_server(engine, server)
    server.add_insecure_port(address)
    server.start()
    return server
