"""Shortcuts: the keys of ACTIONS as imgui chords, and which action a frame's key presses mean."""

from __future__ import annotations

from imgui_bundle import imgui

from .action import Action
from .actions import ACTIONS

MODIFIERS = {"Ctrl": imgui.Key.mod_ctrl, "Shift": imgui.Key.mod_shift, "Alt": imgui.Key.mod_alt}
NAMED = {
    "Space": imgui.Key.space, "Escape": imgui.Key.escape, ".": imgui.Key.period, ",": imgui.Key.comma,
    "[": imgui.Key.left_bracket, "]": imgui.Key.right_bracket, "Home": imgui.Key.home, "Delete": imgui.Key.delete,
    "-": imgui.Key.minus, "=": imgui.Key.equal, "Tab": imgui.Key.tab, "Enter": imgui.Key.enter,
}  # fmt: skip
SHIFTED = {"{": "[", "}": "]"}  # as printed on a US keyboard
TYPED = frozenset("[]{}.,")  # found by the character too, as other keyboards have them elsewhere
PRINTED = {"Escape": "Esc"}


def chord(keys: str) -> int:
    """`Ctrl+Shift+Z` as imgui's number; ValueError for a key nobody has."""
    *modifiers, name = keys.split("+") if keys != "+" else ["+"]
    total = 0
    for modifier in modifiers:
        if modifier not in MODIFIERS:
            raise ValueError(f"{keys}: {modifier} is no modifier")
        total |= int(MODIFIERS[modifier])
    if name in SHIFTED:
        total |= int(imgui.Key.mod_shift)
        name = SHIFTED[name]
    return total | int(_key(name, keys))


def _key(name: str, keys: str) -> imgui.Key:
    key = NAMED.get(name)
    if key is None and len(name) == 1 and name.isdigit():
        key = getattr(imgui.Key, f"_{name}", None)
    if key is None and len(name) <= 3:
        key = getattr(imgui.Key, name.lower(), None)
    if key is None:
        raise ValueError(f"{keys}: no key is called {name}")
    return key


CHORDS: dict[str, int] = {keys: chord(keys) for action in ACTIONS.values() for keys in action.keys}


def pressed() -> list[Action]:
    """The actions whose keys went down in this frame, in table order."""
    typed = {chr(code) for code in imgui.get_io().input_queue_characters if code < 0x110000}
    hit = []
    for action in ACTIONS.values():
        for keys in action.keys:
            by_chord = imgui.is_key_chord_pressed(CHORDS[keys]) if not action.repeats else _repeating(CHORDS[keys])
            if by_chord or (keys in TYPED and keys in typed):
                hit.append(action)
                break
    return hit


def _repeating(keys: int) -> bool:
    return imgui.internal.is_key_chord_pressed(keys, int(imgui.InputFlags_.repeat), 0)


def shown(action: Action) -> str:
    """The first of an action's keys as menus print it."""
    return PRINTED.get(action.keys[0], action.keys[0]) if action.keys else ""
