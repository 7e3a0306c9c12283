extends RefCounted
## A flat mesh whose cells double in size from ring to ring, without cracks: land and sea are both drawn on it.

const HALF := 96 ## cells from the middle to a ring's edge
const RINGS := 6
const FAR_M := 12000.0


## Two of the largest cells: the mesh moves in such steps, so that no vertex ever leaves its place.
static func step_m(fine_m: float) -> float:
	return fine_m * 2.0 ** RINGS


## The mesh, whose smallest cells are `fine_m` wide; `coarse` leaves out vertices, for slow machines.
static func build(fine_m: float, coarse: int = 1) -> ArrayMesh:
	var half := HALF / coarse
	var places := PackedVector3Array()
	var corners := PackedInt32Array()
	for ring in RINGS:
		_ring(places, corners, half, fine_m * coarse * 2.0 ** ring, ring > 0)
	_skirt(places, corners, half, fine_m * coarse * 2.0 ** (RINGS - 1))
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = places
	arrays[Mesh.ARRAY_INDEX] = corners
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	mesh.custom_aabb = AABB(Vector3(-FAR_M, -1000, -FAR_M), Vector3(2 * FAR_M, 2000, 2 * FAR_M))
	return mesh


static func _ring(places: PackedVector3Array, corners: PackedInt32Array, half: int, cell_m: float, open: bool) -> void:
	var first := places.size()
	var side := 2 * half + 1
	for row in range(-half, half + 1):
		for col in range(-half, half + 1):
			# on the outer edge every second vertex lies on its neighbour: the next ring has none there
			var x := col - posmod(col, 2) * int(absi(row) == half)
			var z := row - posmod(row, 2) * int(absi(col) == half)
			places.append(Vector3(x * cell_m, 0, z * cell_m))
	for row in range(-half, half):
		for col in range(-half, half):
			if open and maxi(maxi(-row - 1, row), maxi(-col - 1, col)) < half / 2:
				continue
			var at := first + (row + half) * side + col + half
			corners.append_array([at, at + 1, at + side, at + 1, at + side + 1, at + side])


static func _skirt(places: PackedVector3Array, corners: PackedInt32Array, half: int, cell_m: float) -> void:
	var rim := []
	for i in range(-half, half, 2):
		rim.append(Vector2(i, -half))
	for i in range(-half, half, 2):
		rim.append(Vector2(half, i))
	for i in range(half, -half, -2):
		rim.append(Vector2(i, half))
	for i in range(half, -half, -2):
		rim.append(Vector2(-half, i))
	var first := places.size()
	for place: Vector2 in rim:
		var near := place * cell_m
		var far := near.normalized() * FAR_M
		places.append_array([Vector3(near.x, 0, near.y), Vector3(far.x, 0, far.y)])
	var count := 2 * rim.size()
	for i in range(0, count, 2):
		var next := (i + 2) % count
		corners.append_array([first + i, first + i + 1, first + next])
		corners.append_array([first + next, first + i + 1, first + next + 1])
