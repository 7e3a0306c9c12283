extends Camera3D
## Flies: right mouse button to look, W A S D and Q E to go, Shift faster.

@export var speed_mps := 12.0
@export var look_deg_per_pixel := 0.2


func _unhandled_input(event: InputEvent) -> void:
	if event is InputEventMouseMotion and Input.is_mouse_button_pressed(MOUSE_BUTTON_RIGHT):
		rotation_degrees.y -= event.relative.x * look_deg_per_pixel
		rotation_degrees.x = clampf(rotation_degrees.x - event.relative.y * look_deg_per_pixel, -89, 89)


func _process(delta: float) -> void:
	var way := Vector3(
		_held(KEY_D) - _held(KEY_A), _held(KEY_E) - _held(KEY_Q), _held(KEY_S) - _held(KEY_W)
	)
	var pace := speed_mps * (8.0 if Input.is_key_pressed(KEY_SHIFT) else 1.0)
	translate(way.normalized() * pace * delta)


func _held(key: Key) -> float:
	return float(Input.is_key_pressed(key))
