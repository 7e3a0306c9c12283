"""What the window adds to a session: messages, overlays, quality, camera flights, requests that ask the person.

No imgui here: panels read it and call it, tests can too.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..level import BadInput
from ..level.objects import Camera
from ..level.sun import light_angles
from ..renderer.show import Inset, Overlays
from .action import Action
from .actions import ACTIONS
from .arrival_lender import ArrivalLender
from .camera_control import between
from .front_drag import FrontDrag
from .front_view import LAYERS, FrontView
from .messages import Messages
from .preferences import Preferences
from .probe import Probe, probe
from .session import Session
from .shaping_lender import ShapingLender
from .streamlines import StreamlineView

log = logging.getLogger(__name__)
GLIDE_S = 0.28
SUN_DEG_PER_PX = 0.3
FORCE_INSET = Inset("force", heading=True)
WEATHER_INSET = Inset("weather_map", "lower-left", 0.34)  # Z04
INSETS = {"force_inset": FORCE_INSET, "weather_inset": WEATHER_INSET}  # requests that switch one on or off
OVERLAYS = ("walkable", "outline", "centre", "arrows", "streamlines")
FRONTS = {f"front_{name}": name for name in LAYERS}  # requests, and the overlay that they switch
QUALITIES = ("low", "medium", "high")
TOLD = {"undo": "Undone: {}", "redo": "Redone: {}"}
WHILE_STROKING = {"abort", "undo", "pause", "step", "step_back", "water"}  # other actions wait for the release


@dataclass
class Glide:
    """A flight of the camera that started at a moment (monotonic seconds)."""

    start: Camera
    end: Camera
    at: float

    def camera(self, now: float) -> Camera:
        return between(self.start, self.end, (now - self.at) / GLIDE_S)

    def over(self, now: float) -> bool:
        return now - self.at >= GLIDE_S


class Editor:
    """The window's state round one `Session`, which can be replaced by another (`show_session`)."""

    def __init__(self, session: Session, preferences: Preferences | None = None, save_to: Path | None = None) -> None:
        self.session = session
        self.preferences = preferences or Preferences()
        self.save_to = save_to  # where the preferences go; None for their usual place
        self.messages = Messages()
        self.quality = self.preferences.quality
        self.walkable = False  # overlays (D31, D40)
        self.outline = False
        self.centre = False
        self.arrows = self.streamlines = False  # T02
        self.currents = StreamlineView()
        self.insets: tuple[Inset, ...] = ()  # T12
        self.fronts = FrontView()  # T06
        self.typing = False  # a text field has the keyboard
        self.map_pointer: tuple[float, float, float] | None = None  # the sky over what the weather panel points at
        self.flying = False  # the right button is held: letters steer
        self.shall_exit = False
        self.asked: list[str] = []  # requests for dialogs, oldest first
        self.picture_stats = ""
        self.arrivals = ArrivalLender()  # when waves come, worked out beside the window (T06)
        self.arrivals_seen = 0  # how often a newer map came
        self.shapings = ShapingLender()  # beds under a front in the hand, likewise (T07)
        session.level.solver = self.arrivals
        self._glide: Glide | None = None
        self._last = time.monotonic()
        self._probed: tuple[Any, Probe | None] = (None, None)

    # The session

    def show_session(self, session: Session) -> None:
        """Edit another level from now on; the one before is closed."""
        before, self.session = self.session, session
        self._glide = None
        if before is not session:
            before.close()
            before.level.solver = None
            self.arrivals.forget()
            self.shapings.forget()
            session.level.solver = self.arrivals
        if session.recovery is None:
            session.keep_log()
        if session.path:
            self.remember(session.path)

    def remember(self, path: Path) -> None:
        """Put a level in front of the recent ones."""
        self.preferences.remember(path)
        self.preferences.save(self.save_to)

    def attempt(self, work: Callable, *args: Any, **named: Any) -> Any:
        """Call something that may find its input bad; then the sentence is told and None returned."""
        try:
            return work(*args, **named)
        except (BadInput, OSError) as error:
            self.messages.warn(str(error))
            return None

    def set(self, path: str, value: Any, merge: bool = False) -> None:
        """Change a level setting as panels do."""
        self.attempt(self.session.set, path, value, merge)

    def turn_sun(self, dx_px: float, dy_px: float) -> None:
        """Turn and lift the sun by a pointer's way; one step until `session.seal`."""
        azimuth, elevation = light_angles(self.session.level.settings.light, self.session.clock.time_s)
        values = {
            "light.sun_from": "angles",
            "light.sun_azimuth_deg": (azimuth + SUN_DEG_PER_PX * dx_px) % 360,
            "light.sun_elevation_deg": min(max(elevation - 0.6 * SUN_DEG_PER_PX * dy_px, -20.0), 90.0),
        }
        self.attempt(self.session.set_all, "Turn the sun", values, True)

    def do(self, name: str | Action) -> None:
        """Run a row of ACTIONS, unless it has nothing to do now."""
        action = ACTIONS[name] if isinstance(name, str) else name
        session = self.session
        if self.settling and action.id not in WHILE_STROKING:
            self.attempt(session.stroke_end)
        if not action.enabled(session) or (session.stroke and action.id not in WHILE_STROKING):
            return
        camera = session.camera
        label = self.attempt(action.run, session)
        if session.camera != camera:
            self.fly_to(session.camera, camera)
        if action.id in TOLD and label:
            self.messages.tell(TOLD[action.id].format(label))
        if action.id == "save" and session.path and not session.dirty:
            self.saved(session.path)

    def saved(self, path: Path) -> None:
        self.messages.tell(f"Saved {path.name}")
        self.remember(path)

    # Once a frame

    def tick(self) -> None:
        """Let time pass: the clock, a camera's flight, what the session wants told and asked."""
        now = time.monotonic()
        self.session.advance(min(now - self._last, 0.5))
        self._last = now
        if self._glide:
            self.session.camera = self._glide.camera(now)
            self._glide = None if self._glide.over(now) else self._glide
        if self.arrivals.look():
            self.arrivals_seen += 1
            if self.arrivals.failure:
                self.messages.warn(self.arrivals.failure)
        self._settled(self.attempt(self.session.front_take))
        while self.session.notes:
            self.messages.tell(self.session.notes.pop(0))
        while self.session.requests:
            self._request(self.session.requests.popleft())

    @property
    def settling(self) -> bool:
        """Whether a front was let go whose bed is still on its way."""
        return isinstance(self.session.stroke, FrontDrag) and self.session.stroke.settling

    def _settled(self, front: FrontDrag | None) -> None:
        """Tell what the limits forbade."""
        for short in front.shaped.forbidden[:1] if front and front.shaped else ():
            self.messages.tell(f"The crest is {short.text}")

    def _request(self, request: str) -> None:
        if request in INSETS:
            others = tuple(inset for inset in self.insets if inset != INSETS[request])
            self.insets = others if others != self.insets else (*others, INSETS[request])
        elif request in FRONTS:
            self.fronts.toggle(FRONTS[request])
        elif request in OVERLAYS:
            setattr(self, request, not getattr(self, request))
        else:
            self.asked.append(request)

    # Looking

    def fly_to(self, end: Camera, start: Camera | None = None) -> None:
        """Glide to a camera from where the view is now."""
        start = start or self.session.camera
        self.session.camera = start
        self._glide = Glide(start, end, time.monotonic())

    def move_camera(self, camera: Camera) -> None:
        """Take the camera by hand; a flight ends."""
        self._glide = None
        self.session.camera = camera

    def choose_quality(self, quality: str) -> None:
        """Draw in another tier, now and next time."""
        self.quality = self.preferences.quality = quality

    @property
    def gliding(self) -> bool:
        return self._glide is not None

    @property
    def overlays(self) -> Overlays:
        fronts = self.fronts.lines(self.session)
        return Overlays(
            walkable=self.walkable, outline=self.outline, centre=self.centre, arrows=self.arrows, insets=self.insets,
            fronts=fronts, streamlines=self.currents.lines(self.session.level) if self.streamlines else None,
        )  # fmt: skip

    @property
    def live(self) -> bool:
        """Whether the picture changes by itself."""
        clock = self.session.clock
        return (not clock.paused and clock.rate != 0) or self.gliding

    def probe(self) -> Probe | None:
        """What is under the pointer, worked out once for a place and a state of the level."""
        cursor, level = self.session.cursor, self.session.level
        if cursor is None:
            return None
        time_s = self.session.clock.time_s if level.settings.tide.on else 0.0
        key = (cursor[:2], id(level), level.revision, time_s)
        if self._probed[0] != key:
            self._probed = key, probe(level, *cursor[:2], time_s)
        return self._probed[1]
