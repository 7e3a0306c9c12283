"""What a picture takes of the GPU, told by target."""

from scenes import SIZE, camera, coast
from shorewright.renderer.memory import gpu_memory
from shorewright.renderer.targets import GBUFFER, UNDER

COMPONENT_BYTES = {"f1": 1, "f2": 2, "f4": 4}


def test_targets_are_counted_by_their_format(renderer):
    renderer.draw(coast(), camera(), SIZE)
    held = {row.name: row.bytes for row in gpu_memory(renderer) if row.kind == "target"}
    pixels = SIZE[0] * SIZE[1]
    for name, (components, dtype) in GBUFFER.items():
        assert held[name] == pixels * components * COMPONENT_BYTES[dtype]
    assert {name.replace("g_", "under_") for name in UNDER} | {"hdr", "picture", "display", "depth"} <= set(held)


def test_twice_the_sides_take_four_times_the_bytes(renderer):
    def target_bytes(scale):
        renderer.draw(coast(), camera(), (SIZE[0] * scale, SIZE[1] * scale))
        return sum(row.bytes for row in gpu_memory(renderer) if row.kind == "target")

    assert target_bytes(2) == 4 * target_bytes(1)
