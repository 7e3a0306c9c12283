"""Unit and one sentence of each uniform and map of the kit: the setting's own where it is one, else a row here."""

from __future__ import annotations

import functools

from ....level.params import describe
from ....level.settings import Settings

MEANINGS = {
    # maps of the sea
    "u_tables": ("", "Two rows of the water table, then four of random numbers in channel 0."),
    "u_bed": (
        "m",
        "Depth of the shore clock, of the bed, share of sea, clock's depth without rocks; rivers above.",
    ),
    "u_beach": ("m", "Sand over the still sea, and how fronts sway along the shore, -1 to 1."),
    "u_arrival": ("s", "Times of arrival of three swells, their heights, and how they break, in blocks of rows."),
    "u_current": ("m/s", "Current to east and north, calm of play areas 0 to 1, metres to the shoreline."),
    "u_noise": ("", "Tiling noise: broad, middle, fine, ridges, each spread evenly over 0 to 1."),
    "u_foam": ("", "Tiling foam: lace, middle, dense, each spread evenly over 0 to 1; bubbles."),
    "u_layer_foam": ("", "Painted foam: what comes with the waves, what is always there."),
    # sea and tide
    "u_sea_level_m": ("m", "Height of the still sea with the tide."),
    "u_tide_m": ("m", "How far the tide stands over the mean sea."),
    "u_deep_full_m": ("m", "Depth from which on offshore waves stand whole."),
    "u_wave_height_m": ("m", "Largest height that offshore waves can sum up to."),
    "u_bed_cell_m": ("m", "Distance between two samples of u_bed."),
    "u_bed_rows": ("", "Rows of u_bed before those of rivers."),
    "u_beach_cell_m": ("m", "Distance between two samples of u_beach."),
    "u_cell_m": ("m", "Distance between two samples of the level's ground and of painted layers."),
    # offshore waves
    "u_front_way": ("1/m, cycles, rad/m", "Of each front: direction over wavelength, phase, wave number."),
    "u_front_size": ("m", "Of each front: amplitude, amplitude to the side, unit direction."),
    "u_front_turn": ("", "Of each front: how far noise bends its crests, in wavelengths, and where that begins."),
    "u_region_count": ("", "Number of regions with waves of their own."),
    "u_region_place": ("m", "Of each region: x, y, radius of its full weight, how far it reaches."),
    "u_region_band": (
        "m",
        "Of each region: edges of its outline, reach out and in, whether swells keep their time.",
    ),
    "u_region_edge": ("m", "Edges of outlines: from and to, from their region's place."),
    "u_region_way": ("1/m, cycles, rad/m", "As u_front_way, a set for each region."),
    "u_region_size": ("m", "As u_front_size, a set for each region."),
    "u_wave_ends": ("", "How many wave objects belong to short waves, and how many there are."),
    "u_wave_place": ("m", "Of each wave object: x, y, radius of its full weight, radius."),
    "u_wave_bend": ("1/m, m", "Of each wave object: curvature, distance of its centre, depth for its full weight."),
    "u_wave_way": ("1/m, cycles", "Of each of an object's fronts: unit direction, cycles a metre, phase."),
    "u_wave_size": ("m", "Of each of an object's fronts: amplitude, amplitude to the side."),
    "u_patch_rects": ("m", "Rectangles that the artist marked: west, south, east, north."),
    "u_patch_ends": ("", "Where open, coastal and removed rectangles end in that list."),
    # times of arrival
    "u_arrival_cell_m": ("m", "Distance between two samples of u_arrival."),
    "u_arrival_rate": ("1/s", "One over the periods of the three swells."),
    "u_arrival_plane": ("s/m", "Slowness of the plane waves that come in."),
    "u_arrival_share": ("", "Share of travel time in the moment of arrival; the rest is the depth's."),
    "u_arrival_levels": ("", "Sea levels that u_arrival holds, one above the other."),
    "u_arrival_rise": ("", "Part of the way from the lower of them to the higher."),
    "u_pins": ("m", "Pins of the timing: x, y, weight."),
    "u_pin_shift": ("cycles", "How much later waves come at all pins' mean."),
    "u_pin_reach_m": ("m", "How far a pin reaches."),
    # shore waves
    "u_shore_clock": ("cycles", "Part of the shore's cycle that has gone by."),
    "u_shore_cycle": ("", "Number of the cycle, modulo 4096."),
    "u_shore_turns": ("", "Waves after which the same ones come again, 0: never."),
    "u_shore_uprush": ("", "Part of a wave's interval in which its sheet runs up."),
    "u_shore_break_rate": ("", "Progress in breaking that a front makes in one shore range."),
    "u_shore_iribarren": ("", "Surf similarity on a bed of slope 1."),
    "u_shore_feels_from": ("", "Progress of a passing crest from which something shows of breaking."),
    "u_river_wave_cycles": ("1/m", "Cycles a metre of a river's small waves."),
    "u_river_wave_time": ("cycles", "Phases of their two trains."),
    # foam
    "u_foam_cycle": (
        "cycles, s",
        "Of foam that currents carry: part of a cycle, number of whole ones, seconds of one.",
    ),
    "u_foam_turns": ("", "Cycles after which the same ones come again, 0: never."),
    "u_foam_tile_m": ("m", "Side of a tile of the foam's texture."),
    "u_foam_amount": ("", "How much foam waves make."),
    "u_current_cell_m": ("m", "Distance between two samples of u_current."),
    "u_wind_way": ("", "Unit vector to where the wind over the water blows."),
    "u_whitecaps": ("", "Share of the open sea that is white in this wind."),
    "u_cap_place": ("tiles", "Of two generations of whitecaps: where each is read in the noise."),
    "u_cap_age": ("", "Of two generations of whitecaps: age -0.5 to 0.5 of each, share of each."),
    # the sky
    "u_cloud_camera": ("m", "East and north of the camera: the horizon's sky begins round it. Yours to set."),
    "u_cloud_shape": ("", "Noise that shapes clouds, 128 cubed: 16 of its layers beside each other, 8 rows of them."),
    "u_cloud_detail": (
        "",
        "Noise that erodes their edges, 32 cubed: 8 layers beside each other, 4 rows.",
    ),
    "u_cloud_detail_half": ("", "The same at half the side, 8 beside each other, 2 rows of them."),
    "u_cloud_curl": ("", "Turbulence that bends that noise, 0.5 is none."),
    "u_cloud_profile": ("", "Density by height: rows stratus, cumulus, cumulonimbus."),
    "u_weather_noise": ("", "A broad pattern and its quarter turn, a fine one and its own; deviation 1, mean 0."),
    "u_layer_weather": ("", "Painted coverage, precipitation, type; weight of the coverage."),
    "u_layer_weather_more": ("", "Weights of the painted precipitation and type."),
    "u_weather_turn": ("", "Cosine and sine of the state of the broad and of the fine pattern."),
    "u_weather_moved": ("m", "How far the air has moved, and the map's middle."),
    "u_weather_paint_moved": ("m", "The same of the paint."),
    "u_weather_bias": ("", "Coverage, type, precipitation that the sky tends to; how different places are."),
    "u_weather_horizon": ("m", "Where the horizon's own sky begins and ends; its coverage and type."),
    "u_storm": ("m", "Unit vector of a storm's way, how far its front is along that; how much of it there is."),
    "u_storm_size": ("m", "Its depth along the wind, how ragged its front is."),
    "u_weather_areas": ("", "Number of skies over areas."),
    "u_weather_area": ("m", "Of each: x, y, radius (0: everywhere), share."),
    "u_weather_area_sky": ("", "Of each: coverage, type, precipitation."),
    "u_cloud_drift": ("m", "How far the air has moved, within a tile of the shape's noise and of the detail's."),
    "u_cloud_way": ("", "Unit vectors to where the wind blows at the clouds' base and top."),
    "u_cloud_rise": ("tiles", "How far the detail has risen, turbulence has wandered, the shape has turned."),
}


def meaning(name: str) -> tuple[str, str]:
    """Unit and sentence of a uniform or map."""
    if name in MEANINGS:
        return MEANINGS[name]
    row = _settings().get(name) or _settings()[name.replace("u_", "u_sea_", 1)]  # the sea's have their bare names
    return row.unit, row.doc


@functools.cache
def _settings() -> dict:
    return {f"u_{row.name.replace('.', '_')}": row for row in describe(Settings)}
