"""What a renderer holds on the GPU, texture by texture: targets of a picture, maps of a level, textures made here."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

SAMPLE_BYTES = {"f1": 1, "f2": 2, "f4": 4}
DEPTH_BYTES = 4  # a depth sample with its padding


@dataclass(frozen=True)
class Held:
    """One texture, or one set of generated ones; `kind` is target, level, sky, kept or generated."""

    kind: str
    name: str
    layout: str  # its sides and what a texel is
    bytes: int


def texture_bytes(texture) -> int:
    """Bytes of the first mip level of a texture, all its layers, or of a depth texture."""
    return texture.width * texture.height * getattr(texture, "layers", 1) * _texel_bytes(texture)


def gpu_memory(renderer) -> list[Held]:
    """All textures that a renderer holds now: targets first, each kind by size."""
    kinds = {
        "target": _targets(renderer),
        "level": renderer.uploader.textures.items(),
        "sky": renderer.sky.textures.items(),
        "kept": _kept(renderer),
    }
    rows = [Held(kind, name, _layout(t), texture_bytes(t)) for kind, named in kinds.items() for name, t in named]
    rows += [Held("generated", name, "with its mip levels", held) for name, held in renderer.generated.bytes.items()]
    order = [*kinds, "generated"]
    return sorted(rows, key=lambda row: (order.index(row.kind), -row.bytes))


def _targets(renderer) -> Iterator[tuple[str, object]]:
    for targets in renderer.targets.values():
        yield from targets.textures.items()
        yield "depth", targets.depth


def _kept(renderer) -> Iterator[tuple[str, object]]:
    """Maps that passes keep from frame to frame, by the name of what keeps them."""
    for held in renderer.kept.values():
        for owner in held.values() if isinstance(held, dict) else [held]:
            for texture in getattr(owner, "textures", None) or [getattr(owner, "texture", None)]:
                if texture is not None:
                    yield getattr(owner, "name", type(owner).__name__.lower()), texture


def _texel_bytes(texture) -> int:
    return DEPTH_BYTES if _is_depth(texture) else texture.components * SAMPLE_BYTES[texture.dtype]


def _layout(texture) -> str:
    texel = "depth" if _is_depth(texture) else f"{texture.components} × {8 * SAMPLE_BYTES[texture.dtype]} bit"
    layers = f" × {texture.layers}" if getattr(texture, "layers", 1) > 1 else ""
    return f"{texture.width} × {texture.height}{layers}, {texel}"


def _is_depth(texture) -> bool:
    return getattr(texture, "depth", False)  # an array has no such thing
