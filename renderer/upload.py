"""What the GPU holds of a level: textures pulled by dirty rectangles newer than the last frame, bytes counted."""

from __future__ import annotations

from collections import Counter

import numpy as np

from ..level import BadInput, Level, Rect
from ..level.arrival_map import ArrivalMap
from ..level.beach_map import beach_map
from ..level.beach_raster import beach_raster
from ..level.flow import current
from ..level.flow_bytes import flow_bytes
from ..level.layers import LAYERS, WEATHER_GRID
from ..level.level import merge
from ..level.patches import patch_kinds
from ..level.river_map import RiverMap, has_rivers, river_map
from ..level.shore import ShoreMap, shore_map
from ..level.shore_field import shore_field
from ..level.tables import tables
from ..level.walk import highest_sea_m
from ..level.water_table import table_in_use
from .bounds import HeightBounds


class Uploader:
    """`textures` by sampler name, `bytes` sent, `sent` by name.

    Names are `u_height`, `u_bed`, `u_beach`, `u_tables`; when asked for `u_layer_NAME`, `u_layer_foams`,
    `u_walkable`, `u_shore_field`.
    """

    def __init__(self, ctx) -> None:
        self.ctx = ctx
        self.textures: dict = {}
        self.sent: Counter[str] = Counter()
        self.bounds: HeightBounds | None = None
        self.felt_bounds: HeightBounds | None = None  # where rivers are felt, 0 or 1
        self.river_bounds: HeightBounds | None = None  # of the level of water that isn't the sea, over its mean
        self.seen: dict[str, object] = {}
        self.wholes = 0  # how often all of a level's height was sent
        self.level: Level | None = None
        self.most_side = ctx.info["GL_MAX_TEXTURE_SIZE"]

    @property
    def bytes(self) -> int:
        """Bytes sent since this was made."""
        return sum(self.sent.values())

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

    def arrival(self, made: ArrivalMap):
        """When swells arrive (T06), RGBA32F: times below, heights above; under a tide twice."""
        seen = self.seen.get("arrival", ())
        if len(seen) != len(made.sources) or any(a is not b for a, b in zip(seen, made.sources)):
            self._whole("u_arrival", made.texture, "f4")
            self.seen["arrival"] = made.sources
        return self.textures["u_arrival"]

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
                texture = self.textures[part]
                texture.filter = self.ctx.LINEAR, self.ctx.LINEAR
                texture.repeat_x = texture.repeat_y = True
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

    def weather_noise(self, level: Level, make):
        """The noise of the weather's simulation (Z05), RGBA16F, tiling."""
        seed = level.settings.level.seed
        if self.seen.get("weather_noise") != seed:
            self._whole("u_weather_noise", make(seed), "f2")
            texture = self.textures["u_weather_noise"]
            texture.filter = self.ctx.LINEAR, self.ctx.LINEAR
            texture.repeat_x = texture.repeat_y = True
            self.seen["weather_noise"] = seed
        return self.textures["u_weather_noise"]

    def shot_skies(self, level: Level, names: tuple[str, ...]):
        """Skies of shots (Z20), RGBA16F, tiling, a layer each; a texel for none. Layers are kept while they fit."""
        sampler, held = "u_weather_shot_skies", self.seen.get("u_weather_shot_skies")
        texture = self.textures.get(sampler)
        if held is None or len(names) > texture.layers or (names and texture.width == 1):
            if texture is not None:
                texture.release()
            side = WEATHER_GRID.rows if names else 1
            texture = self.ctx.texture_array((side, side, max(len(names), 1)), 4, dtype="f2")
            texture.filter = self.ctx.LINEAR, self.ctx.LINEAR
            texture.repeat_x = texture.repeat_y = True
            self.textures[sampler], held = texture, ()
        for layer, name in enumerate(names):
            if held[layer : layer + 1] != (name,):
                sky = np.pad(level.skies[name], ((0, 0), (0, 0), (0, 1))).tobytes()
                texture.write(sky, (0, 0, layer, *texture.size[:2], 1))
                self.sent[sampler] += len(sky)
        self.seen[sampler] = names + held[len(names) :]
        return self.textures[sampler]

    def walkable(self, level: Level):
        """Up to which sea the player can go, R32F, one texel a sample; after a stroke only round what it changed."""
        key = level.layers["height"], level.settings.walk
        known, revision = self.seen.get("walkable", (None, 0))
        fresh = self._refit("u_walkable", level.grid.shape, "f4") or known != key
        for rect in [level.grid.rect] if fresh else level.changed_since("height", revision):
            rect = level.grid.clip(rect.pad(1))  # slope looks at the neighbours
            self._send("u_walkable", highest_sea_m(level, rect), rect, "f4")
        self.seen["walkable"] = key, level.revision
        return self.textures["u_walkable"]

    def patch_kinds(self, level: Level):
        """Kinds of sea by hectare (H27), R8, and the column and row of the first."""
        key = level.revision, level.settings
        if self.seen.get("patch_kinds", (None,))[0] != key:
            made = patch_kinds(level)
            self._whole("u_patch_kinds", made.kinds, "f1")
            self.seen["patch_kinds"] = key, (made.col0, made.row0)
        return self.textures["u_patch_kinds"], self.seen["patch_kinds"][1]

    def beach_mesh(self, level: Level):
        """The beach mesh on samples (H03), RGBA16F with a linear filter, and metres a sample."""
        key = level.revision, level.settings
        if self.seen.get("beach_mesh", (None,))[0] != key:
            values, cell_m = beach_raster(level)
            self._whole("u_beach_mesh", values, "f2")
            self.textures["u_beach_mesh"].filter = self.ctx.LINEAR, self.ctx.LINEAR
            self.seen["beach_mesh"] = key, cell_m
        return self.textures["u_beach_mesh"], self.seen["beach_mesh"][1]

    def shore_field(self, level: Level):
        """Distance, direction, beach (H10, H11), RGBA8 with a linear filter; only what changed is sent."""
        field = shore_field(level)
        known, revision = self.seen.get("shore_field", (None, 0))
        fresh = known is not field
        for rect in field.changed_since(-1 if fresh else revision):
            self._part("u_shore_field", field.packed, rect, "f1")
        texture = self.textures["u_shore_field"]
        texture.filter = self.ctx.LINEAR, self.ctx.LINEAR
        self.seen["shore_field"] = field, field.revision
        return texture

    def current(self, level: Level, more: float = 0.0):
        """The current, the quiet area and the way to the shore (flow.py), RGBA16F with a linear filter.

        `more`: how much stronger flow points are than the level's own, while weather changes (D36).
        """
        made = current(level)
        more = more if made.to_points is not None else 0.0
        if self.seen.get("current") is not made or self.seen.get("current_more") != more:
            self._whole("u_current", made.with_points(more), "f2")
            self.seen["current_more"] = more
            self.textures["u_current"].filter = self.ctx.LINEAR, self.ctx.LINEAR
            self.seen["current"] = made
        return self.textures["u_current"]

    def flow_bytes(self, level: Level):
        """The current in the exporters' own bytes (T02), RGB8 with a linear filter, row 0 south."""
        made = flow_bytes(level)
        if self.seen.get("flow_bytes") is not made:
            self._whole("u_flow_bytes", made.bytes, "f1")
            self.textures["u_flow_bytes"].filter = self.ctx.LINEAR, self.ctx.LINEAR
            self.seen["flow_bytes"] = made
        return self.textures["u_flow_bytes"]

    def tables(self, level: Level) -> None:
        """Bring water table and lattice up to date."""
        key = table_in_use(level), level.settings.level.seed
        if self.seen.get("tables") != key:
            self._whole("u_tables", tables(level), "f4")
            self.textures["u_tables"].filter = self.ctx.LINEAR, self.ctx.LINEAR
            self.seen["tables"] = key

    def force(self, packed: np.ndarray | None):
        """The force field, or (None) a texel that nothing reads."""
        if "u_force" not in self.textures or self.seen.get("force") is not packed:
            self._whole("u_force", np.zeros((1, 1, 4), np.float32) if packed is None else packed, "f4")
            self.seen["force"] = packed
        return self.textures["u_force"]

    def _whole(self, name: str, values: np.ndarray, dtype: str) -> None:
        self._part(name, values, Rect(0, 0, *values.shape[:2]), dtype)

    def _part(self, name: str, values: np.ndarray, rect: Rect, dtype: str) -> None:
        """Send `rect` of `values` `(rows, cols[, channels])`; a texture of another shape is sent whole."""
        if self._refit(name, values.shape, dtype):
            rect = Rect(0, 0, *values.shape[:2])
        self._send(name, values[rect.slices], rect, dtype)

    def _refit(self, name: str, shape: tuple[int, ...], dtype: str) -> bool:
        """Make a texture fit `(rows, cols[, channels])`; True when it had to be made anew."""
        size, components = (shape[1], shape[0]), shape[2] if len(shape) == 3 else 1
        texture = self.textures.get(name)
        if texture is not None and texture.size == size and texture.components == components:
            return False
        if texture is not None:
            texture.release()
        texture = self.ctx.texture(size, components, dtype=dtype, alignment=1)
        texture.filter = self.ctx.NEAREST, self.ctx.NEAREST
        texture.repeat_x = texture.repeat_y = False
        self.textures[name] = texture
        return True

    def _send(self, name: str, values: np.ndarray, rect: Rect, dtype: str) -> None:
        """Send the samples of `rect` to a texture that fits."""
        if rect.empty:
            return
        data = np.ascontiguousarray(values, {"f4": np.float32, "f2": np.float16, "f1": np.uint8}[dtype])
        size = rect.col1 - rect.col0, rect.row1 - rect.row0
        self.textures[name].write(data, viewport=(rect.col0, rect.row0, *size), alignment=1)
        self.sent[name] += data.nbytes

    def release(self) -> None:
        for texture in self.textures.values():
            texture.release()
        self.textures.clear()
        self.seen.clear()


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
