extends RefCounted
## The numbers and maps of a level's sea or sky, and what they are at a time: what the kit's shader needs of a material.
##
## The formulas are those that NAME_sea.json and NAME_sky.json tell.

var numbers: Dictionary
var uniforms: Dictionary
var textures := {}

var _known := {}


## Read NAME_sea.json and the maps that it names; `part` may be "sky" too.
func _init(stem: String, part := "sea") -> void:
	numbers = JSON.parse_string(FileAccess.get_file_as_string("%s_%s.json" % [stem, part]))
	uniforms = numbers.uniforms
	var files := {}
	for sampler: String in numbers.maps:
		var name: String = numbers.maps[sampler].file
		if not files.has(name):
			files[name] = FileAccess.get_file_as_bytes(stem.get_base_dir().path_join(name))
		textures[sampler] = _texture(numbers.maps[sampler], files[name])


## Hand a material all of it, as it is at time 0.
func hand_to(material: ShaderMaterial) -> void:
	for sampler: String in textures:
		material.set_shader_parameter(sampler, textures[sampler])
	_hand(material, uniforms.keys())


## Bring a material to a time: in doubles, so that after a week of play no wave stands still or jumps.
func bring_to(material: ShaderMaterial, time_s: float) -> void:
	var loop_s: float = numbers.get("loop_s", 0.0)
	var t := fposmod(time_s, loop_s) if loop_s > 0.0 else time_s
	var changed := {}
	if numbers.has("track"):
		_follow(numbers.track, t, changed)
	for phase: Dictionary in numbers.phases:
		if t >= phase.from_s:
			_put(phase, phase.offset + phase.scale * _form(phase, phase.start + phase.rate_hz * t))
			changed[phase.uniform] = true
	if numbers.has("clock_hz"):
		var waves: float = t * numbers.clock_hz
		uniforms.u_shore_clock = waves - floorf(waves)
		uniforms.u_shore_cycle = fposmod(floorf(waves), 4096.0)
		changed.merge({"u_shore_clock": true, "u_shore_cycle": true})
	if numbers.has("tide"):
		for name: String in numbers.tide.base:
			uniforms[name] = numbers.tide.base[name] + tide_m(t)
			changed[name] = true
	_hand(material, changed.keys())


## How high the tide is over the mean sea, m.
func tide_m(t: float) -> float:
	var tide: Dictionary = numbers.tide
	var part: float = fposmod((t - tide.high_s) / tide.period_s, 1.0)
	var points: int = tide.curve.size() / 2
	for n in range(points - 1, -2, -1):
		var low := posmod(n, points)
		var high := (n + 1) % points
		var p0: float = tide.curve[2 * low] - float(n < 0)
		if part >= p0:
			var p1: float = tide.curve[2 * high] + float(n == points - 1)
			var h0: float = tide.curve[2 * low + 1]
			var h1: float = tide.curve[2 * high + 1]
			return tide.range_m * (h0 + (h1 - h0) * (1.0 - cos(PI * (part - p0) / (p1 - p0))) / 2.0 - 0.5)
	return 0.0


func _form(phase: Dictionary, cycles: float) -> float:
	var part := cycles - floorf(cycles)
	var whole := fposmod(floorf(cycles), phase.turns) if phase.turns > 0 else floorf(cycles)
	match phase.form:
		"whole":
			return whole
		"ramp":
			return 1.0 - absf(2.0 * part - 1.0)
		"cos":
			return cos(TAU * part)
		"sin":
			return sin(TAU * part)
		"hop":
			return fposmod(phase.first + phase.hop * whole, 1.0)
		"fold":
			return fposmod(phase.first + phase.hop * part, 1.0)
	return part


func _put(phase: Dictionary, value: float) -> void:
	if uniforms[phase.uniform] is not Array:
		uniforms[phase.uniform] = value
		return
	var row: Array = uniforms[phase.uniform]
	if phase.row >= 0 and row[phase.row] is Array:
		row = row[phase.row]
		row[phase.part] = value
	else:
		row[phase.row if phase.row >= 0 else phase.part] = value


## Straight lines between the knots of a track.
func _follow(track: Dictionary, t: float, changed: Dictionary) -> void:
	var times: Array = track.times_s
	var n := clampi(times.bsearch(t, false) - 1, 0, times.size() - 2)
	var share := clampf((t - times[n]) / (times[n + 1] - times[n]), 0.0, 1.0)
	for name: String in track.uniforms:
		uniforms[name] = _mixed(track.uniforms[name][n], track.uniforms[name][n + 1], share)
		changed[name] = true


func _mixed(a: Variant, b: Variant, share: float) -> Variant:
	if a is not Array:
		return lerpf(a, b, share)
	var found := []
	for i: int in a.size():
		found.append(_mixed(a[i], b[i], share))
	return found


func _texture(map: Dictionary, all: PackedByteArray) -> ImageTexture:
	var floats: bool = map.format == "float32"
	var formats := {3: Image.FORMAT_RGB8, 4: Image.FORMAT_RGBA8}
	if floats:
		formats = {1: Image.FORMAT_RF, 2: Image.FORMAT_RGF, 4: Image.FORMAT_RGBAF}
	var width := 4 if floats else 1
	var size: int = map.width * map.height * map.channels
	var part := all.slice(width * map.offset, width * (map.offset + size))
	var format: Image.Format = formats[int(map.channels)]
	return ImageTexture.create_from_image(Image.create_from_data(map.width, map.height, false, format, part))


## Uniforms by name, each as the shader declares it.
func _hand(material: ShaderMaterial, names: Array) -> void:
	var shader := material.shader.get_rid()
	if not _known.has(shader):
		_known[shader] = {}
		for uniform: Dictionary in RenderingServer.get_shader_parameter_list(shader):
			_known[shader][uniform.name] = uniform.type
	for name: String in names:
		material.set_shader_parameter(name, _value(_known[shader].get(name, TYPE_FLOAT), uniforms[name]))


func _value(kind: int, raw: Variant) -> Variant:
	match kind:
		TYPE_BOOL:
			return bool(raw)
		TYPE_INT:
			return int(raw)
		TYPE_VECTOR2:
			return Vector2(raw[0], raw[1])
		TYPE_VECTOR3:
			return Vector3(raw[0], raw[1], raw[2])
		TYPE_VECTOR4:
			return Vector4(raw[0], raw[1], raw[2], raw[3])
		TYPE_VECTOR2I:
			return Vector2i(raw[0], raw[1])
		TYPE_VECTOR3I:
			return Vector3i(raw[0], raw[1], raw[2])
		TYPE_VECTOR4I:
			return Vector4i(raw[0], raw[1], raw[2], raw[3])
		TYPE_PACKED_VECTOR2_ARRAY:
			return PackedVector2Array(raw.map(func(v): return Vector2(v[0], v[1])))
		TYPE_PACKED_VECTOR3_ARRAY:
			return PackedVector3Array(raw.map(func(v): return Vector3(v[0], v[1], v[2])))
		TYPE_PACKED_VECTOR4_ARRAY:
			return PackedVector4Array(raw.map(func(v): return Vector4(v[0], v[1], v[2], v[3])))
		TYPE_PACKED_FLOAT32_ARRAY:
			return PackedFloat32Array(_flat(raw))
		TYPE_PACKED_INT32_ARRAY:
			return PackedInt32Array(_flat(raw))
	return raw


func _flat(raw: Array) -> Array:
	var found := []
	for value: Variant in raw:
		found.append_array(value if value is Array else [value])
	return found
