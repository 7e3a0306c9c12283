"""Run by Blender: what it makes of GLB files and pictures, in its own axes and its own order of rows, as raw float32.

blender -b --factory-startup -P blender_read.py -- OUT FILE …
Of each mesh `OUT/FILE/MESH.ARRAY.f32`, a row a corner of a triangle; of each picture `OUT/FILE.f32`, four channels.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

np.bool = bool  # Debian's numpy has dropped what Blender 3.4's reader of glTF asks for


def read_mesh(thing):
    """Arrays by name of an object's mesh, placed in the world."""
    mesh = thing.data
    mesh.calc_loop_triangles()
    loops = len(mesh.loops)
    at = filled(mesh.loop_triangles, "loops", len(mesh.loop_triangles) * 3, dtype=np.int32)
    vertex_of = filled(mesh.loops, "vertex_index", loops, dtype=np.int32)[at]
    matrix = np.array(thing.matrix_world)
    vertices = filled(mesh.vertices, "co", len(mesh.vertices), 3)
    found = {"positions": (vertices @ matrix[:3, :3].T + matrix[:3, 3])[vertex_of]}
    found["uv"] = filled(mesh.uv_layers[0].data, "uv", loops, 2)[at]
    if mesh.color_attributes:
        colours = mesh.color_attributes[0]
        values = filled(colours.data, "color", len(colours.data), 4)
        found["colours"] = values[at if colours.domain == "CORNER" else vertex_of]
    mesh.calc_normals_split()
    found["normals"] = filled(mesh.loops, "normal", loops, 3)[at] @ matrix[:3, :3].T
    mesh.calc_tangents()  # its own, by MikkTSpace from the UVs: it passes over those of the file
    found["tangents"] = filled(mesh.loops, "tangent", loops, 3)[at] @ matrix[:3, :3].T
    return found


def filled(rows, name, count, width=1, dtype=np.float32):
    values = np.empty(count * width, dtype)
    rows.foreach_get(name, values)
    return values.reshape(count, width) if width > 1 else values


def read_picture(path):
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    values = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(values)
    return values


out, *paths = map(Path, sys.argv[sys.argv.index("--") + 1 :])
for path in paths:
    if path.suffix != ".glb":
        read_picture(path).tofile(out / f"{path.name}.f32")
        continue
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    (out / path.name).mkdir()
    for thing in bpy.data.objects:
        if thing.type == "MESH":
            for name, values in read_mesh(thing).items():
                values.astype("<f4").tofile(out / path.name / f"{thing.name}.{name}.f32")
