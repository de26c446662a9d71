"""Calls of the engine's service; what fails becomes an Error."""
import os

os.environ.setdefault("GRPC_VERBOSITY", "NONE")

import grpc  # noqa: E402

from . import connection as wire  # noqa: E402
from ._messages import engine_pb2, engine_pb2_grpc  # noqa: E402
from .errors import Error  # noqa: E402


def channel_to(connection):
    options = [("grpc.max_receive_message_length", wire.LARGEST_MESSAGE),
               ("grpc.max_send_message_length", wire.LARGEST_MESSAGE),
               ("grpc.use_local_subchannel_pool", 1), ("grpc.enable_http_proxy", 0),
               ("grpc.initial_reconnect_backoff_ms", 100), ("grpc.max_reconnect_backoff_ms", 500),
               ("grpc.keepalive_time_ms", wire.PING_MILLISECONDS),
               ("grpc.keepalive_timeout_ms", wire.PING_PATIENCE_MILLISECONDS), ("grpc.http2.max_pings_without_data", 0)]
    if not connection.address.startswith("tcp:"):
        return grpc.insecure_channel(connection.address, options)
    credentials = grpc.ssl_channel_credentials(connection.certificate.encode())
    options.append(("grpc.ssl_target_name_override", wire.CERTIFICATE_NAME))
    return grpc.secure_channel(connection.address[len("tcp:"):], credentials, options)


def gone(message, hint):
    error = Error("engine", message, hint)
    error.gone = True
    return error


def error_of(problem, connection):
    """The Error of a call that failed: what the engine says, or that it is gone."""
    for name, value in problem.trailing_metadata() or ():
        if name == wire.FAILURE_METADATA:
            failure = engine_pb2.Failure()
            try:
                failure.ParseFromString(value)
            except Exception:  # of protobuf, by its implementation: bytes that are no Failure
                break
            return Error(failure.code, failure.message, failure.hint)
    code, words = problem.code(), problem.details() or ""
    if code == grpc.StatusCode.UNAUTHENTICATED:
        return Error("invalid", "the engine does not accept the token",
                     "use the connection file of the engine that runs now")
    if code == grpc.StatusCode.CANCELLED:
        if words.startswith("Locally cancelled"):
            return Error("cancelled", "the call was cancelled")
        # A job that was cancelled is told with a failure: the server leaves its calls.
        return Error("engine", "the engine ends", "start it again with footwall serve")
    if code == grpc.StatusCode.UNIMPLEMENTED:
        return Error("unsupported", "the engine cannot do this", "use a client and an engine of the same version")
    if code in (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.DEADLINE_EXCEEDED):
        if "keepalive" in words or code == grpc.StatusCode.DEADLINE_EXCEEDED:
            return gone(f"the engine at {connection.address} does not answer: it hangs, or the way to it is broken",
                        "footwall status tells whether it is there; end it and start it again if it is not")
        again = f"start it again on {connection.host}" if connection.host else "start it again"
        return gone(f"nobody answers at {connection.address}: the engine has ended, or was never there",
                    again + " with footwall serve")
    return Error("engine", f"the engine says: {words}" if words else f"the call failed: {code.name.lower()}")


class Caller:
    """The service's methods, with the token, as calls that raise Error."""

    def __init__(self, connection):
        self.connection = connection
        self.process = 0  # of the engine that alone is to take calls; 0: any
        self._channel = channel_to(connection)
        self._stub = engine_pb2_grpc.EngineStub(self._channel)

    @property
    def _metadata(self):
        of_engine = ((wire.PROCESS_METADATA, str(self.process)),) if self.process else ()
        return ((wire.TOKEN_METADATA, self.connection.token), *of_engine)

    def close(self):
        self._channel.close()

    def ask(self, method, request, seconds=None):
        """A call with one answer. seconds: of calls that are answered at once."""
        try:
            return getattr(self._stub, method)(request, metadata=self._metadata, timeout=seconds)
        except grpc.RpcError as problem:
            raise error_of(problem, self.connection) from None

    def listen(self, method, request, progress=None):
        """Yields a call's answers but for progress, which is handed to progress(fraction, phase, amounts). To
        leave the loop, or an exception in it, cancels the call."""
        call = getattr(self._stub, method)(request, metadata=self._metadata)
        try:
            for reply in call:
                if "progress" in reply.DESCRIPTOR.fields_by_name and reply.WhichOneof("what") == "progress":
                    if progress is not None:
                        progress(reply.progress.fraction, reply.progress.phase, reply.progress.amounts)
                    continue
                yield reply
        except grpc.RpcError as problem:
            raise error_of(problem, self.connection) from None
        finally:
            call.cancel()

    def stream(self, method, requests):
        """The call object of a method with streams both ways."""
        return getattr(self._stub, method)(requests, metadata=self._metadata)
