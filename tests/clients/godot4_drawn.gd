extends Node
## The project's own scene from straight above, at two times.


func _ready() -> void:
	var level: Node3D = load("res://main.tscn").instantiate()
	add_child(level)
	var eye: Camera3D = level.get_node("Eye")
	eye.position = Vector3(level.size_m.x / 2, 120, level.size_m.y / 2)
	eye.rotation_degrees = Vector3(-90, 0, 0)
	eye.fov = 50
	var window := JavaScriptBridge.get_interface("window")
	for time_s: float in [3.0, 4.5]:
		level.time_s = time_s
		for i in 3:
			await RenderingServer.frame_post_draw
		var image := get_viewport().get_texture().get_image()
		window.tell("picture", Marshalls.raw_to_base64(image.save_png_to_buffer()))
	window.tell("done", "yes")
