"""The project itself: what is packaged, what the lock holds, what the documents promise."""

import re
import subprocess
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
ROOMS = ("level", "brushes", "io", "renderer", "app")


def test_every_folder_of_code_is_packaged():
    """A sub-package missing from the list works in place and is silently absent from the wheel."""
    folders = {"shorewright"}
    for room in ROOMS:
        for init in (ROOT / room).rglob("__init__.py"):
            folders.add(".".join(("shorewright", *init.parent.relative_to(ROOT).parts)))
    assert folders == set(PROJECT["tool"]["setuptools"]["packages"])


def test_every_shader_is_packaged():
    data = PROJECT["tool"]["setuptools"]["package-data"]
    shipped = {ROOT.joinpath(*package.split(".")[1:]) for package in data}
    assert {path.parent for room in ROOMS for path in (ROOT / room).rglob("*.glsl")} <= shipped


@pytest.mark.parametrize(
    "name", [re.split(r"[<>=~ ]", row)[0] for row in PROJECT["project"]["dependencies"]], ids=str.lower
)
def test_every_dependency_is_locked(name):
    """A fresh install gets the versions that were tested."""
    lock = (ROOT / "requirements.lock").read_text().lower()
    assert re.search(rf"^{re.escape(name.lower())}==", lock, re.MULTILINE)


def test_the_top_of_the_project_holds_nothing_unexpected():
    allowed = {*ROOMS, "tests", "sample_levels", "docs", "pyproject.toml", "requirements.lock", "Makefile"}
    allowed |= {"README.md", "ARCHITECTURE.md", "CHANGELOG.md", "LICENSE", "__init__.py", "bench.json"}
    try:  # what is in the repository; a level that somebody made beside it is theirs
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        pytest.skip(f"no repository to ask: {error}")
    seen = {name.partition("/")[0] for name in listed.split("\0") if name and not name.startswith(".")}
    assert seen <= allowed, seen - allowed
    assert {*ROOMS, "tests"} <= seen


@pytest.mark.parametrize("document", ["README.md", "ARCHITECTURE.md"])
def test_links_in_the_documents_lead_somewhere(document):
    text = (ROOT / document).read_text()
    for link in re.findall(r"\]\(([^)#:]+)\)", text):
        assert (ROOT / link).exists(), f"{document} links to {link}"


def test_the_reference_is_made_from_the_tables():
    """Run `python -m shorewright.app.reference > docs/reference.md` after changing a table."""
    from shorewright.app.reference import reference

    assert (ROOT / "docs" / "reference.md").read_text("utf-8") == reference()
