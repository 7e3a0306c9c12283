"""Everything about a level that is a number and not a map: one frozen pydantic model, sections of `param` rows."""

from __future__ import annotations

from typing import Literal

from .beach_settings import BeachMesh
from .land_settings import Ground, Scatter, Walk, Wet
from .mouth_settings import MouthLook
from .params import Section, param
from .river_settings import RiverLook
from .sea_settings import Caustics, Flow, Foam, Force, Glare, Quiet, Things
from .sky_settings import Clouds, CloudTerms, Rain, Storm, Weather
from .tide import Tide
from .timing_settings import Timing


class WaterLevel(Section):
    sea_level_m: float = param(0.0, -12_000, 12_000, "m", "Height of the still sea.", soft=(-5, 5))
    seed: int = param(7, 0, 2**31 - 1, "", "Seed of every generated noise and wave spread of this level.")


class Sea(Section):
    """Gerstner waves offshore, two frequency groups with one set of knobs each (Hitman talk, H05, H28; D11)."""

    on: bool = param(True, doc="Gerstner waves on the open sea.")
    swell_m: float = param(0.45, 0, 8, "m", "Amplitude of the low group, three fronts.", soft=(0, 2))
    swell_length_m: float = param(46.0, 4, 600, "m", "Wavelength of the low group.", soft=(15, 150))
    swell_speed: float = param(1.0, 0, 4, "×", "Speed of the low group against deep-water dispersion.", soft=(0.25, 2))
    swell_steepness: float = param(0.55, 0, 1, "", "How sharply the crests of the low group are drawn together.")
    swell_heading_deg: float = param(20.0, 0, 360, "°", "Where the first front of the low group goes to.")
    chop_m: float = param(0.09, 0, 2, "m", "Amplitude of the high group, five fronts.", soft=(0, 0.4))
    chop_length_m: float = param(7.5, 1, 80, "m", "Wavelength of the high group.", soft=(3, 25))
    chop_speed: float = param(1.0, 0, 4, "×", "Speed of the high group against deep-water dispersion.", soft=(0.25, 2))
    chop_steepness: float = param(0.7, 0, 1, "", "How sharply the crests of the high group are drawn together.")
    wind_mps: float = param(
        5.0,
        0,
        40,
        "m/s",
        "Wind over the open sea: the sun's glitter widens with it, and from 4 m/s whitecaps come up.",
        soft=(0, 20),
    )
    variance: float = param(0.35, 0, 1, "", "How far single fronts leave their group's amplitude, length and heading.")
    phase_noise: float = param(
        0.15, 0, 2, "", "How far noise bends the crests of single fronts, in wavelengths.", soft=(0, 1)
    )
    phase_noise_m: float = param(170.0, 10, 5000, "m", "Length of that noise along the crests.", soft=(50, 600))
    mesh: Literal["auto", "grid", "tessellated"] = param(
        "auto", doc="How the mesh gets fine: from grids, or tessellated; auto tessellates on graphics hardware."
    )
    near_m: float = param(
        120.0,
        20,
        2000,
        "m",
        "Up to here waves stand whole; the mesh's finest cells reach in proportion.",
        soft=(40, 400),
    )
    falloff: float = param(
        1.6, 1, 4, "", "How much faster than linear the mesh coarsens and waves lie down beyond.", soft=(1, 3)
    )
    coastal_m: float = param(
        60.0, 5, 140, "m", "Hectares that near the shore are coastal; counts up to shore.distance_range_m.",
        soft=(20, 120),
    )  # fmt: skip
    beach_m: float = param(18.0, 1, 100, "m", "Hectares that near the shore are beach.", soft=(5, 40))
    deep_start_m: float = param(0.5, 0, 100, "m", "Depth at which the offshore waves begin.", soft=(0, 10))
    deep_full_m: float = param(9.0, 0.1, 400, "m", "Depth at which the offshore waves have their full height.")


class Shore(Section):
    """The shore wave clock (Diablo IV talk, D03, D04, D10): fronts that stand on depth contours and run up the sand."""

    on: bool = param(True, doc="Shore waves.")
    vertex: bool = param(True, doc="Shore waves lift the surface and run up the beach; off, only masks travel.")
    range_m: float = param(5.0, 0.2, 200, "m", "Depth at the outer edge of the shore waves.", soft=(1, 20))
    interval_s: float = param(9.0, 0.5, 120, "s", "Time between two waves.", soft=(3, 20))
    count: int = param(3, 1, 8, "", "Waves on their way at once; one takes interval × count from edge to run-up limit.")
    width: float = param(0.04, 0.005, 1, "", "Width of a front's flank, in shore ranges.", soft=(0.02, 0.3))
    gap: float = param(0.06, 0.005, 1, "", "Width of the front line, in shore ranges.", soft=(0.02, 0.4))
    runup: float = param(0.13, 0, 0.6, "", "How far the water runs up the sand, in shore ranges.", soft=(0, 0.3))
    back: float = param(
        0.30, 0.01, 2, "", "Length of the wave's back behind the line, in shore ranges.", soft=(0.05, 0.8)
    )
    fall: float = param(0.045, 0.005, 1, "", "Length of the falling crest before the front.", soft=(0.01, 0.3))
    height_m: float = param(1.2, 0, 8, "m", "Height of the front where it stands highest.", soft=(0, 2))
    draw_m: float = param(0.14, 0, 4, "m", "How deep the water is drawn down behind a wave.", soft=(0, 1))
    plunge: float = param(
        0.0, 0, 1.5, "×", "How far crests steepen and fall over as they break (D34), by slope.", soft=(0, 1)
    )
    lip_m: float = param(1.6, 0, 6, "m", "How far ahead the highest crest throws its lip.", soft=(0, 3))
    breaking_s: float = param(
        1.5, 0.3, 10, "s", "Time from when the lip leaves the crest until it is down.", soft=(1, 4)
    )
    ragged: float = param(
        0.7, 0, 2, "", "How differently soon a crest breaks along its length, in times of its fall.", soft=(0, 1)
    )
    fade_in: float = param(0.25, 0.01, 1, "", "Over which part of the range a new front appears.")
    fade_out: float = param(0.06, 0.005, 1, "", "Over which part of the range a spent front disappears.")
    variety: float = param(0.5, 0, 1, "", "How much the height of one wave varies along the shore.")
    variety_m: float = param(45.0, 2, 2000, "m", "Length of that variation along the shore.", soft=(10, 200))
    runup_variety: float = param(
        0.0, 0, 1, "", "How much shorter of the run-up limit a low wave stops than a tall one.", soft=(0, 0.6)
    )
    runup_by_slope: float = param(
        0.0, 0, 1, "", "How far, by travel time, swell and slope of the beach say how high the swash reaches, "
        "up to the run-up limit (Hunt 1959).",
    )  # fmt: skip
    stagger: float = param(
        0.0, 0, 2, "", "How far waves arrive earlier or later along the shore, in intervals.", soft=(0, 1)
    )
    sway: float = param(
        0.12, 0, 1, "", "How far waves come earlier and later along the shore in a regular rhythm, in intervals.",
        soft=(0, 0.5),
    )  # fmt: skip
    sway_m: float = param(60.0, 5, 2000, "m", "Length of that rhythm along the shore.", soft=(20, 200))
    slide: bool = param(True, doc="The sheet slides on the beach: the surface never dips below the sand (H10).")
    monotone: bool = param(True, doc="Fronts pass a bar once: the clock reads the least depth on the way from the sea.")
    flat_slope: float = param(
        0.0175, 0, 0.2, "", "By depth, the slope that flats and troughs behind bars count as at least: fronts take "
        "their time there; 0: they cross a flat all at once.", soft=(0, 0.05),
    )  # fmt: skip
    smooth_m: float = param(2.0, 0, 100, "m", "How far the clock's bed is smoothed, so that pebbles bend no front.")
    distance_range_m: float = param(
        60.0, 1, 150, "m", "How far from the shoreline the shore map knows the distance to it (H11).", soft=(10, 80)
    )


class Water(Section):
    """What light does in the water: pure water (Pope & Fry 1997), plus what lives and drifts in it (L07)."""

    on: bool = param(True, doc="Draw the water.")
    plankton: float = param(
        0.2, 0, 100, "mg/m³", "Chlorophyll: 0.05 blue open sea, 1 green coast, 10 a bloom.", soft=(0, 3)
    )
    silt: float = param(0.4, 0, 1000, "g/m³", "Fine mineral grains: milky, paler, then brown.", soft=(0, 10))
    absorb_red: float = param(0.0, 0, 20, "1/m", "Absorption of red light, added.", soft=(0, 1))
    absorb_green: float = param(0.0, 0, 20, "1/m", "Absorption of green light, added.", soft=(0, 0.5))
    absorb_blue: float = param(0.0, 0, 20, "1/m", "Absorption of blue light, added.", soft=(0, 0.5))
    scatter: float = param(0.02, 0, 20, "1/m", "Scattering of light, added: paler, more turquoise.", soft=(0, 0.3))
    crest_light: float = param(1.0, 0, 4, "×", "How much sun comes through the crests of waves.", soft=(0, 2))
    roughness: float = param(0.09, 0.01, 1, "", "Roughness of clean water.", soft=(0.02, 0.4))
    specular: float = param(0.02, 0, 0.2, "", "Reflectance of the water seen from straight above.")
    foam: float = param(1.0, 0, 2, "", "Amount of foam the shore waves carry.")
    foam_tile_m: float = param(9.0, 0.5, 200, "m", "Size of one foam tile.", soft=(2, 30))
    model: Literal["plate", "albedo"] = param(
        "plate", doc="What lies below: lit first, seen through the water; or its colour lit with the water (low tier)."
    )
    blur: float = param(1.0, 0, 4, "×", "How blurred what lies deep is seen.", soft=(0, 2))
    blur_distance_m: float = param(16.0, 0.1, 200, "m", "Way through water that blurs fully.", soft=(1, 40))
    dispersion: float = param(0.0, 0, 1, "", "How differently red, green and blue are bent.", soft=(0, 0.3))
    table: str = param("", doc="Name of the water table in use; empty: what this section says.")
    bend: float = param(1.0, 0, 4, "×", "How far waves bend what is seen through them.", soft=(0, 2))
    reflections: float = param(
        1.0, 0, 1, "", "How clearly the land that is seen is mirrored; 0: as one colour of coast."
    )


class Light(Section):
    """Sun or moon, sky, exposure (L01 to L03). A preset of ENVIRONMENTS sets all of it at once."""

    sun_from: Literal["angles", "date"] = param("angles", doc="Place the sun by two angles, or by date and place.")
    sun_azimuth_deg: float = param(235.0, 0, 360, "°", "Where the sun stands, clockwise from north.")
    sun_elevation_deg: float = param(38.0, -20, 90, "°", "How high the sun stands.", soft=(2, 80))
    month: int = param(6, 1, 12, "", "Month of the date.")
    day: int = param(21, 1, 31, "", "Day of the month; past its end, its last day.")
    hour: float = param(15.0, 0, 24, "h", "Time of day on the place's clock.")
    utc_offset_h: float = param(0.0, -14, 14, "h", "How far that clock is ahead of UTC.")
    latitude_deg: float = param(50.4, -90, 90, "°", "Latitude of the place, north positive.")
    longitude_deg: float = param(-5.0, -180, 180, "°", "Longitude of the place, east positive.")
    day_rate: float = param(
        0.0, 0, 1e5, "×", "How fast the day goes by, when placed by date: 600 makes it 144 s long, 0 stands still.",
        soft=(0, 3600),
    )  # fmt: skip
    day_h: float = param(24.0, 0.1, 10_000, "h", "Length of a whole day at a rate of 1.", soft=(1, 48))
    adapt: float = param(0.82, 0, 1, "", "How far the exposure follows the light while the day runs.")
    adapt_from: Literal["day", "start"] = param(
        "day",
        doc="What the exposure is set for while the day runs: daylight, which for a day that begins at night is its "
        "noon's, or the light at the start.",
    )
    moonlit: bool = param(True, doc="The full moon shines at night, opposite the sun, while the day runs.")
    body: Literal["sun", "moon", "even"] = param(
        "sun", doc="What shines: the sun, the full moon in its place, or even white light from all sides."
    )
    turbidity: float = param(2.6, 1, 10, "", "Haze in the air.", soft=(1.5, 8))
    cloud_cover: float = param(0.0, 0, 1, "", "Share of the sky that a layer of cloud covers.")
    cloud_depth: float = param(
        12.0, 0, 200, "", "Optical depth of that layer: 5 a bright veil, 60 a storm.", soft=(2, 80)
    )
    exposure_ev: float = param(14.2, -8, 22, "EV100", "Exposure.", soft=(-4, 17))
    white_k: float = param(5600, 1500, 20_000, "K", "Colour temperature that shows as white.", soft=(3000, 9000))
    display: Literal["agx", "aces", "neutral", "raw"] = param("agx", doc="Transform from scene light to the display.")
    shadows: bool = param(True, doc="The sun casts shadows of land and props.")
    bounce: float = param(1.0, 0, 1, "", "How much of the light that the land hides comes back from the land itself.")


class Fog(Section):
    on: bool = param(True, doc="Haze over distance, on land and water alike (D38).")
    density: float = param(0.0001, 0, 0.2, "1/m", "Extinction of the haze at sea level.", soft=(0, 0.004))
    height_m: float = param(350.0, 1, 20_000, "m", "Height over which the haze thins to 1/e.", soft=(20, 2000))


class Time(Section):
    step_s: float = param(1 / 30, 1 / 240, 1, "s", "One step of the clock.", soft=(1 / 60, 0.2))
    rate: float = param(1.0, -8, 8, "×", "Speed of time.", soft=(0, 4))
    loop_start_s: float = param(0.0, 0, 10_000_000, "s", "Start of the loop.", soft=(0, 120))
    loop_end_s: float = param(0.0, 0, 10_000_000, "s", "End of the loop; 0 for none.", soft=(0, 120))
    loop_s: float = param(
        0.0, 0, 1e6, "s", "Every period of the sea becomes a divisor of this, and it comes round without a seam; "
        "0: none. Weather and sky keep to the clock.", soft=(0, 120),
    )  # fmt: skip
    warm_up_s: float = param(20.0, 0, 600, "s", "How long simulations run before a settled picture is taken.")


class Settings(Section):
    """All settings of a level; names on the command line are `section.name`."""

    level: WaterLevel = WaterLevel()
    sea: Sea = Sea()
    beach_mesh: BeachMesh = BeachMesh()
    shore: Shore = Shore()
    timing: Timing = Timing()
    river: RiverLook = RiverLook()
    mouth: MouthLook = MouthLook()
    water: Water = Water()
    caustics: Caustics = Caustics()
    flow: Flow = Flow()
    foam: Foam = Foam()
    glare: Glare = Glare()
    force: Force = Force()
    quiet: Quiet = Quiet()
    things: Things = Things()
    light: Light = Light()
    fog: Fog = Fog()
    clouds: Clouds = Clouds()
    cloud_terms: CloudTerms = CloudTerms()
    rain: Rain = Rain()
    weather: Weather = Weather()
    storm: Storm = Storm()
    ground: Ground = Ground()
    wet: Wet = Wet()
    scatter: Scatter = Scatter()
    tide: Tide = Tide()
    walk: Walk = Walk()
    time: Time = Time()
