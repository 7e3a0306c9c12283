extends RefCounted
## The numbers and maps of a level's sea, and what they are at a time: what `NAME_sea.gdshaderinc` needs of a material.

var clock_hz := 0.0
var loop_s := 0.0
var uniforms := {}
var phases := []
var textures := {}


## Read NAME_sea.json and NAME_sea.f32.
func _init(stem: String) -> void:
	var numbers: Dictionary = JSON.parse_string(FileAccess.get_file_as_string(stem + "_sea.json"))
	var texels := FileAccess.get_file_as_bytes(stem + "_sea.f32")
	uniforms = numbers.uniforms
	phases = numbers.phases
	clock_hz = numbers.clock_hz
	loop_s = numbers.loop_s
	for sampler: String in numbers.maps:
		textures[sampler] = _texture(numbers.maps[sampler], texels)


func _texture(map: Dictionary, texels: PackedByteArray) -> ImageTexture:
	var format := Image.FORMAT_RGBAF if map.channels == 4 else Image.FORMAT_RGF
	var size: int = map.width * map.height * map.channels
	var part := texels.slice(4 * map.offset, 4 * (map.offset + size))
	return ImageTexture.create_from_image(Image.create_from_data(map.width, map.height, false, format, part))


## Hand a material all of it, as it is at time 0.
func hand_to(material: ShaderMaterial) -> void:
	for sampler: String in textures:
		material.set_shader_parameter(sampler, textures[sampler])
	var kinds := _kinds(material)
	for uniform: String in uniforms:
		material.set_shader_parameter(uniform, _value(kinds.get(uniform, TYPE_FLOAT), uniforms[uniform]))


## Bring a material's sea to a time: in doubles, so that after a week of play no wave stands still or jumps.
func bring_to(material: ShaderMaterial, time_s: float) -> void:
	var t := fposmod(time_s, loop_s) if loop_s > 0.0 else time_s
	var changed := {}
	for phase: Dictionary in phases:
		var cycles: float = phase.start + phase.rate_hz * t
		var value := fposmod(floorf(cycles), phase.turns) if phase.turns > 0 else cycles - floorf(cycles)
		var part: Array = uniforms[phase.uniform] if phase.row < 0 else uniforms[phase.uniform][phase.row]
		part[phase.part] = value
		changed[phase.uniform] = true
	var waves := t * clock_hz
	uniforms.u_shore_clock = waves - floorf(waves)
	uniforms.u_shore_cycle = fposmod(floorf(waves), 4096.0)
	changed.merge({"u_shore_clock": true, "u_shore_cycle": true})
	var kinds := _kinds(material)
	for uniform: String in changed:
		material.set_shader_parameter(uniform, _value(kinds.get(uniform, TYPE_FLOAT), uniforms[uniform]))


var _known := {}


func _kinds(material: ShaderMaterial) -> Dictionary:
	var shader := material.shader.get_rid()
	if not _known.has(shader):
		_known[shader] = {}
		for uniform: Dictionary in RenderingServer.get_shader_parameter_list(shader):
			_known[shader][uniform.name] = uniform.type
	return _known[shader]


func _value(kind: int, raw: Variant) -> Variant:
	match kind:
		TYPE_BOOL:
			return bool(raw)
		TYPE_INT:
			return int(raw)
		TYPE_VECTOR2, TYPE_VECTOR2I:
			return Vector2(raw[0], raw[1])
		TYPE_VECTOR3, TYPE_VECTOR3I:
			return Vector3(raw[0], raw[1], raw[2])
		TYPE_VECTOR4, TYPE_VECTOR4I, TYPE_COLOR:
			return Vector4(raw[0], raw[1], raw[2], raw[3])
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
		if value is Array:
			found.append_array(value)
		else:
			found.append(value)
	return found
