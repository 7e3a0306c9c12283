"""Read and write levels and what others make: level folders, height maps, images, exports. Heavy modules load late."""

from importlib import import_module

_HOME = {
    "read_level": "package",
    "write_level": "package",
    "LevelFolder": "package",
    "import_height": "terrain_files",
    "Heightmap": "terrain_files",
    "EXPORTERS": "export",
    "export": "export.run",
    "check": "export.verify",
}
__all__ = sorted(_HOME)


def __getattr__(name: str):
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f".{_HOME[name]}", __name__), name)
