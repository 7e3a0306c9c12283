"""What the editor asks in the middle of the window, one question at a time: files, unsaved changes, recovery."""

from __future__ import annotations

import logging

from imgui_bundle import imgui

from ..level import BadInput
from . import theme
from .background import Background
from .editor import Editor
from .file_forms import WIDE, Form, OpenForm, open_level
from .forms import FORMS
from .recovery_offer import Offer, offers
from .session import Session

log = logging.getLogger(__name__)


class Ask(Form):
    """A question with a sentence and a few answers; `choose` is called with the one that was clicked."""

    def __init__(self, editor: Editor, title: str, text: str, answers: tuple[str, ...], choose) -> None:
        super().__init__(editor)
        self.title, self.text, self.answers, self.choose = title, text, answers, choose


class Dialogs:
    """Takes the editor's requests in turn; `draw` it once a frame, outside every other window."""

    def __init__(self, editor: Editor) -> None:
        self.editor = editor
        self.form: Form | None = None
        self.waiting: list[Form] = []
        self.error = ""
        self._working = False
        self._opened = False

    @property
    def open(self) -> bool:
        return self.form is not None

    def show(self, form: Form) -> None:
        """Ask this now, or after the present question."""
        if self.form is None:
            self.form, self.error, self._opened, self._working = form, "", False, False
        else:
            self.waiting.append(form)

    def close(self) -> None:
        self.form = None
        if self.waiting:
            self.show(self.waiting.pop(0))

    # Requests

    def take(self) -> None:
        """Turn the oldest request into a form."""
        if self.form is not None or not self.editor.asked:
            return
        request = self.editor.asked.pop(0)
        if request == "quit":
            self._or_save_first("Quit", self._quit)
        elif request.startswith("open:"):
            form = OpenForm(self.editor, request[5:])
            self._or_save_first("Open another level", lambda: self._run_now(form))
        elif request in FORMS:
            form = FORMS[request]
            if form.replaces:
                self._or_save_first(form.title, lambda: self.show(form(self.editor)))
            else:
                self.show(form(self.editor))
        else:
            log.warning("nothing answers the request %r", request)

    def _run_now(self, form: OpenForm) -> None:
        self.editor.attempt(open_level, self.editor, form.field.path)

    def _quit(self) -> None:
        self.editor.shall_exit = True

    def _or_save_first(self, title: str, go_on) -> None:
        """Ask about unsaved changes before they would be lost."""
        session = self.editor.session
        touched = session.journal.done or session.journal.undone or session.path
        if not session.dirty or not touched:
            go_on()
            return
        name = session.path.name if session.path else "This level"

        def choose(answer: str) -> None:
            if answer == "Save" and session.path is None:
                self.show(FORMS["save_as"](self.editor))
            elif answer == "Save":
                if self.editor.attempt(session.save):
                    self.editor.saved(session.path)
                    go_on()
            elif answer == "Don't save":
                go_on()

        text = f"{name} has changes that are not saved."
        self.show(Ask(self.editor, title, text, ("Save", "Don't save", "Cancel"), choose))

    def offer_recovery(self, root=None) -> None:
        """Ask about every level that an editor left behind when it was killed."""
        for offer in offers(root):
            self.show(self._recovery(offer))

    def _recovery(self, offer: Offer) -> Ask:
        def choose(answer: str) -> None:
            if answer == "Restore":
                made = self.editor.attempt(self._recovered, offer)
                if made:
                    self.editor.show_session(made)
                    self.editor.messages.tell("Restored; it isn't saved yet")
            elif answer == "Throw away":
                offer.discard()

        steps = ", ".join(offer.labels[-6:])
        text = f"{offer.sentence}\nLast: {steps}" if steps else offer.sentence
        return Ask(self.editor, "Restore your work?", text, ("Restore", "Throw away", "Later"), choose)

    def _recovered(self, offer: Offer) -> Session | None:
        held = self.editor.session
        if offer.folder and held.path and held.path.resolve() == offer.folder.resolve() and not held.dirty:
            held.close()  # it holds the lock of the very folder that is offered
        return Session.recover(offer)

    # Drawing

    def draw(self) -> None:
        self.take()
        form = self.form
        if form is None:
            return
        name = f"{form.title}###dialog"
        if not self._opened:
            imgui.open_popup(name)
            self._opened = True
        viewport = imgui.get_main_viewport()
        imgui.set_next_window_pos(viewport.get_center(), imgui.Cond_.appearing, imgui.ImVec2(0.5, 0.45))
        flags = imgui.WindowFlags_.always_auto_resize | imgui.WindowFlags_.no_saved_settings
        if not imgui.begin_popup_modal(name, None, flags)[0]:
            self.close()
            return
        self._ask(form) if isinstance(form, Ask) else self._form(form)
        imgui.end_popup()

    def _done(self) -> None:
        imgui.close_current_popup()
        self.close()

    def _ask(self, form: Ask) -> None:
        imgui.push_text_wrap_pos(WIDE)
        imgui.text_unformatted(form.text)
        imgui.pop_text_wrap_pos()
        imgui.dummy(imgui.ImVec2(WIDE, 4))
        chosen = form.answers[-1] if imgui.is_key_pressed(imgui.Key.escape) else None
        for number, answer in enumerate(form.answers):
            if number:
                imgui.same_line()
            if _button(answer, number == 0) or (number == 0 and imgui.is_key_pressed(imgui.Key.enter)):
                chosen = answer
        if chosen:
            self._done()
            form.choose(chosen)

    def _form(self, form: Form) -> None:
        imgui.dummy(imgui.ImVec2(WIDE, 2))
        if form.background is not None:
            self._wait(form, form.background)
            return
        form.draw()
        if self.error:
            imgui.push_text_wrap_pos(WIDE)
            imgui.text_colored(theme.colour(theme.WARM), self.error)
            imgui.pop_text_wrap_pos()
        imgui.dummy(imgui.ImVec2(WIDE, 4))
        if self._working:  # the word was on the screen for a frame
            self._working = False
            self._run(form)
            return
        sure = imgui.is_key_pressed(imgui.Key.enter) or imgui.is_key_pressed(imgui.Key.keypad_enter)
        if _button(form.confirm, True) or sure:
            self._working, self.error = True, ""
        imgui.same_line()
        if _button("Cancel", False) or (imgui.is_key_pressed(imgui.Key.escape) and not form.takes_escape):
            self._done()
        elif self._working:
            imgui.same_line()
            imgui.text_colored(theme.colour(theme.INK_FAINT), "Working…")

    def _run(self, form: Form) -> None:
        try:
            form.run()
        except (BadInput, OSError) as error:
            self.error = str(error)
            return
        if form.background is None:
            self._done()

    def _wait(self, form: Form, work: Background) -> None:
        """How far work beside the window is, and a way to stop it; its end closes the dialog, its error stays in it."""
        done = work.done
        imgui.progress_bar(work.share, imgui.ImVec2(WIDE, 0), f"{100 * work.share:.0f} %")
        imgui.text_colored(theme.colour(theme.INK_FAINT), "Stopping…" if work.cancelled else work.sentence)
        imgui.dummy(imgui.ImVec2(WIDE, 4))
        if _button("Cancel", False) or imgui.is_key_pressed(imgui.Key.escape):
            work.cancel()
        if not done:
            return
        form.background = None
        try:
            form.finish(work.result())
        except (BadInput, OSError) as error:
            self.error = str(error)
            return
        self._done()


def _button(label: str, first: bool) -> bool:
    if first:
        imgui.push_style_color(imgui.Col_.button, theme.colour(theme.ACCENT_DEEP))
    clicked = imgui.button(label, imgui.ImVec2(max(imgui.calc_text_size(label).x + 28, 92), 0))
    if first:
        imgui.pop_style_color()
    return clicked
