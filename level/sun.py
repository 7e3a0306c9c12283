"""Where the sun stands, by date and place or by two angles (L02).

The formulas are those of NOAA's solar calculator (after Meeus, Astronomical Algorithms, 1991): within 0.02° of exact
ones from 1950 to 2050. Refraction by the air is left out, as it is for the two angles.
"""

from __future__ import annotations

import math

from .settings import Light

YEAR = 2025  # dates carry no year: from one to the next the sun moves by less than half its width
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


def light_angles(light: Light) -> tuple[float, float]:
    """Azimuth and elevation, degrees, of what shines in a level, by whichever way its settings choose."""
    if light.sun_from == "angles":
        return light.sun_azimuth_deg, light.sun_elevation_deg
    return sun_angles(
        light.month, light.day, light.hour, light.utc_offset_h, light.latitude_deg, light.longitude_deg
    )  # fmt: skip
