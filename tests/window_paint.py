"""Works the paint brush in the real window: layer, mode, an alpha from a file, a limit; see window_drive.py."""

import sys
from pathlib import Path

import numpy as np
import window_drive
from shorewright.io.images import write_image
from shorewright.level.params import row
from window_drive import Hands, imgui


def paint(hands: Hands) -> None:
    """Take the brush, choose layer and mode in its panel, a shape from a file and a limit, and paint."""
    ctx, session = hands.ctx, hands.session
    session.pause()
    hands.editor.choose_quality("low")
    ctx.yield_(3)
    hands.until(lambda: session.brush == "paint", lambda: ctx.item_click("//Brushes/###paint"))
    _choose(hands, "onto", "shelter")
    _choose(hands, "mode", "set")
    hands.note(brush=session.brush, onto=_params(session).onto, mode=_params(session).mode)
    _limit(hands)
    _alpha(hands)
    hands.until(lambda: session.level.layers["shelter"].array.any(),
                lambda: hands.drag((0.4, 0.45), (0.5, 0.5), (0.6, 0.6)))  # fmt: skip
    paint_there = session.level.layers["shelter"].array
    hands.note(
        steps=[step.label for step in session.journal.done],
        lowest=float(session.level.height[paint_there > 0].min(initial=99.0)), painted=int((paint_there > 0).sum()),
        bad=[line.text for line in hands.editor.messages.lines if line.bad],
    )  # fmt: skip


def _params(session):
    return session.params["paint"]


def _choose(hands: Hands, name: str, choice: str) -> None:
    """An entry of a parameter's list; imgui numbers them."""
    number = row(type(_params(hands.session)), name).choices.index(choice)

    def by_hand() -> None:
        hands.ctx.item_click(f"//Brush/{name}/##value")
        hands.ctx.item_click(f"//$FOCUSED/$${number}/{choice}")

    hands.until(lambda: getattr(_params(hands.session), name) == choice, by_hand)


def _limit(hands: Hands) -> None:
    """Only above the sea: a limit by height from its list, its ends typed."""
    ctx, session = hands.ctx, hands.session

    def add() -> None:
        ctx.item_click("//Brush/###limit_new")
        ctx.item_click("//$FOCUSED/###limit_height_m")

    hands.until(lambda: _params(session).only_where, add)
    hands.note(added=_params(session).only_where)
    for name, text in (("low", "-0.2"), ("high", ""), ("soft", "")):

        def put(name=name, text=text) -> None:
            ctx.item_click(f"//Brush/limit_0/###limit_{name}")
            ctx.key_press(int(window_drive.CTRL) | int(imgui.Key.a))
            ctx.key_press(int(imgui.Key.delete))
            ctx.key_chars(text)
            ctx.key_press(int(imgui.Key.enter))

        hands.until(lambda: False, put, tries=1)
    hands.note(limit=_params(session).only_where)


def _alpha(hands: Hands) -> None:
    """A picture by the form that asks for a file."""
    ctx, session = hands.ctx, hands.session
    path = Path(sys.argv[3]).with_name("ring.png")
    away = np.hypot(*(np.mgrid[:64, :64] - 31.5))
    write_image(path, np.where((away > 15) & (away < 30), 255, 0).astype(np.uint8))

    def by_hand() -> None:
        ctx.item_click("//Brush/###alpha")
        ctx.yield_(3)
        ctx.item_click("//$FOCUSED/###open_path")
        ctx.key_chars_replace(str(path))
        ctx.key_press(int(imgui.Key.enter))
        ctx.yield_(6)

    hands.until(lambda: _params(session).alpha, by_hand, tries=2)
    hands.note(alpha=_params(session).alpha.partition(" ")[0])


if __name__ == "__main__":
    window_drive.main(globals())
