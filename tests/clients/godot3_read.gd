# Run by Godot 3: what it makes of pictures and raw height maps, as bytes in its own order of rows.
# godot3-server --path FOLDER -s godot3_read.gd OUT FILE …; EXR comes out as half floats, .r16 as its 16-bit words.
extends SceneTree

func _init():
	var paths = []
	for word in OS.get_cmdline_args():
		if word.begins_with("/"):
			paths.append(word)
	var out = paths.pop_front()
	for path in paths:
		var file = File.new()
		if file.open(out + "/" + path.get_file() + ".bin", File.WRITE) != OK:
			quit(1)
		if path.get_extension() == "exr":
			var image = Image.new()
			if image.load(path) != OK:
				quit(1)
			print(path.get_file(), " ", image.get_width(), " ", image.get_height(), " ", image.get_format())
			file.store_buffer(image.get_data())
		else:
			var words = File.new()
			if words.open(path, File.READ) != OK:
				quit(1)
			for _at in range(words.get_len() / 2):
				file.store_16(words.get_16())
			words.close()
		file.close()
	quit()
