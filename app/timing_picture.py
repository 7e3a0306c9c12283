"""The timing of a level as one picture to look at (T06): a map with its lines, and beside it what they mean."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from ..io.labels import text_mask
from ..level import Level
from ..level.crests import isochrones
from ..level.hot_spots import KINDS, HotSpot
from ..level.speed_ramp import BREAKERS, ISOCHRONE, moment_alpha, moment_colour
from ..level.surf import TYPES, breaker_type
from ..level.timing import TimingMap, timing_map

SIDE_PX = 1200  # of the map's longer side
KEY_PX = 400
MARGIN_PX = 18
PAPER, INK, FAINT, WARM = (24, 26, 29), (228, 228, 222), (150, 154, 158), (255, 196, 84)
SHALLOW, DEEP, SAND, HIGH = (126, 176, 190), (28, 62, 96), (206, 188, 148), (118, 120, 88)
GHOSTS = (-2, -1, 1, 2)


@dataclass(frozen=True)
class Sheet:
    """What is drawn: `step_s` between ghosts, `every_s` between isochrones."""

    level: Level
    time_s: float
    title: str
    spots: list[HotSpot]
    step_s: float
    every_s: float


def timing_picture(sheet: Sheet) -> np.ndarray:
    """uint8 `(height, width, 3)`, row 0 on top, north up."""
    found = timing_map(sheet.level, sheet.time_s, 1025)
    east, north = (side - 1 for side in found.shape[::-1])
    scale = SIDE_PX / max(east, north)
    width, height = round(east * scale) + 1, round(north * scale) + 1
    col, row = np.meshgrid(np.arange(width) / scale, np.arange(height)[::-1] / scale)
    chart = Chart(sheet, found, scale, np.stack([row, col]))
    chart.ground()
    chart.breakers()
    chart.lines()
    chart.labels()
    picture = np.empty((max(height, 560) + 2 * MARGIN_PX, width + KEY_PX + 3 * MARGIN_PX, 3), np.float32)
    picture[:] = PAPER
    picture[MARGIN_PX : MARGIN_PX + height, MARGIN_PX : MARGIN_PX + width] = chart.pixels
    _key(picture[MARGIN_PX:-MARGIN_PX, width + 2 * MARGIN_PX : -MARGIN_PX], sheet)
    return np.rint(np.clip(picture, 0, 255)).astype(np.uint8)


class Chart:
    """The map in the making: `pixels` float32 0 … 255, north on top."""

    def __init__(self, sheet: Sheet, found: TimingMap, scale: float, place: np.ndarray) -> None:
        self.sheet, self.found, self.scale, self.place = sheet, found, scale, place
        self.pixels = np.zeros((*place.shape[1:], 3), np.float32)
        self.taken: list[tuple[float, float, float, float]] = []  # by labels: x, y, half width, half height
        passage = found.passage
        self.seen = self.sample(passage.stands.astype(np.float32)) > 0.5
        self.cycles = self.sample(passage.cycles.v)
        change = np.hypot(passage.cycles.dx, passage.cycles.dy) * found.cell_m / scale
        self.change = np.maximum(self.sample(change), 1e-6)

    def sample(self, values: np.ndarray) -> np.ndarray:
        return ndimage.map_coordinates(np.asarray(values, np.float32), self.place, order=1, mode="nearest")

    def lay(self, colour, cover: np.ndarray) -> None:
        """Colour 0 … 255 over part of each pixel."""
        self.pixels += (np.array(colour, np.float32) - self.pixels) * cover[..., None]

    def ground(self) -> None:
        level, cell_m = self.sheet.level, self.found.cell_m
        stride = round(cell_m / level.grid.cell_m)
        over_m = level.height[::stride, ::stride].astype(np.float32) - level.sea_level_m
        relief = ndimage.gaussian_filter(over_m, 1.0)
        north, east = np.gradient(relief, cell_m)
        light = self.sample(np.clip(0.82 + 0.5 * (east - north) / np.sqrt(1 + east**2 + north**2), 0.45, 1.15))
        over_m = self.sample(over_m)
        deep = np.clip(-over_m / 12, 0, 1)[..., None] ** 0.6
        high = np.clip(over_m / 20, 0, 1)[..., None] ** 0.7
        sea = np.array(SHALLOW) + (np.array(DEEP) - np.array(SHALLOW)) * deep
        land = (np.array(SAND) + (np.array(HIGH) - np.array(SAND)) * high) * light[..., None]
        wet = np.clip(0.5 - over_m / np.maximum(_change(over_m), 1e-4), 0, 1)[..., None]
        self.pixels[:] = land + (sea - land) * wet
        self.lay((52, 44, 34), 0.85 * _stroke(over_m / np.maximum(_change(over_m), 1e-4), 1.4))

    def breakers(self) -> None:
        """The surf zone in the colours of its types, strongest at its seaward edge."""
        passage = self.found.passage
        broken = self.sample(passage.broken)
        kind = breaker_type(passage.slope, passage.height_m, passage.period_s)
        fade = self.seen * (broken >= 0) * np.clip(1 - broken / 0.35, 0, 1)
        for number, name in enumerate(TYPES):
            share = self.sample((kind == number).astype(np.float32))
            self.lay(255 * np.array(BREAKERS[name]), 0.75 * fade * share)

    def lines(self) -> None:
        sheet, period_s = self.sheet, self.found.passage.period_s
        seconds = self.cycles * period_s / sheet.every_s
        self.lay(255 * np.array(ISOCHRONE), 0.55 * self._whole(seconds, period_s / sheet.every_s, 1.1))
        since = sheet.time_s / period_s - self.cycles
        for k in (*GHOSTS, 0):
            part, cover = k / max(GHOSTS), self._whole(since + k * sheet.step_s / period_s, 1.0, 2.6 if k == 0 else 1.6)
            self.lay((8, 12, 18), 0.4 * moment_alpha(part) * ndimage.maximum_filter(cover, 3))
            self.lay(255 * np.array(moment_colour(part)), moment_alpha(part) * cover)

    def _whole(self, phase: np.ndarray, steeper: float, width_px: float) -> np.ndarray:
        """Cover of lines where a phase is whole; `steeper`: its change against that of the cycles."""
        change = self.change * steeper
        away = np.abs(phase - np.floor(phase + 0.5)) / change
        return self.seen * _stroke(away, width_px) * np.clip((0.25 - change) / 0.17, 0, 1)

    def labels(self) -> None:
        """Seconds on isochrones, numbers on hot spots."""
        for number, spot in enumerate(self.sheet.spots, 1):
            self._spot(number, spot)
        lines = isochrones(self.sheet.level, self.sheet.time_s, self.sheet.every_s, 1025)
        for line in sorted(lines, key=lambda line: (-line.length_m, line.value)):
            if line.length_m * self.scale / self.found.cell_m < 60:
                break
            middle = line.points[len(line.points) // 2]
            self._text(f"{line.value:g} s", *middle, 13, ISOCHRONE, plate=0.55)

    def _pixel(self, x: float, y: float) -> tuple[float, float]:
        """Column and row of a world point."""
        scale = self.scale / self.found.cell_m
        return x * scale, self.pixels.shape[0] - 1 - y * scale

    def _spot(self, number: int, spot: HotSpot) -> None:
        col, row = self._pixel(spot.x, spot.y)
        rows, cols = np.ogrid[: self.pixels.shape[0], : self.pixels.shape[1]]
        away = np.hypot(rows - row, cols - col)
        radius = max(0.5 * spot.size_m * self.scale / self.found.cell_m, 9.0)
        self.lay((10, 12, 14), 0.6 * _stroke(away - radius, 4.5))
        self.lay(WARM, _stroke(away - radius, 2.0))
        self._text(str(number), spot.x, spot.y, 15, tuple(part / 255 for part in WARM), plate=0.7)

    def _text(self, text: str, x: float, y: float, size_px: int, colour, plate: float) -> None:
        """A word with a dark plate round a world point, unless it would lie on another."""
        mask, (col, row) = text_mask(text, size_px), self._pixel(x, y)
        half = mask.shape[1] / 2 + 4, mask.shape[0] / 2 + 1
        if any(abs(col - c) < w + half[0] and abs(row - r) < h + half[1] for c, r, w, h in self.taken):
            return
        left, top = round(col - mask.shape[1] / 2), round(row - mask.shape[0] / 2)
        height, width = self.pixels.shape[:2]
        if left < 4 or top < 2 or left + mask.shape[1] + 4 > width or top + mask.shape[0] + 2 > height:
            return
        self.taken.append((col, row, *half))
        under = self.pixels[top - 1 : top + mask.shape[0] + 1, left - 4 : left + mask.shape[1] + 4]
        under *= 1 - plate
        _write(self.pixels[top : top + mask.shape[0], left : left + mask.shape[1]], text, size_px,
               tuple(255 * part for part in colour))  # fmt: skip


def _change(values: np.ndarray) -> np.ndarray:
    """How much a field changes from pixel to pixel."""
    return np.hypot(*np.gradient(values))


def _stroke(away_px: np.ndarray, width_px: float) -> np.ndarray:
    """Cover of a line of that width at distances from it."""
    return np.clip(0.5 * width_px + 0.5 - np.abs(away_px), 0, 1)


def _write(place: np.ndarray, text: str, size_px: int, ink=INK) -> None:
    mask = text_mask(text, size_px)[: place.shape[0], : place.shape[1], None]
    part = place[: mask.shape[0], : mask.shape[1]]
    part += (np.array(ink, np.float32) - part) * mask


def _key(place: np.ndarray, sheet: Sheet) -> None:
    """Title, what lines and colours mean, hot spots with what to do."""
    y = 0

    def line(text: str, size_px: int = 15, ink=INK, left: int = 0) -> None:
        nonlocal y
        for part in _wrapped(text, size_px, place.shape[1] - left) if text else []:
            if y + 2 * size_px < place.shape[0]:
                _write(place[y:, left:], part, size_px, ink)
            y += round(1.45 * size_px)

    def sample(colour, width_px: int, text: str) -> None:
        if y + 22 < place.shape[0]:
            place[y + 9 - width_px // 2 : y + 9 - width_px // 2 + width_px, :34] = 255 * np.array(colour)
        line(text, left=46)

    line(sheet.title, 20)
    line(f"Crests at {sheet.time_s:g} s", ink=FAINT)
    y += 10
    sample(moment_colour(0), 3, "crest now")
    sample(moment_colour(-1), 2, f"{sheet.step_s:g} and {2 * sheet.step_s:g} s before")
    sample(moment_colour(1), 2, f"{sheet.step_s:g} and {2 * sheet.step_s:g} s later")
    sample(ISOCHRONE, 1, f"arrival, every {sheet.every_s:g} s")
    for name, colour in BREAKERS.items():
        sample(colour, 10, f"breaks, {name}")
    y += 10
    line("Hot spots" if sheet.spots else "No hot spots", 18)
    told: set[str] = set()
    for number, spot in enumerate(sheet.spots, 1):
        if y + 110 > place.shape[0]:
            line(f"and {len(sheet.spots) - number + 1} more in hot_spots.json", 13, FAINT)
            break
        line(f"{number}  {KINDS[spot.kind]}", ink=WARM)
        line(spot.sentence, 13, left=18)
        line("" if spot.advice in told else spot.advice, 13, FAINT, left=18)
        told.add(spot.advice)


def _wrapped(text: str, size_px: int, width_px: int) -> list[str]:
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and text_mask(longer, size_px).shape[1] > width_px:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines
