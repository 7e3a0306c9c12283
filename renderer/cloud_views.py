"""Views of clouds: every channel of their noises, every stage of their shape, every term of their light (Z01, Z21).

Noises and the image's own numbers are expressions of shaders/cloud_view.glsl; stages are pictures with terms off.
"""

from __future__ import annotations

from .view_row import View

ON = (("clouds.on", True),)
SHAPE = ("coverage", "thin", "erode", "inverted", "curl")  # in the order in which they come in
LIGHT = ("cone", "far", "phase", "powder", "rain")


def _noise(name: str, label: str, doc: str, value: str, ids: str = "Z01") -> View:
    return View(name, label, doc, value, "direct" if "rgb" in value else "grey", ids=ids, settings=ON, sky=True)


def _image(name: str, label: str, doc: str, value: str, high: float = 1.0, ids: str = "Z17") -> View:
    return View(name, label, doc, value, "grey", 0.0, high, ids, settings=ON, sky=True)


def _stage(name: str, label: str, doc: str, off: tuple[str, ...]) -> View:
    terms = tuple((f"cloud_terms.{term}", False) for term in off)
    return View(name, label, doc, ids="Z21 Z02", settings=(*ON, *terms))


def _shape(name: str, label: str, doc: str, upto: int) -> View:
    return _stage(name, label, doc, SHAPE[upto:])


def _light(name: str, label: str, doc: str, upto: int) -> View:
    return _stage(name, label, doc, LIGHT[upto:])


CLOUD_VIEWS = (
    _noise("cloud_perlin", "Noise: Perlin", "Perlin fBm alone, a slice.", "vec3(perlin)", "Z01 Z21"),
    _noise("cloud_worley", "Noise: Worley", "Inverted Worley fBm, the coarsest: packed billows.", "vec3(shape.g)",
           "Z01 Z21"),
    _noise("cloud_perlin_worley", "Noise: Perlin-Worley", "Perlin noise that Worley noise has dilated.",
           "vec3(shape.r)", "Z01 Z21"),
    _noise("cloud_worley_2", "Noise: Worley 2", "Inverted Worley fBm, twice as fine.", "vec3(shape.b)"),
    _noise("cloud_worley_3", "Noise: Worley 3", "Inverted Worley fBm, four times as fine.", "vec3(shape.a)"),
    _noise("cloud_detail_1", "Noise: detail 1", "The coarsest channel of the detail noise.", "vec3(detail.r)"),
    _noise("cloud_detail_2", "Noise: detail 2", "Its middle channel.", "vec3(detail.g)"),
    _noise("cloud_detail_3", "Noise: detail 3", "Its finest channel.", "vec3(detail.b)"),
    _noise("cloud_curl", "Noise: curl", "Turbulence: red east, green north, blue up; grey is none.", "curl.rgb"),
    _noise("cloud_profile", "Height curves", "Density by height: stratus on the left, thunderheads on the right.",
           "vec3(profile)", "Z03"),
    _shape("cloud_height", "Stage: base × height", "The base shape times the height curve, everywhere.", 0),
    _shape("cloud_coverage", "Stage: × coverage", "Only where the weather map has clouds.", 1),
    _shape("cloud_thin", "Stage: thin bottoms", "Thinner at the base.", 2),
    _shape("cloud_eroded", "Stage: eroded", "Edges eroded by the detail noise.", 3),
    _shape("cloud_inverted", "Stage: wisps", "That noise inverted at the base.", 4),
    _shape("cloud_curled", "Stage: curled", "And bent by turbulence: the whole shape.", 5),
    _image("cloud_alpha", "Clouds: alpha", "How much clouds hide.", "vec3(1.0 - cloud.a)", ids="Z21"),
    _image("cloud_depth", "Clouds: distance", "Mean distance of the clouds, 40 km to white.", "vec3(distance_m)",
           40_000.0),
    _image("cloud_samples", "Clouds: samples", "Full samples that a ray takes, 100 to white.", "vec3(samples())", 100.0,
           "Z14"),
    _light("cloud_unlit", "Light: none", "Clouds of one brightness: no samples towards the sun.", 0),
    _light("cloud_cone", "Light: five in a cone", "Beer's law over five samples in a cone towards the sun.", 1),
    _light("cloud_beer", "Light: and one far", "And over a sixth far away: Beer's law alone.", 2),
    _light("cloud_phase", "Light: × Henyey-Greenstein", "Scattered forward: silver linings.", 3),
    _light("cloud_powder", "Light: × powder", "Dark edges away from the sun.", 4),
    _light("cloud_rain", "Light: rain absorbs", "Rain clouds swallow light: the whole light.", 5),
)  # fmt: skip
