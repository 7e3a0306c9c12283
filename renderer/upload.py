"""What the GPU holds of a level: textures pulled by dirty rectangles newer than the last frame, bytes counted."""

from __future__ import annotations

import numpy as np

from ..level import BadInput, Level, Rect
from ..level.beach_map import beach_map
from ..level.layers import LAYERS
from ..level.level import merge
from ..level.river_map import RiverMap, has_rivers, river_map
from ..level.shore import ShoreMap, shore_map
from .bounds import HeightBounds
from .derived_textures import DerivedTextures


class Uploader(DerivedTextures):
    """Height, bed, beach and painted layers of a level, and (its parents) all that follows from it.

    Names are `u_height`, `u_bed`, `u_beach`, `u_tables`; when asked for `u_layer_NAME`, `u_layer_foams`,
    `u_walkable`, `u_shore_field`.
    """

    def __init__(self, ctx) -> None:
        super().__init__(ctx)
        self.bounds: HeightBounds | None = None
        self.felt_bounds: HeightBounds | None = None  # where rivers are felt, 0 or 1
        self.river_bounds: HeightBounds | None = None  # of the level of water that isn't the sea, over its mean
        self.wholes = 0  # how often all of a level's height was sent
        self.level: Level | None = None
        self.most_side = ctx.info["GL_MAX_TEXTURE_SIZE"]

    def sync(self, level: Level) -> None:
        """Bring height, shore map and beach up to date."""
        if self.level is not level:
            self.seen.clear()
            self.level = level
        if max(level.grid.shape) > self.most_side:
            raise BadInput(
                f"this computer's graphics draw at most {self.most_side} samples a side; "
                f"the level has {level.grid.cols} × {level.grid.rows}: crop or resize it"
            )
        self._sync_height(level)
        self._sync_bed(level)
        self._sync_beach(level)

    def _sync_height(self, level: Level) -> None:
        fresh = "height" not in self.seen or self.textures["u_height"].size != (level.grid.cols, level.grid.rows)
        seen = 0 if fresh else self.seen["height"]
        rects = [level.grid.rect] if fresh else level.changed_since("height", seen)
        for rect in rects:
            self._part("u_height", level.height, rect, "f4")
        if fresh:
            self.wholes += 1
            self.bounds = HeightBounds(level.height)
        else:
            for rect in rects:
                self.bounds.update(level.height, rect)
        self.seen["height"] = level.revision

    def _sync_bed(self, level: Level) -> None:
        """The shore map, and above its rows the map of rivers where there are some (D13)."""
        shore, made = shore_map(level), river_map(level)
        rows, cols, channels = shore.packed.shape
        if self._refit("u_bed", (rows if made is None else 2 * rows, cols, channels), "f4"):
            self.seen.pop("shore", None)
            self.seen.pop("rivers", None)
        self._sync_shore(shore)
        if made is not None and self.seen.get("rivers") is not made:
            self._send("u_bed", made.packed, Rect(rows, 0, 2 * rows, cols), "f4")
            self.river_bounds, self.felt_bounds = HeightBounds(_water_levels(made)), HeightBounds(made.felt)
            self.seen["rivers"] = made
        if made is None:
            self.river_bounds = self.felt_bounds = None

    def _sync_shore(self, shore: ShoreMap) -> None:
        known, revision = self.seen.get("shore", (None, 0))
        if known is shore and revision == shore.revision:
            return
        rects = shore.changed_since(revision) if known is shore else _new_in(known, revision, shore)
        for rect in rects:
            self._send("u_bed", shore.packed[rect.slices], rect, "f4")
        self.seen["shore"] = shore, shore.revision

    def _sync_beach(self, level: Level) -> None:
        """The sand under the sheet and the sway along the shore (H10, H20), RG16F; only what changed is sent."""
        beach = beach_map(level)
        known, revision = self.seen.get("beach", (None, 0))
        for rect in beach.changed_since(-1 if known is not beach else revision):
            self._part("u_beach", beach.packed, rect, "f2")
        self.seen["beach"] = beach, beach.revision

    def layer(self, level: Level, name: str):
        """The texture of a painted layer, up to date; one texel while nothing was painted."""
        data, key, sampler = level.layers[name], f"layer_{name}", f"u_layer_{name}"
        dtype = "f2" if LAYERS[name].half else "f4"
        if data.neutral:
            if self.seen.get(key) != "neutral":
                for part, channels in _texels(sampler, np.zeros((1, 1, len(data.row.channels)), np.float32)):
                    self._whole(part, channels, dtype)
                self.seen[key] = "neutral"
            return self.textures[sampler]
        whole = not isinstance(self.seen.get(key), int)
        rects = [data.grid.rect] if whole else level.changed_since(name, self.seen[key])
        for rect in rects:
            for part, channels in _texels(sampler, data.array):
                self._part(part, channels, rect, dtype)
        if whole and data.grid.wraps:
            for part, _ in _texels(sampler, data.array):
                self._smooth(part, tiles=True)
        self.seen[key] = level.layer_revision(name)
        return self.textures[sampler]

    def foam(self, level: Level):
        """Painted foam: the sea's two channels and, where the level has rivers, theirs after them (D14)."""
        if not has_rivers(level):
            return self.layer(level, "foam")
        name, names = "u_layer_foams", ("foam", "river_foam")
        layers = [level.layers[layer] for layer in names]
        if all(layer.neutral for layer in layers):
            if self.seen.get("foams") != "neutral":
                self._whole(name, np.zeros((1, 1, 4), np.float32), "f2")
                self.seen["foams"] = "neutral"
            return self.textures[name]
        fresh = self._refit(name, (*level.grid.shape, 4), "f2") or not isinstance(self.seen.get("foams"), int)
        rects = [level.grid.rect] if fresh else [r for n in names for r in level.changed_since(n, self.seen["foams"])]
        for rect in rects:
            self._send(name, np.concatenate([layer.read(rect) for layer in layers], -1), rect, "f2")
        self.seen["foams"] = level.revision
        return self.textures[name]


def _texels(sampler: str, values: np.ndarray):
    """(name, samples) of the textures that a layer needs: one holds four channels, what is left goes to NAME_more."""
    yield sampler, values if values.ndim == 2 else values[..., :4]
    if values.ndim == 3 and values.shape[2] > 4:
        yield f"{sampler}_more", values[..., 4:]


def _water_levels(made: RiverMap) -> np.ndarray:
    """Level of the water by sample, far below everything where there is none of its own."""
    return np.where(made.packed[..., 1] > 0, made.packed[..., 0], np.float32(-1e6))


def _new_in(known: ShoreMap | None, revision: int, shore: ShoreMap) -> list[Rect]:
    """What the GPU hasn't got of a map that was made anew, when it holds another as that was at a revision.

    A settled stroke makes the whole map anew; most of it is as it was.
    """
    if known is None or known.packed.shape != shore.packed.shape:
        return [Rect(0, 0, *shore.packed.shape[:2])]
    return merge([_difference(known.packed, shore.packed), *known.changed_since(revision)])


def _difference(old: np.ndarray, new: np.ndarray) -> Rect:
    """The rectangle outside which two float32 arrays `(rows, cols, 4)` have the same bits."""
    old, new = (values.view(np.uint64).reshape(len(values), -1) for values in (old, new))
    rows = np.flatnonzero([not np.array_equal(*pair) for pair in zip(old, new)])  # row by row: in the processor's cache
    if not len(rows):
        return Rect(0, 0, 0, 0)
    row0, row1 = int(rows[0]), int(rows[-1]) + 1
    cols = np.flatnonzero((old[row0:row1] != new[row0:row1]).any(axis=0)) // 2
    return Rect(row0, int(cols[0]), row1, int(cols[-1]) + 1)
