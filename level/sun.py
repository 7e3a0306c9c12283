"""Where the sun stands, by date and place or by two angles (L02).

The formulas are those of NOAA's solar calculator (after Meeus, Astronomical Algorithms, 1991): within 0.02° of exact
ones from 1950 to 2050. Refraction by the air is left out, as it is for the two angles.
"""

from __future__ import annotations

import datetime
import math
from functools import lru_cache

from .params import replace
from .settings import Light, Settings

YEAR = 2025  # dates carry no year: from one to the next the sun moves by less than half its width
CYCLE_H = 1461 * 24.0  # four years, after which the sun stands where it stood
DAY_STEP_H = 1 / 1500  # the sun moves by 0.01°, a fiftieth of its width
MOON_BELOW_DEG = -2.0  # of the sun: its disc has set, and the moon still counts for nothing against the dusk
DAYS = (31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)


def _julian_day(year: int, month: int, day: int, hours: float) -> float:
    """Julian day of a Gregorian date, `hours` after midnight UTC."""
    if month <= 2:
        year, month = year - 1, month + 12
    century = year // 100
    whole = math.floor(365.25 * (year + 4716)) + math.floor(30.6001 * (month + 1))
    return whole + day + 2 - century + century // 4 - 1524.5 + hours / 24


def sun_angles(
    month: int, day: int, hour: float, utc_offset_h: float, latitude_deg: float, longitude_deg: float, year: int = YEAR
) -> tuple[float, float]:
    """Azimuth (clockwise from north) and elevation of the sun's middle, degrees, without refraction.

    `hour` is the clock's, `utc_offset_h` ahead of UTC; a day past the month's last one is taken for that one.
    """
    day = min(day, DAYS[month - 1])
    hours = hour - utc_offset_h
    t = (_julian_day(year, month, day, hours) - 2451545.0) / 36525.0
    mean_long = math.radians((280.46646 + t * (36000.76983 + 0.0003032 * t)) % 360)
    anomaly = math.radians(357.52911 + t * (35999.05029 - 0.0001537 * t))
    orbit = 0.016708634 - t * (0.000042037 + 0.0000001267 * t)
    centre = math.sin(anomaly) * (1.914602 - t * (0.004817 + 0.000014 * t))
    centre += math.sin(2 * anomaly) * (0.019993 - 0.000101 * t) + math.sin(3 * anomaly) * 0.000289
    node = math.radians(125.04 - 1934.136 * t)
    ecliptic = math.radians(math.degrees(mean_long) + centre - 0.00569 - 0.00478 * math.sin(node))
    tilt = 23.0 + (26.0 + (21.448 - t * (46.815 + t * (0.00059 - 0.001813 * t))) / 60) / 60
    tilt = math.radians(tilt + 0.00256 * math.cos(node))
    declination = math.asin(math.sin(tilt) * math.sin(ecliptic))
    y = math.tan(tilt / 2) ** 2
    equation = y * math.sin(2 * mean_long) - 2 * orbit * math.sin(anomaly)
    equation += 4 * orbit * y * math.sin(anomaly) * math.cos(2 * mean_long)
    equation -= 0.5 * y * y * math.sin(4 * mean_long) + 1.25 * orbit * orbit * math.sin(2 * anomaly)
    solar_minutes = hours * 60 + 4 * math.degrees(equation) + 4 * longitude_deg
    return _horizontal(math.radians(solar_minutes / 4 - 180), declination, math.radians(latitude_deg))


def _horizontal(hour_angle: float, declination: float, latitude: float) -> tuple[float, float]:
    """Azimuth and elevation, degrees, from hour angle, declination and latitude, radians."""
    east = -math.cos(declination) * math.sin(hour_angle)
    north = math.sin(declination) * math.cos(latitude)
    north -= math.cos(declination) * math.cos(hour_angle) * math.sin(latitude)
    up = math.sin(declination) * math.sin(latitude)
    up += math.cos(declination) * math.cos(hour_angle) * math.cos(latitude)
    return math.degrees(math.atan2(east, north)) % 360, math.degrees(math.asin(max(min(up, 1.0), -1.0)))


def stand_at(settings: Settings, georeference: dict) -> Settings:
    """Settings whose place is that of a georeference, its clock that of the nearest hour's meridian."""
    latitude, longitude = georeference.get("latitude"), georeference.get("longitude")
    if not all(isinstance(v, int | float) and math.isfinite(v) for v in (latitude, longitude)) or abs(latitude) > 90:
        return settings
    longitude = (longitude + 180) % 360 - 180
    place = {"latitude_deg": latitude, "longitude_deg": longitude, "utc_offset_h": round(longitude / 15)}
    for name, value in place.items():
        settings = replace(settings, f"light.{name}", float(value))
    return settings


def day_runs(light: Light) -> bool:
    """Whether the sun's place turns with the clock (Z25)."""
    return light.sun_from == "date" and light.day_rate > 0


def day_hours(light: Light, time_s: float) -> float:
    """Hours since midnight of the level's date at a time, past 24 on the days after; 0 … 35 064.

    While the day runs they go on in steps of DAY_STEP_H, so that a slow day's shadows are not remade for nothing.
    """
    if not day_runs(light):
        return light.hour
    hours = light.hour + time_s * light.day_rate / 3600 * (24 / light.day_h)
    return round(hours / DAY_STEP_H) * DAY_STEP_H % CYCLE_H


def day_moment(light: Light, time_s: float) -> datetime.datetime:
    """Date and time on the place's clock; the year means nothing."""
    first = datetime.datetime(YEAR, light.month, 1)
    return first + datetime.timedelta(
        days=min(light.day, DAYS[light.month - 1]) - 1, hours=day_hours(light, time_s)
    )  # fmt: skip


def sun_place(light: Light, time_s: float = 0.0) -> tuple[float, float]:
    """Azimuth and elevation, degrees, of a level's sun, by whichever way its settings choose."""
    if light.sun_from == "angles":
        return light.sun_azimuth_deg, light.sun_elevation_deg
    return sun_angles(
        light.month, light.day, day_hours(light, time_s), light.utc_offset_h, light.latitude_deg, light.longitude_deg
    )  # fmt: skip


def highest_deg(light: Light) -> float:
    """The sun's highest elevation on a level's date, degrees."""
    return _highest_deg(light.month, light.day, light.utc_offset_h, light.latitude_deg, light.longitude_deg)


@lru_cache(maxsize=8)
def _highest_deg(month: int, day: int, utc_offset_h: float, latitude_deg: float, longitude_deg: float) -> float:
    place = utc_offset_h, latitude_deg, longitude_deg
    return max(sun_angles(month, day, n / 10, *place)[1] for n in range(240))


def moon_shines(light: Light, sun_elevation_deg: float) -> bool:
    """Whether the moon has taken over from the sun, opposite to it, as a full moon nearly is."""
    return day_runs(light) and light.moonlit and light.body == "sun" and sun_elevation_deg < MOON_BELOW_DEG


def light_angles(light: Light, time_s: float = 0.0) -> tuple[float, float]:
    """Azimuth and elevation, degrees, of what shines in a level at a time: the sun, or at night the moon."""
    azimuth, elevation = sun_place(light, time_s)
    if moon_shines(light, elevation):
        return (azimuth + 180.0) % 360.0, -elevation
    return azimuth, elevation
