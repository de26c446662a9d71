"""How to reach an engine: the file that `footwall serve` writes, or an address and a token."""
import dataclasses
import json
import os
import socket
import stat
import tempfile

from .errors import Error

TOKEN_METADATA = "footwall-token"      # engine/service/words_on_the_wire.h
PROCESS_METADATA = "footwall-process"  # the call is for this engine alone
FAILURE_METADATA = "footwall-error-bin"
CERTIFICATE_NAME = "footwall-engine"
PING_MILLISECONDS = 700                # while a call runs; with the patience below two seconds
PING_PATIENCE_MILLISECONDS = 1100      # above a pause that means nothing
LARGEST_MESSAGE = 64 << 20
LONGEST_FILE = 1 << 20


@dataclasses.dataclass(frozen=True)
class Connection:
    address: str
    token: str = dataclasses.field(repr=False)
    certificate: str = dataclasses.field(default="", repr=False)
    host: str = ""    # where the engine runs
    process: int = 0  # of its first rank; 0 where that is not known

    @property
    def is_here(self):
        """Whether the engine sees this machine's files. A socket may be the near end of a tunnel: the host tells."""
        return self.address.startswith("unix:") and self.host in ("", socket.gethostname())


def read(path):
    """The Connection of a file. Raises Error: "not_found", "format", "invalid" where others can read or write it."""
    try:
        with open(path, "rb") as file:
            known = os.fstat(file.fileno())
            if known.st_uid != os.getuid() or stat.S_IMODE(known.st_mode) & 0o077:
                raise Error("invalid", f"{path} can be read or written by others",
                            "its mode must be 0600, its owner you")
            text = file.read(LONGEST_FILE)
    except FileNotFoundError:
        raise Error("not_found", f"no engine runs: there is no {path}", "footwall serve starts one") from None
    except OSError as error:
        raise Error("io", f"cannot read {path}: {error.strerror}") from None
    try:
        told = json.loads(text)
        if told["footwall_engine"] != 1:
            raise ValueError("another version")
        found = Connection(told["address"], told["token"], told.get("certificate", ""), told.get("host", ""),
                           int(told.get("process", 0)))
    except (ValueError, KeyError, TypeError):
        raise Error("format", f"{path} is not the connection file of an engine") from None
    if not all(isinstance(word, str) for word in dataclasses.astuple(found)[:-1]):
        raise Error("format", f"{path} is not the connection file of an engine")
    return found


def connection_from(where):
    """"@FILE", or "unix:PATH" or "tcp:HOST:PORT" with the token in FOOTWALL_ENGINE_TOKEN or in the file that
    FOOTWALL_ENGINE_TOKEN_FILE names; for "tcp:" FOOTWALL_ENGINE_CERTIFICATE names the engine's certificate."""
    if where.startswith("@"):
        return read(where[1:])
    token = os.environ.get("FOOTWALL_ENGINE_TOKEN", "")
    if not token and "FOOTWALL_ENGINE_TOKEN_FILE" in os.environ:
        token = text_of(os.environ["FOOTWALL_ENGINE_TOKEN_FILE"]).strip()
    if not token:
        raise Error("usage", "there is no token for the engine",
                    "name its connection file (@FILE), or put the token into FOOTWALL_ENGINE_TOKEN")
    if where.startswith("unix:"):
        return Connection(where, token)
    if not where.startswith("tcp:"):
        raise Error("usage", f"'{where}' is not the address of an engine", "write @FILE, unix:PATH or tcp:HOST:PORT")
    if "FOOTWALL_ENGINE_CERTIFICATE" not in os.environ:
        raise Error("usage", "there is no certificate for the engine", "FOOTWALL_ENGINE_CERTIFICATE names its file")
    return Connection(where, token, text_of(os.environ["FOOTWALL_ENGINE_CERTIFICATE"]))


def home():
    """The folder of this user alone where connection files are: as engine/service/client/connection_file.cpp."""
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    path = (os.path.join(runtime, "footwall") if os.path.isdir(runtime)
            else os.path.join(tempfile.gettempdir(), f"footwall-{os.geteuid()}"))
    try:
        os.mkdir(path, 0o700)
    except FileExistsError:
        pass
    known = os.lstat(path)
    if not stat.S_ISDIR(known.st_mode) or known.st_uid != os.geteuid() or known.st_mode & 0o077:
        raise Error("invalid", f"{path} is not this user's own folder", "remove it")
    return path


def text_of(path):
    try:
        with open(path, encoding="utf-8") as file:
            return file.read(LONGEST_FILE)
    except (OSError, UnicodeDecodeError) as error:
        raise Error("io", f"cannot read {path}: {error}") from None
