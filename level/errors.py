"""The one error a person sees: what is wrong, where, and what to do about it, in a sentence."""


class BadInput(ValueError):  # noqa: N818 - it names what the user gave, not a fault of the program
    """Something the user gave cannot be used; `str(error)` is one clear sentence and the command line exits with 2."""
