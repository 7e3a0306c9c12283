"""A page run in headless Chromium: served on a local port, it posts what it found, as files into a folder."""

from __future__ import annotations

import functools
import http.server
import subprocess
import threading
from pathlib import Path
from urllib.parse import unquote, urlsplit

from clients.programs import MODULES, SCRIPTS, need

FLAGS = """--headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --disable-quic --no-first-run
--disable-background-networking --disable-component-update --disable-sync --mute-audio"""


class _Desk(http.server.SimpleHTTPRequestHandler):
    """Serves scripts, npm's packages and the files of one run; writes what is posted below `out`."""

    def __init__(self, *rest, files: dict[str, Path], out: Path, ended: threading.Event, **named) -> None:
        self.files, self.out, self.ended = files, out, ended
        super().__init__(*rest, **named)

    def translate_path(self, path: str) -> str:
        name = unquote(urlsplit(path).path)[1:]
        if name in self.files:
            return str(self.files[name])
        home = MODULES if name.startswith("node_modules/") else SCRIPTS
        return str(home / name.removeprefix("node_modules/"))

    def do_POST(self) -> None:
        path = self.out / unquote(self.path[1:])
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()
        if path.name in ("done", "failed"):
            self.ended.set()

    def log_message(self, *_) -> None:
        pass


def browse(client: str, page: str, files: dict[str, Path], out: Path, seconds: float = 120.0) -> None:
    """Opens `page` of `clients/` (with its query) and waits till it posts `done`; AssertionError when it fails."""
    command = need(client).command
    ended = threading.Event()
    desk = functools.partial(_Desk, files=files, out=out, ended=ended)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), desk)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    url = f"http://127.0.0.1:{server.server_port}/{page}"
    command = [command, *FLAGS.split(), f"--user-data-dir={out / 'profile'}", url]
    browser = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        assert ended.wait(seconds), f"{client} came to no end in {seconds:g} s"
    finally:
        browser.terminate()
        browser.wait(timeout=20)
        server.shutdown()
        server.server_close()
    assert not (out / "failed").exists(), (out / "failed").read_text()
