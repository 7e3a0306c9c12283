"""Paths: pointer samples become dabs, so that a stroke doesn't depend on how often the pointer was asked.

A dab reaches from the dab before it to its own place: dabs overlap without scallops whatever the spacing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple


class Sample(NamedTuple):
    """A pointer sample: world metres, pressure 0 to 1."""

    x: float
    y: float
    pressure: float = 1.0


class Dab(NamedTuple):
    """A piece of a stroke, in world metres; a lone dab starts where it ends."""

    start: Sample
    end: Sample


class Bounds(NamedTuple):
    """Where the pieces between dabs can have an effect, in world metres."""

    west: float
    south: float
    east: float
    north: float


class AlongPath:
    """A dab at the press and then one every `spacing_m` of way; pressure is interpolated, the rest comes at release."""

    replaces = False  # dabs add to each other

    def __init__(self, spacing_m: float, cell_m: float, bounds: Bounds) -> None:
        self.spacing_m = max(spacing_m, cell_m / 2)  # what lies closer cannot differ
        self.bounds = bounds

    def begin(self, sample: Sample) -> Iterator[Dab]:
        self.last = self.dabbed = sample
        self.since_m = 0.0
        yield Dab(sample, sample)

    def move(self, sample: Sample) -> Iterator[Dab]:
        last, self.last = self.last, sample
        way_m = math.hypot(sample.x - last.x, sample.y - last.y)
        first_m, self.since_m = self.spacing_m - self.since_m, self.since_m + way_m
        count = math.floor(self.since_m / self.spacing_m)
        if count <= 0:
            return
        start, stop = self._within(last, sample, way_m, first_m, count)
        if start > 0:
            self.dabbed = self._at(last, sample, (first_m + (start - 1) * self.spacing_m) / way_m)
        for number in range(start, stop):
            here = self._at(last, sample, (first_m + number * self.spacing_m) / way_m)
            yield Dab(self.dabbed, here)
            self.dabbed = here
        self.dabbed = self._at(last, sample, (first_m + (count - 1) * self.spacing_m) / way_m)
        self.since_m -= count * self.spacing_m

    def end(self) -> Iterator[Dab]:
        """The rest of the way, shorter than a spacing."""
        if (self.last.x, self.last.y) != (self.dabbed.x, self.dabbed.y):
            yield Dab(self.dabbed, self.last)

    @staticmethod
    def _at(a: Sample, b: Sample, share: float) -> Sample:
        share = min(max(share, 0.0), 1.0)
        return Sample(*(p + (q - p) * share for p, q in zip(a, b, strict=True)))

    def _within(self, a: Sample, b: Sample, way_m: float, first_m: float, count: int) -> tuple[int, int]:
        """Which of the dabs of a straight piece can touch the level: a pointer far outside costs nothing."""
        enter, leave = 0.0, 1.0
        for p, q, low, high in (
            (a.x, b.x, self.bounds.west, self.bounds.east),
            (a.y, b.y, self.bounds.south, self.bounds.north),
        ):
            if p == q:
                if not low <= p <= high:
                    return count, count
                continue
            one, other = sorted(((low - p) / (q - p), (high - p) / (q - p)))
            enter, leave = max(enter, one), min(leave, other)
        if enter > leave:
            return count, count
        start = math.floor((enter * way_m - first_m) / self.spacing_m)
        stop = math.ceil((leave * way_m - first_m) / self.spacing_m) + 2
        return min(max(start, 0), count), min(max(stop, 0), count)


class LinePath:
    """One dab from the press to where the pointer is now; each move replaces it. Pressure doesn't count."""

    replaces = True

    def __init__(self, spacing_m: float, cell_m: float, bounds: Bounds) -> None:
        self.least_m = min(max(spacing_m, cell_m / 2), 2 * cell_m)  # less is a hand that shook on a click

    def begin(self, sample: Sample) -> Iterator[Dab]:
        self.first = sample._replace(pressure=1.0)
        yield from ()

    def move(self, sample: Sample) -> Iterator[Dab]:
        if math.hypot(sample.x - self.first.x, sample.y - self.first.y) >= self.least_m:
            yield Dab(self.first, sample._replace(pressure=1.0))
