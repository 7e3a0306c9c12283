extends Node
## Asks the kit for the sea at points and times, and tells the pixels of each answer.

const SeaUniforms := preload("sea_uniforms.gd")


func _ready() -> void:
	var asked: Dictionary = JSON.parse_string(FileAccess.get_file_as_string("res://asked.json"))
	var sea := SeaUniforms.new("res://" + asked.name, asked.get("part", "sea"))
	var window := JavaScriptBridge.get_interface("window")
	var view := SubViewport.new()
	view.size = Vector2i(asked.cols, asked.rows * 16)
	var sheet := ColorRect.new()
	sheet.size = view.size
	var material := ShaderMaterial.new()
	material.shader = load("res://points.gdshader")
	sheet.material = material
	sea.hand_to(material)
	view.add_child(sheet)
	add_child(view)
	var all := FileAccess.get_file_as_bytes("res://points.f32")
	var step: int = asked.cols * asked.rows * 8
	for i: int in asked.times_s.size():
		var part := all.slice(i * step, (i + 1) * step)
		var image := Image.create_from_data(asked.cols, asked.rows, false, Image.FORMAT_RGF, part)
		material.set_shader_parameter("points", ImageTexture.create_from_image(image))
		sea.bring_to(material, asked.times_s[i])
		view.render_target_update_mode = SubViewport.UPDATE_ONCE
		await RenderingServer.frame_post_draw
		var drawn := view.get_texture().get_image()
		drawn.convert(Image.FORMAT_RGB8)
		window.tell("answer", Marshalls.raw_to_base64(drawn.get_data()))
	window.tell("done", "yes")
