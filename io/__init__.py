"""Read and write levels and what others make: level folders, height maps, images, exports. Heavy modules load late."""

import sys
from importlib import import_module
from types import ModuleType

_HOME = {
    "read_level": "package",
    "write_level": "package",
    "LevelFolder": "package",
    "import_height": "terrain_files",
    "Heightmap": "terrain_files",
    "import_mesh": "meshes",
    "EXPORTERS": "export",
    "export": "export",
    "check": "check_level",
}
__all__ = sorted(_HOME)


def __getattr__(name: str):
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_HOME[name]}", __name__), name)


class _Room(ModuleType):
    """`io.export(level, …)` is the function although the folder `export` beside it bears the same name."""

    def __setattr__(self, name: str, value: object) -> None:
        super().__setattr__(name, value.export if name == "export" and isinstance(value, ModuleType) else value)


sys.modules[__name__].__class__ = _Room
