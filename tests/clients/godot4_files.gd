extends Node
## Reads what was exported with Godot's own readers and tells what stands at the places that were asked for.


func _ready() -> void:
	var asked: Dictionary = JSON.parse_string(FileAccess.get_file_as_string("res://asked.json"))
	var found := {"words": words(asked), "pictures": pictures(asked), "meshes": meshes(asked)}
	var window := JavaScriptBridge.get_interface("window")
	window.tell("found", JSON.stringify(found, "", false, true))
	window.tell("done", "yes")


## Heights by the formula of Terrain3D and HTerrain, at (column, row).
func words(asked: Dictionary) -> Array:
	var file := FileAccess.open("res://" + asked.words.name, FileAccess.READ)
	var found := []
	for place: Array in asked.words.places:
		file.seek(2 * (int(place[1]) * int(asked.words.cols) + int(place[0])))
		found.append(file.get_16() / 65535.0 * (asked.words.max_m - asked.words.min_m) + asked.words.min_m)
	return found


## Size and colours of pictures, 0 … 255, at (column, row).
func pictures(asked: Dictionary) -> Dictionary:
	var found := {}
	for name: String in asked.pictures:
		var image := Image.new()
		image.load_png_from_buffer(FileAccess.get_file_as_bytes("res://" + name))
		var colours := []
		for place: Array in asked.pictures[name]:
			var colour := image.get_pixel(place[0], place[1])
			colours.append([colour.r8, colour.g8, colour.b8])
		found[name] = {"size": [image.get_width(), image.get_height()], "colours": colours}
	return found


## Of each scene: names, boxes, arrays, and how high the meshes that reach there are at (x, z).
func meshes(asked: Dictionary) -> Dictionary:
	var found := {}
	for name: String in asked.meshes:
		var document := GLTFDocument.new()
		var state := GLTFState.new()
		var fault := document.append_from_buffer(FileAccess.get_file_as_bytes("res://" + name), "", state)
		var scene := document.generate_scene(state)
		add_child(scene)
		var told := []
		for one: Node in scene.find_children("*", "MeshInstance3D", true, false):
			told.append(_mesh(one, asked.meshes[name]))
		found[name] = {"fault": fault, "meshes": told}
		scene.queue_free()
	return found


func _mesh(one: MeshInstance3D, places: Array) -> Dictionary:
	var arrays := one.mesh.surface_get_arrays(0)
	var heights := {}
	for point: Vector3 in arrays[Mesh.ARRAY_VERTEX]:
		var world := one.global_transform * point
		for i in places.size():
			if absf(world.x - places[i][0]) < 0.01 and absf(world.z - places[i][1]) < 0.01:
				heights[i] = maxf(world.y, heights.get(i, -1e9))
	var has := []
	for kind: int in [Mesh.ARRAY_NORMAL, Mesh.ARRAY_TANGENT, Mesh.ARRAY_COLOR, Mesh.ARRAY_TEX_UV]:
		has.append(arrays[kind] != null)
	return {
		"name": one.name, "vertices": arrays[Mesh.ARRAY_VERTEX].size(), "has": has, "heights": heights,
		"up": arrays[Mesh.ARRAY_NORMAL][0].y,
	}
