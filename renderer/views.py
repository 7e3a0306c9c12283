"""VIEWS: every buffer and mask as a picture, one row each; `final` is the picture itself.

A row's `value` is a GLSL expression (vec3) over what shaders/view.glsl lays out for each pixel:
`s` the G-buffer, `position` in the world, `sea` the wave function there, `bed`, `ground` (height, slope east, slope
north), `on_sea`, `shore_field` (packed, see lib/shore_field.glsl). `ramp` says how numbers become colours: `light`
through the display transform, `colour` linear colour, `direct` as it is, `grey` from `low` to `high`, `signed` blue
below zero and red above, `normal`, `metres` bands of xyz. EXR output holds the numbers themselves.
"""

from __future__ import annotations

from ..level import LAYERS, BadInput
from .cloud_views import CLOUD_VIEWS
from .flow_views import FLOW_VIEWS
from .mouth_views import MOUTH_VIEWS
from .river_views import RIVER_VIEWS
from .view_row import RAMPS as RAMPS
from .view_row import View


def _layer_view(row) -> View:
    if row.name == "height":
        return View("layer_height", "Layer: Height", row.doc, "vec3(ground.x)", "signed", -20.0, 20.0)
    signed = row.name in ("flow", "river_surface")
    value = "painted.rgb" if len(row.channels) > 1 else "vec3(painted.r)"
    ramp = "signed" if row.name == "river_surface" else "direct" if len(row.channels) > 1 else "grey"
    if row.name == "flow":
        value = "vec3(painted.rg * 0.25 + 0.5, 0.5)"
    if row.name == "scatter":
        value = "painted.rgb * 0.5 + 0.5"
    return View(
        f"layer_{row.name}", f"Layer: {row.label}", row.doc, value, ramp, -20.0 if signed else 0.0,
        20.0 if signed else 1.0, layer=row.name,
    )  # fmt: skip


_MASK = "vec3(on_sea * {})".format

VIEWS: dict[str, View] = {
    view.name: view
    for view in (
        View("final", "Picture", "What the game shows.", ids="D01"),
        View("lookdev", "Look-dev", "A grey ball, a chrome ball and a card of 24 patches in the picture's light.",
             ids="L08", scene="lookdev"),
        View("furnace", "Furnace", "White land under even light: whatever isn't 1 is a fault of the light.", "lit",
             "grey", 0.9, 1.1, ids="L01", scene="white",
             settings=(("light.body", "even"), ("light.cloud_cover", 0.0), ("water.on", False), ("fog.on", False))),
        View("albedo", "Albedo", "Colour of land and foam without light.", "s.albedo", "colour", ids="D01"),
        View("normal", "Normal", "World normals: red east, green north, blue up.", "s.normal", "normal", ids="D01"),
        View("roughness", "Roughness", "Roughness of what lies on top.", "vec3(s.roughness)", ids="D01"),
        View("specular", "Specular", "Reflectance seen from straight above.",
             "vec3(s.specular)", "grey", 0, 0.06, ids="D01"),
        View("material", "Material", "Land, sea, river, ice, puddle, snow.",
             "material_colour(s.material)", "direct", ids="D01"),
        View("emissive", "Emissive", "Light that is finished before the light pass.", "s.emissive", "light", ids="D01"),
        View("eye_depth", "Eye depth", "Distance along the view, 400 m to white.",
             "vec3(s.eye_depth)", "grey", 0, 400, ids="D01"),
        View("position", "Position", "World position, bands of 10 m.", "position", "metres", ids="D01"),
        View("hdr", "Light", "Lit scene before haze.", "lit", "light", ids="D01"),
        View("point_lights", "Point lights", "Light of lamps alone.", "lit", "light", ids="D01", scene="lamps"),
        View("shadow", "Sun visibility", "White in the sun, black in the shadow of land and things.",
             "vec3(sun_visibility(position))", ids="L03"),
        View("prop_shadow", "Shadow of things", "Black in the shadow of rocks, driftwood, grass and props alone.",
             "vec3(prop_visibility(position))", ids="L03"),
        View("cloud_shadow", "Shadow of clouds", "White where the sun comes through the clouds.",
             "vec3(mix(0.1 * s.open, 1.0, cloud_visibility(position)))", ids="Z19", settings=(("clouds.on", True),)),
        View("cirrus", "Cirrus", "Ice high over each place.", "vec3(cirrus_at(position.xy, 0.0))", ids="Z13",
             settings=(("clouds.on", True),)),
        View("alto", "Altocumulus", "Small heaps high over each place; land in dark grey.",
             "vec3(0.06 * on_land + alto_at(position.xy, 0.0))", ids="Z13", settings=(("clouds.on", True),)),
        View("scatter", "Scatter", "Kinds of scattered things in colours, on ground in grey.",
             "s.material == LAND && s.emissive != vec3(0.0) ? s.emissive"
             " : vec3(0.12 * s.open + 0.1 * sun_visibility(position))",
             "direct", ids="L09"),
        View("props", "Props", "Each prop in a colour of its own, on everything else in grey.",
             "s.material == LAND && s.emissive != vec3(0.0) ? s.emissive"
             " : vec3(0.12 * s.open + 0.1 * sun_visibility(position))",
             "direct", ids="D12"),
        View("sky_visibility", "Sky visibility", "Share of the sky that the land leaves open.",
             "vec3(s.open)", ids="L02 L03"),
        View("ground", "Ground", "The material that shows most; hide the water to see the sea's floor.",
             "s.material == LAND ? s.emissive : vec3(0.05)", "direct", ids="L05"),
        View("height", "Height", "Ground over (red) and below (blue) the still sea.",
             "vec3(ground.x - u_sea_level_m)", "signed", -20, 20),
        View("slope", "Slope", "Steepness of the ground, 60° to white.",
             "vec3(degrees(atan(length(ground.yz))))", "grey", 0, 60),
        View("depth", "Depth", "Still water over the ground, 10 m to white.",
             "vec3(max(u_sea_level_m - ground.x, 0.0))", "grey", 0, 10, ids="D03"),
        View("depth_fract", "Depth bands", "Depth in bands of 1 m.",
             "vec3(ground.x < u_sea_level_m ? fract(u_sea_level_m - ground.x) : 0.0)", ids="D03"),
        View("clock_depth", "Clock depth", "The monotone depth that the shore clock reads.",
             "vec3(bed.clock.x)", "signed", -8, 8, ids="D03"),
        View("sea_mask", "Sea mask", "Water connected to the sea, and its swash.", "vec3(bed.sea.x)", ids="D03"),
        View("shore_distance", "Shore distance", "Metres to the still shoreline: red in the sea, blue on land, "
             "30 m to full.", "vec3(decode_distance_m(shore_field.r))", "signed", -30, 30, ids="H11"),
        View("shore_direction", "Shore direction", "To the shore in the sea and on inland: red east, green north.",
             "vec3(decode_direction(shore_field.gb) * 0.5 + 0.5, 0.5)", "direct", ids="H11 D06"),
        View("beach_slice", "Beach slice", "The beach without rocks, 2 m below the still sea to 2 m above it.",
             "vec3(decode_beach_m(shore_field.a))", "signed", -2, 2, ids="H10"),
        View("beach_slide", "Beach slide", "Orange where the sheet lies on the sand without thickness, blue where "
             "water stands over it, half a metre to full; black where nothing holds it.",
             "sea.sheet > 8.0 ? vec3(0.0) : sea.sheet <= 0.0 ? vec3(1.0, 0.5, 0.1)"
             " : mix(vec3(0.6, 0.8, 1.0), vec3(0.0, 0.1, 0.6), clamp(2.0 * sea.sheet, 0.0, 1.0))", "direct", ids="H10"),
        View("shore_phase", "Shore phase", "White where a wave meets the still water line, fading until the next does: "
             "one phase for water and sand.", "vec3((1.0 - swash_phase(sea.shore)) * bed.sea.x)", ids="H20 D10"),
        View("wave_a", "Wave A", "The rear smoothstep of the nearest front.", _MASK("sea.shore.a"), ids="D03"),
        View("wave_b", "Wave B", "The front smoothstep of the nearest front.", _MASK("sea.shore.b"), ids="D03"),
        View("wave_line", "Wave line", "A − B: the front line.", _MASK("sea.shore.line"), ids="D03 D04"),
        View("wave_back", "Wave back", "Behind the line, trailing seaward.", _MASK("sea.shore.back"), ids="D04"),
        View("breaking", "Breaking", "How waves break: orange they plunge, blue they spill, grey they surge; brighter "
             "the further they have broken, white where they are white.", "on_sea * breaking_colour(sea)", "direct",
             ids="D34 H23", settings=(("shore.plunge", 1.0),)),
        View("crest_fall", "Crest fall", "Foam that falls over the shoreward face.",
             _MASK("sea.shore.fall"), ids="D04"),
        View("shore_lift", "Shore lift", "Height the shore waves add.",
             _MASK("sea.shore.lift.x"), "signed", -0.6, 0.6, ids="D10"),
        View("arrival", "Arrival", "When fronts pass, in bands of 10 s; black where no wave stands.",
             "vec3(on_sea * passage_shown(position.xy).x)", "metres", ids="T06"),
        View("front_speed", "Front speed", "Speed of fronts over the ground, 10 m/s to white.",
             "vec3(on_sea * passage_shown(position.xy).y)", "grey", 0, 10, ids="T06"),
        View("breakers", "Breakers", "Where waves break: blue spilling, orange plunging, pink surging.",
             "on_sea * breaker_shown(passage_at(position.xy))", "direct", ids="T06"),
        View("shaping_limits", "Shaping limits", "What forbids to shape a front: red beds as steep as the limit of "
             "35° and the level's border, yellow near it, green free; dim where no wave stands, grey land.",
             "passage_shaped(position.xy)", "direct", ids="T07"),
        View("gerstner_weight", "Offshore weight", "How far the offshore waves are faded in.",
             _MASK("sea.deep"), ids="D11"),
        View("gerstner_height", "Offshore height", "Height the offshore waves add.",
             _MASK("(sea.position.z - u_sea_level_m - sea.shore.lift.x)"), "signed", -1, 1, ids="D11 H05"),
        View("surface_height", "Surface height", "Height of the water over the still sea.",
             "vec3(position.z - u_sea_level_m)", "signed", -1.5, 1.5, ids="D10 H05"),
        View("before", "Before", "World xy before deformation, bands of 10 m.",
             "vec3(s.before, 0.0)", "metres", ids="H30"),
        View("after", "After", "World xy after deformation, bands of 10 m.",
             "vec3(position.xy, 0.0)", "metres", ids="H30"),
        View("foam", "Foam", "Cover of foam on the water.", "vec3(s.foam)", ids="D04"),
        View("wetness", "Wetness", "Wet ground, and water.", "vec3(s.wet)", ids="L06"),
        View("film", "Film", "Water on the sand behind the draining sheet, which mirrors the sky.",
             "vec3(on_land * shore_wet(position.xy, position.z - u_sea_level_m, 0.02).film)", ids="L06"),
        View("lace", "Lace", "Foam that the sheet left on the sand.", "vec3(on_land * s.foam)",
             "grey", 0, 0.5, ids="L06"),
        View("flow", "Flow", "The whole current, 1 m/s to full: red east, green north; grey is none.",
             "vec3(current_at(s.before).rg * 0.5 + 0.5, 0.5) * (0.3 + 0.7 * on_sea)", "direct", ids="D05 D06"),
        View("flow_speed", "Flow speed", "White where a river is so fast that its foam is full; in the sea the speed, "
             "1 m/s to white.", "vec3(on_sea * flow_speed_shown(sea, s.before))", ids="D05 D15"),
        *RIVER_VIEWS,
        View("flow_faults", "Flow: faults", "Red where the current runs into land, blue where water comes from nowhere "
             "or vanishes, a quarter of a cell's speed to full; green its speed, 4 m/s to full.",
             "on_sea * flow_faults(s.before)", "direct", ids="T02"),
        *FLOW_VIEWS,
        View("foam_shore", "Foam: shore", "Constant foam by the distance to the shore, before it is torn.",
             "vec3(on_sea * foam_of_shore(current_at(s.before).a, 1.0))", ids="H18"),
        View("foam_height", "Foam: height", "Foam on the highest water.",
             "vec3(on_sea * foam_of_height(sea.height01 * min(2.0 * sea.deep, 1.0)))", ids="H18"),
        View("foam_mask", "Foam: mask", "How much foam is asked for: what picks between the densities.",
             "vec3(on_sea * view_foam(sea, s.before, position, s.eye_depth * u_pixel_angle).amount)", ids="H18"),
        View("foam_thin", "Foam: thin", "The thinnest of the packed densities alone.",
             "vec3(on_sea * foam_density(s.before, s.eye_depth * u_pixel_angle).r)", ids="H18"),
        View("foam_middle", "Foam: middle", "The middle one of the packed densities alone.",
             "vec3(on_sea * foam_density(s.before, s.eye_depth * u_pixel_angle).g)", ids="H18"),
        View("foam_dense", "Foam: dense", "The densest of the packed densities alone.",
             "vec3(on_sea * foam_density(s.before, s.eye_depth * u_pixel_angle).b)", ids="H18"),
        View("foam_transient", "Foam: transient", "Painted foam that comes with the waves.",
             "vec3(on_sea * foam_painted(layer_at(u_layer_foam, s.before, u_cell_m).rg, sea.shore).x)", ids="D07"),
        View("foam_constant", "Foam: constant", "Painted foam that is always there.",
             "vec3(on_sea * foam_painted(layer_at(u_layer_foam, s.before, u_cell_m).rg, sea.shore).y)", ids="D07"),
        View("foam_shadow", "Foam shadow", "Black where foam shades what lies below.",
             "vec3(on_sea * shade_of_foam(sea, s))", ids="D21"),
        View("caustics", "Caustics", "Light that waves gather on the bed; grey is the mean.",
             "vec3(on_sea * 0.3 * caustics(below, max(u_sea_level_m - ground.x, 0.0), s.eye_depth * u_pixel_angle))",
             ids="D08 H13"),
        View("force", "Force", "How the water is pushed about, 2 m/s to full: red east, green north; grey is none.",
             "vec3(force_at(s.before).xy * 0.25 + 0.5, 0.5)", "direct", ids="D18"),
        View("force_lift", "Force: lift", "Height that the pushed water adds.",
             "vec3(on_sea * force_lift(s.before).x)", "signed", -0.2, 0.2, ids="D18"),
        View("force_foam", "Force: foam", "Foam that the pushed water makes.",
             "vec3(on_sea * force_at(s.before).w)", ids="D18"),
        View("phase_noise", "Phase noise", "How far the crests of the largest front are bent: red ahead.",
             "vec3(on_sea * phase_noise(HIGH_FRONTS, s.before).x)", "signed", -0.2, 0.2, ids="H07"),
        View("plate_a", "Plate A", "The land lit before the water, with caustics, at half size.",
             "plate(gl_FragCoord.xy, 0.0)", "light", ids="H12"),
        View("plate_b", "Plate B", "Plate A blurred: what deep water shows.",
             "plate(gl_FragCoord.xy, 1.0)", "light", ids="H12"),
        View("surface_eye_depth", "Depth from the surface", "Along the view, from the water to its bed, 20 m to white.",
             "vec3(on_sea * max(texelFetch(under_eye_depth, pixel, 0).r - s.eye_depth, 0.0))",
             "grey", 0, 20, ids="H12 H14"),
        View("reflections", "Reflections", "The land that the water mirrors, before Fresnel; black where it is sky.",
             "on_sea * mirrored_land(s, ray * s.eye_depth)", "light", ids="H17"),
        View("ripples", "Ripples", "Normals of the baked small waves alone.",
             "ripple_normal(s, ray * s.eye_depth)", "normal", ids="H16"),
        View("rings", "Rings", "Slopes of rings from hits and floating things: red east, green north; grey is none.",
             "vec3(on_sea * 2.0 * ring_slope(position.xy, s.eye_depth * u_pixel_angle).xy + 0.5, 0.5)",
             "direct", ids="H19"),
        View("rain_ripples", "Rain ripples", "Slopes of the rings of drops: red east, green north; blue what of them "
             "is too small for a pixel and makes it rough; black where none fall.",
             "on_sea * rain_shown(s.before, s.eye_depth * u_pixel_angle)", "direct", ids="D17",
             settings=(("clouds.on", True),)),
        View("glint", "Glint", "The sun in the water's mirror, without haze.",
             "on_sea * sun_glint(s, ray * s.eye_depth)", "light", ids="L07"),
        View("crest_light", "Crest light", "The sun that comes through the crests of waves, as a share of it.",
             "on_sea * crest_light(sea, s, ray * s.eye_depth)", "grey", 0, 0.12, ids="L07"),
        View("under_albedo", "Under: albedo", "Albedo of what lies under the water.", "under", "colour", ids="D02"),
        View("patches", "Patches", "Kinds of sea by hectare, cells of 10 m: blue open, green coastal, sand beach, "
             "red removed; grey is the horizon's plane.",
             "patch_colour(position.xy, s.eye_depth * u_pixel_angle) * (0.6 + 0.4 * on_sea)", "direct",
             ids="H01 H27"),
        View("beach_mesh", "Beach mesh", "The mesh along the waterline by its tessellation bias: from blue, small "
             "triangles, to yellow, those of 50 m² of the 10 m grid, which its border has; white edges.",
             "beach_mesh_colour(position.xy, s.eye_depth * u_pixel_angle, "
             "mix(0.06 + 0.7 * s.albedo, vec3(0.03, 0.06, 0.10), on_sea))", "direct",
             ids="H03"),
        View("wave_objects", "Wave objects", "How many reach each hectare: blue one, green two, sand three, red four; "
             "white their weight, violet regions of swell.",
             "wave_objects_colour(position.xy, s.eye_depth * u_pixel_angle) * (0.4 + 0.6 * on_sea)", "direct",
             ids="H08 D32"),
        View("triangle_area", "Triangle area", "Pixels a triangle of the sea has, 400 to white; red under 16, "
             "blue the horizon's plane.",
             "on_sea * triangle_colour(s.emissive.x)", "direct",
             ids="H02"),
        *(
            View(f"weather_{stage}", f"Weather: {stage}", f"The weather map {told}, as it lies over the ground: "
                 "red coverage, green precipitation, blue type.", "weather_stage(position.xy)", "direct", ids=ids)
            for stage, told, ids in (
                ("simulated", "as it makes itself", "Z05"), ("painted", "with the paint", "Z05"),
                ("horizon", "with the horizon's own sky", "Z06"),
            )
        ),
        View("weather_final", "Weather: final", "The weather map as clouds read it: red coverage, green precipitation, "
             "blue from stratus over cumulus to cumulonimbus.", "weather_map(position.xy).rgb", "direct", ids="Z04"),
        View("rain_rate", "Rain", "Rain that falls from the clouds, 20 mm/h to white.",
             "vec3(rain_at(position.xy, ground.x - u_sea_level_m).x)", "grey", 0, 20, ids="Z18"),
        View("snow_rate", "Snowfall", "Snow that falls from them, 20 mm/h of water to white.",
             "vec3(rain_at(position.xy, ground.x - u_sea_level_m).y)", "grey", 0, 20, ids="Z24"),
        View("tide_band", "Tide band", "Blue is always under water, sand falls dry and comes under, green is dry; "
             "lines at low, mean and high water.",
             "tide_band(ground_sample(below), below, s.eye_depth * u_pixel_angle)", "direct", ids="D31"),
        View("walkable", "Walkable", "Green where the player can go, red beyond.",
             "walkable > 0.5 ? vec3(0.1, 0.7, 0.2) : vec3(0.8, 0.1, 0.1)", "direct", ids="D31"),
        *MOUTH_VIEWS,
        *CLOUD_VIEWS,
        *(_layer_view(row) for row in LAYERS.values()),
    )
}  # fmt: skip


def find_view(name: str) -> View:
    """The row of a view; BadInput names the list when there is none of that name."""
    if name not in VIEWS:
        raise BadInput(f"no view is called {name!r}; `shorewright views` lists them all")
    return VIEWS[name]
