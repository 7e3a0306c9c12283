"""Shorewright: sculpt the coast while the sea runs. `import shorewright as sw; level = sw.open("NAME.shore")`."""

__version__ = "0.1.0"


def open(path):  # noqa: A001 - the Python face of the product reads like the built-in it resembles
    """Open a level folder and return the `Level`; BadInput when it cannot be read."""
    from .io import read_level

    return read_level(path)
