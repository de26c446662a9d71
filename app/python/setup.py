"""What pyproject.toml cannot say: the engine's messages are made while the package is built."""
import pathlib
import sys

from setuptools import setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import make_messages  # noqa: E402


class BuildWithMessages(build_py):
    def run(self):
        super().run()
        make_messages.make(HERE.parents[1] / "engine" / "service" / "engine.proto", self.build_lib)


setup(cmdclass={"build_py": BuildWithMessages})
