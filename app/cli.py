"""The command line: VERBS, how one is found, and what becomes of its errors.

Exit codes: 0 done, 1 checked and found wanting, 2 bad input (one sentence on stderr, nothing written), 130 interrupted.
A fault of the program itself is the only thing that shows a traceback. A verb's module is imported when it is asked
for, so that tables answer at once.
"""

from __future__ import annotations

import logging
import os
import sys

import cyclopts

from ..level.errors import BadInput

_HERE = "shorewright.app.commands"

# name: module:function, in the order of the help page
VERBS: dict[str, str] = {
    "edit": "editor:edit",
    "new": "levels:new",
    "resize": "levels:resize",
    "crop": "levels:crop",
    "place": "props:place",
    "shot": "shots:app",
    "info": "levels:info",
    "render": "pictures:render",
    "sheet": "sheets:sheet",
    "weather": "weather:app",
    "timing": "timing:timing",
    "stroke": "scripts:stroke",
    "export": "exports:export",
    "check": "exports:check",
    "lint": "lints:lint",
    "views": "tables:views",
    "brushes": "tables:brushes",
    "layers": "tables:layers",
    "settings": "tables:settings",
    "environments": "tables:environments",
    "weathers": "tables:weathers",
    "bench": "benches:bench",
}


def application() -> cyclopts.App:
    """The cyclopts application, its verbs still unloaded."""
    from .. import __version__

    app = cyclopts.App(
        name="shorewright",
        help="Sculpt the coast while the sea runs.",
        version=__version__,
        result_action="return_value",
        help_format="plaintext",
        help_formatter="plain",
    )
    for number, (name, place) in enumerate(VERBS.items()):
        app.command(f"{_HERE}.{place}", name=name, sort_key=number)
    return app


def main(argv: list[str] | None = None) -> int:
    """Run one command line, without the program's name, and return its exit code."""
    argv = list(sys.argv[1:] if argv is None else argv)
    logging.basicConfig(level=os.environ.get("SHOREWRIGHT_LOG", "WARNING").upper(), format="%(levelname)s: %(message)s")
    try:
        app = application()
        if not argv or argv[0] in ("--help", "-h"):  # the page shows the first sentence of every verb
            for verb in VERBS:
                app[verb]
        code = app(argv, exit_on_error=False, print_error=False)
        sys.stdout.flush()
        return code if isinstance(code, int) else 0
    except BadInput as error:
        return _refuse(str(error))
    except cyclopts.CycloptsError as error:
        return _refuse(_usage(error, argv))
    except BrokenPipeError:  # `shorewright settings | head`
        sys.stdout = open(os.devnull, "w")  # noqa: SIM115 - so that the flush at exit finds nobody offended
        return 0
    except OSError as error:
        name = f"{error.filename}: " if error.filename else ""
        return _refuse(f"{name}{error.strerror or error}")
    except MemoryError:
        return _refuse("there is not enough memory for this")
    except KeyboardInterrupt:
        return 130


def _refuse(sentence: str) -> int:
    """One line on stderr."""
    sys.stderr.write(f"shorewright: {' '.join(sentence.split())}\n")
    return 2


def _usage(error: cyclopts.CycloptsError, argv: list[str]) -> str:
    """What is wrong with a command line, and where to read on."""
    verb = argv[0] if argv and argv[0] in VERBS else ""
    if VERBS.get(verb, "").endswith(":app"):  # words under a word
        verb = " ".join(word for word in argv[:2] if not word.startswith("-"))
    help_page = f"`shorewright {verb} --help`" if verb else "`shorewright --help`"
    if isinstance(error, cyclopts.UnusedCliTokensError):
        told = f"{verb} does not take {' '.join(error.unused_tokens or [])}"
    elif isinstance(error, cyclopts.UnknownCommandError):
        told, help_page = f"there is no command {(verb or argv[0])!r}", f"`shorewright {argv[0]} --help`"
        help_page = help_page if argv[0] in VERBS else "`shorewright --help`"
    elif isinstance(error, cyclopts.MissingArgumentError) and error.argument is not None:
        told = _missing(error.argument, verb, argv)
    else:
        told = str(error).rstrip(".").replace(". Choose from:", ", not one of")
        told = told[:1].lower() + told[1:]
    return f"{told}; see {help_page}"


def _missing(argument, verb: str, argv: list[str]) -> str:
    """A verb without one of its arguments, or a flag without its value."""
    given = [name for name in argument.names if name in argv]
    if given:
        return f"{given[0]} needs {'more values' if argument.token_count()[0] > 1 else 'a value'}"
    field = argument.field_info
    return f"{verb} needs {argument.name if field.kind is field.KEYWORD_ONLY else field.name.upper()}"


if __name__ == "__main__":
    raise SystemExit(main())
