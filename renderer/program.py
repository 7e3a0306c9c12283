"""Shader programs: includes, compiling, errors as file:line, hot reload that keeps the last good program.

One file is one program, its stages between `#ifdef VERTEX` and `#ifdef FRAGMENT`; more of STAGES where a define asks.
`#include "level/x.glsl"` reads from level/shaders, `#include "lib/x.glsl"` and plain names from renderer/shaders; every
file is guarded, so it counts once a stage however often it is named.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

SHADERS = Path(__file__).parent / "shaders"
LEVEL_SHADERS = Path(__file__).parents[1] / "level" / "shaders"
MOST_SAMPLERS = 16  # what macOS offers (design, GL 4.1)
SAMPLER_TYPES = {0x8B5D, 0x8B5E, 0x8B5F, 0x8B60, 0x8B62, 0x8DC1, 0x8DC4, 0x8DCA, 0x8DCF, 0x8DD2, 0x8DD7, 0x8DC2}
_INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"\s*$')
# what moderngl calls it, the define of its part of the file, the define of the program that asks for it
STAGES = (
    ("vertex_shader", "VERTEX", ""),
    ("tess_control_shader", "TESS_CONTROL", "TESSELLATED"),
    ("tess_evaluation_shader", "TESS_EVALUATION", "TESSELLATED"),
    ("geometry_shader", "GEOMETRY", "MEASURED"),
    ("fragment_shader", "FRAGMENT", ""),
)
_PLACE = re.compile(r"^(?:ERROR: |WARNING: )?(\d+)[:(](\d+)\)?", re.MULTILINE)


class ShaderError(RuntimeError):
    """A shader doesn't compile or an include is missing; the message carries file:line."""


@dataclass
class Source:
    """A shader with its includes put in; `files[n]` is what `#line … n` means."""

    text: str
    files: list[str] = field(default_factory=list)
    paths: list[Path] = field(default_factory=list)


def shader_path(name: str) -> Path:
    """Where an include name lives."""
    return LEVEL_SHADERS / name[len("level/") :] if name.startswith("level/") else SHADERS / name


def resolve(name: str, texts: dict[str, str] | None = None) -> Source:
    """The text of a shader with every include in place; `texts` overrides files by name. ShaderError when missing."""
    source = Source("")
    lines: list[str] = []
    _put(name, source, lines, (), texts or {})
    source.text = "\n".join(lines) + "\n"
    return source


def _read(name: str, source: Source, stack: tuple[str, ...], texts: dict[str, str]) -> str:
    if name in texts:
        return texts[name]
    path = shader_path(name)
    if not path.is_file():
        raise ShaderError(f"{stack[-1] if stack else name}: there is no shader {name!r}")
    if path not in source.paths:
        source.paths.append(path)
    return path.read_text()


def _put(name: str, source: Source, lines: list[str], stack: tuple[str, ...], texts: dict[str, str]) -> None:
    if name in stack:
        raise ShaderError(f"{stack[-1]}: {name!r} includes itself")
    if name not in source.files:
        source.files.append(name)
    number = source.files.index(name)
    guard = "INCLUDED_" + re.sub(r"\W", "_", name)
    lines += [f"#ifndef {guard}", f"#define {guard}", f"#line 1 {number}"]
    for at, line in enumerate(_read(name, source, stack, texts).splitlines(), 1):
        found = _INCLUDE.match(line)
        if not found:
            lines.append(line)
            continue
        _put(found[1], source, lines, (*stack, name), texts)
        lines.append(f"#line {at + 1} {number}")
    lines.append("#endif")


def explain(error: str, source: Source) -> str:
    """A driver's message with its source numbers replaced by file names."""

    def place(found: re.Match) -> str:
        number = int(found[1])
        name = source.files[number] if number < len(source.files) else found[1]
        return f"{name}:{found[2]}"

    return _PLACE.sub(place, error)


class Shader:
    """A program that follows its files: `program` is always the last one that compiled."""

    def __init__(self, ctx, name: str, defines: dict[str, str] | None = None, texts: dict[str, str] | None = None):
        self.ctx = ctx
        self.name = name
        self.defines = dict(defines or {})
        self.texts = texts
        self.error = ""
        self.generation = 0
        self.source = resolve(name, texts)
        self.stamps = self._stamps()
        self.program = self._compile(self.source)
        self._fullscreen = None

    def _stamps(self) -> dict[Path, int]:
        return {path: path.stat().st_mtime_ns for path in self.source.paths if path.is_file()}

    def _compile(self, source: Source):
        head = "#version 410 core\n#define {}\n" + "".join(f"#define {k} {v}\n" for k, v in self.defines.items())
        try:
            wanted = [(name, part) for name, part, asks in STAGES if not asks or asks in self.defines]
            return self.ctx.program(**{name: head.format(part) + source.text for name, part in wanted})
        except Exception as error:  # moderngl raises its own Error class, drivers differ in the text
            raise ShaderError(f"{self.name}: {explain(str(error), source)}") from None

    def reload(self) -> bool:
        """Compile again when a file changed; on failure keep the last good program and leave the reason in `error`."""
        if self._stamps() == self.stamps:
            return False
        try:
            self.source = resolve(self.name, self.texts)
            program = self._compile(self.source)
        except ShaderError as error:
            self.error, self.stamps = str(error), self._stamps()
            return False
        self.release()
        self.program, self.error, self.stamps = program, "", self._stamps()
        self.generation += 1
        return True

    @property
    def samplers(self) -> list[str]:
        """Names of the samplers the compiled program reads."""
        names = []
        for name in self.program:
            member = self.program[name]
            if getattr(member, "gl_type", None) in SAMPLER_TYPES:
                names.append(name)
        return names

    def fullscreen(self) -> None:
        """Draw one triangle over the whole target; the vertex stage makes it from gl_VertexID."""
        if self._fullscreen is None:
            self._fullscreen = self.ctx.vertex_array(self.program, [])
        self._fullscreen.render(vertices=3)

    def strip(self) -> None:
        """Draw two triangles, whose four corners the vertex stage finds by gl_VertexID."""
        if self._fullscreen is None:
            self._fullscreen = self.ctx.vertex_array(self.program, [])
        self._fullscreen.render(self.ctx.TRIANGLE_STRIP, vertices=4)

    def release(self) -> None:
        if self._fullscreen is not None:
            self._fullscreen.release()
            self._fullscreen = None
        self.program.release()


class Programs:
    """Every shader in use, compiled when first asked for."""

    def __init__(self, ctx) -> None:
        self.ctx = ctx
        self.shaders: dict[tuple, Shader] = {}

    def get(self, name: str, **defines: str) -> Shader:
        """The shader of a file with some defines."""
        key = (name, *sorted(defines.items()))
        if key not in self.shaders:
            self.shaders[key] = Shader(self.ctx, name, defines)
        return self.shaders[key]

    def reload(self) -> list[str]:
        """Follow changed files; returns the errors of those that no longer compile."""
        for shader in self.shaders.values():
            shader.reload()
        return [shader.error for shader in self.shaders.values() if shader.error]

    def release(self) -> None:
        for shader in self.shaders.values():
            shader.release()
        self.shaders.clear()
