extends Node3D
## A level of Shorewright: its ground and its sea, which moves as it did in the editor. Space holds the clock.
##
## Metres; X east, Y up with the still sea at 0, Z south; the level's north-west corner stands at the origin.

const SeaUniforms := preload("sea_uniforms.gd")
const Rings := preload("rings.gd")
const RIPPLES := 256

@export var level_name := ""
@export var size_m := Vector2.ZERO
@export var cell_m := 1.0
@export var height_range_m := Vector2.ZERO
@export var mean_sea_m := 0.0
@export var cover_cell_m := 1.0
@export var sea_shader: Shader
@export var ground_shader: Shader
@export var absorption_per_m := Vector3.ZERO
@export var backscatter_per_m := Vector3.ZERO
## Width of the smallest cells of land and sea.
@export var fine_m := 0.5
## 2 or 4 for slow machines: so many times fewer cells along a side.
@export_range(1, 4) var coarse := 1
@export var time_s := 0.0
@export var held := false

var sea: SeaUniforms
var sea_material := ShaderMaterial.new()
var ground_material := ShaderMaterial.new()
var drawn: Array[MeshInstance3D] = []


func _ready() -> void:
	var stem := (get_script() as Script).resource_path.get_base_dir().path_join(level_name)
	sea = SeaUniforms.new(stem)
	sea_material.shader = sea_shader
	ground_material.shader = ground_shader
	sea.hand_to(sea_material)
	_hand_ground(stem)
	_hand_looks(stem)
	var mesh := Rings.build(fine_m, coarse)
	for material: ShaderMaterial in [ground_material, sea_material]:
		var one := MeshInstance3D.new()
		one.mesh = mesh
		one.material_override = material
		one.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF  # cells as large as a shadow's texels
		add_child(one)
		drawn.append(one)


func _process(delta: float) -> void:
	if not held:
		time_s += delta
	sea.bring_to(sea_material, time_s)
	var eye := get_viewport().get_camera_3d()
	if eye:
		var step := Rings.step_m(fine_m * coarse)
		var place := eye.global_position.snapped(Vector3(step, step, step))
		for one in drawn:
			one.global_position = Vector3(place.x, 0, place.z)


func _unhandled_key_input(event: InputEvent) -> void:
	if event.is_pressed() and not event.is_echo() and event.keycode == KEY_SPACE:
		held = not held


## Heights as the two bytes of each word: R the low one, G the high one.
func _hand_ground(stem: String) -> void:
	var words := FileAccess.get_file_as_bytes(stem + "_height.r16")
	var cols := roundi(size_m.x / cell_m) + 1
	var image := Image.create_from_data(cols, words.size() / 2 / cols, false, Image.FORMAT_RG8, words)
	sea_material.set_shader_parameter("look_size_m", size_m)
	sea_material.set_shader_parameter("look_mean_sea_m", mean_sea_m)
	ground_material.set_shader_parameter("size_m", size_m)
	ground_material.set_shader_parameter("height_words", ImageTexture.create_from_image(image))
	ground_material.set_shader_parameter("height_range_m", height_range_m)
	ground_material.set_shader_parameter("cell_m", cell_m)


func _hand_looks(stem: String) -> void:
	sea_material.set_shader_parameter("look_absorption_per_m", absorption_per_m)
	sea_material.set_shader_parameter("look_backscatter_per_m", backscatter_per_m)
	sea_material.set_shader_parameter("look_ripples", _ripples())
	var lace: Image = sea.textures.u_foam.get_image()
	lace.generate_mipmaps()
	sea_material.set_shader_parameter("look_lace", ImageTexture.create_from_image(lace))
	for name: String in ["cover_weights", "cover_weights_2"]:
		var path := "%s_%s.png" % [stem, name]
		if FileAccess.file_exists(path):
			var image := Image.new()
			image.load_png_from_buffer(FileAccess.get_file_as_bytes(path))
			ground_material.set_shader_parameter(name, ImageTexture.create_from_image(image))
			ground_material.set_shader_parameter("has_cover", true)
			ground_material.set_shader_parameter("cover_cell_m", cover_cell_m)


func _ripples() -> ImageTexture:
	var noise := FastNoiseLite.new()
	noise.noise_type = FastNoiseLite.TYPE_SIMPLEX_SMOOTH
	noise.frequency = 0.03
	var image := noise.get_seamless_image(RIPPLES, RIPPLES)
	image.convert(Image.FORMAT_RGBA8)
	image.bump_map_to_normal_map(6.0)
	image.generate_mipmaps()
	return ImageTexture.create_from_image(image)
