"""Footwall from Python: a project's interpretation and numbers as NumPy arrays, and a running engine.

    p = footwall.open("demo.footwall")
    faces = p.statistics()
    with footwall.Engine.start(p, ranks=2) as e:
        ...

Everything that fails raises footwall.Error. docs/python.md has worked examples.
"""
from .errors import Error
from .faces import Faces
from .project import Project, open  # noqa: A004
from .survey import Survey

__all__ = ["Camera", "Engine", "Error", "Faces", "Project", "Survey", "open"]


def __getattr__(name):
    """Engine and Camera are loaded when first asked for: gRPC takes a while."""
    if name == "Engine":
        from .engine import Engine
        return Engine
    if name == "Camera":
        from .scene import Camera
        return Camera
    raise AttributeError(f"module 'footwall' has no attribute '{name}'")
