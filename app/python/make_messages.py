"""Makes the messages and stubs of the engine's service: make_messages.py ENGINE.PROTO PACKAGE_FOLDER

They become PACKAGE_FOLDER/footwall/_messages; protoc and grpc_python_plugin must be installed. Run by CMake and by
setup.py.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

NAME = pathlib.PurePosixPath("footwall/_messages/engine.proto")  # its folder becomes the Python package


def make(proto, package_folder):
    with tempfile.TemporaryDirectory() as scratch:
        copied = pathlib.Path(scratch) / NAME
        copied.parent.mkdir(parents=True)
        shutil.copy(proto, copied)
        plugin = shutil.which("grpc_python_plugin")
        protoc = shutil.which("protoc")
        if plugin is None or protoc is None:
            sys.exit("protoc and grpc_python_plugin are missing: install protobuf-compiler-grpc")
        (pathlib.Path(package_folder) / NAME.parent).mkdir(parents=True, exist_ok=True)
        subprocess.run([protoc, f"--proto_path={scratch}", f"--python_out={package_folder}",
                        f"--grpc_python_out={package_folder}", f"--plugin=protoc-gen-grpc_python={plugin}", str(NAME)],
                       check=True)
    (pathlib.Path(package_folder) / NAME.parent / "__init__.py").write_text('"""Made by make_messages.py."""\n')


if __name__ == "__main__":
    make(sys.argv[1], sys.argv[2])
