"""Weather maps from and to files, as edits (Z04, T04; part of the session)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..level import Clock
from ..level.sky_maps import laid_over
from ..level.weather import paint_place
from . import words
from .hand import Hand


class WeatherMaps(Hand):
    """Taking in and giving out the painted sky."""

    clock: Clock

    def weather_import(self, path: Path | str, **options) -> list[str]:
        """Lay a weather map over the painted sky, as one step; returns what is worth telling.

        `options` are those of the script's word: layout, swizzle, weights, opacity, wrap_blend_m, feather_m, extent_m
        and `at`, the world metres of its middle at the clock's time; without it a map lies about the middle of the sky.
        """
        from ..io.weather_maps import read_weather_map

        word = words.checked(words.WeatherImport, path=str(path), **options)
        about = (0.0, 0.0) if word.at is None else self._on_paint(word.at)
        sky, notes = read_weather_map(
            path, layout=word.layout, swizzle=word.swizzle, weights=word.weights, wrap_blend_m=word.wrap_blend_m,
            feather_m=word.feather_m, extent_m=word.extent_m, about_m=about,
        )  # fmt: skip
        self._end_stroke()
        with self._edit(word), self.journal.step(f"Weather map {Path(path).name}") as step:
            self._lay(step, sky, word.opacity)
        settings = self.level.settings
        off = [
            name for name, on in (("clouds.on", settings.clouds.on), ("weather.painted", settings.weather.painted))
            if not on
        ]  # fmt: skip
        if off:
            notes.append(f"{' and '.join(off)} {'is' if len(off) == 1 else 'are'} off, so the map is not seen yet")
        self.notes += notes
        return notes

    def _on_paint(self, at: tuple[float, float]) -> tuple[float, float]:
        east, north = paint_place(self.level, self.clock.time_s, *at)
        return float(east), float(north)

    def _lay(self, step, sky: np.ndarray, opacity: float) -> None:
        data = self.level.layers["weather"]
        for tile in data.grid.tiles(data.grid.rect):
            rect = data.grid.tile_rect(tile)
            before = data.read(rect)
            after = laid_over(before, sky[rect.slices], opacity)
            if not np.array_equal(before, after):
                step.save(data, rect)
                data.array[rect.slices] = after
                self.level.mark("weather", rect)

    def weather_export(
        self, path: Path | str, *, layout: str = "ours", bits: int = 8, side: int = 512,
        time_s: float | None = None, stage: str = "",
    ) -> list[str]:  # fmt: skip
        """Write the sky as an image: a layout and stage of `io.weather_maps`, at the clock's time unless another."""
        from ..io.weather_maps import layout_values, write_weather_map

        sky, notes = layout_values(self.level, layout, stage, self.clock.time_s if time_s is None else time_s)
        write_weather_map(path, sky, bits=bits, side=side)
        return notes
