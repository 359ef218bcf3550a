"""Writes LICENCES.txt, the licence texts of everything that is compiled into the wheel: `python python/licences.py`.

It asks cargo for the crates of the extension module on any system, and the editor's lock file for its packages. Of
a crate that may be had under MIT, that text suffices. Equal texts stand once. A crate without a text is named with its
authors under the plain text of MIT, or refused where it is not under MIT.
"""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
FILE = ROOT / "python/LICENCES.txt"
_CRATE = "dragtraffic-python"
_TEXT = re.compile(r"^(licen[cs]e|copying|unlicense|notice|copyright)", re.IGNORECASE)
_HEAD = """Licences of what is compiled into this wheel beside DragTraffic: crates of the engine, packages and the font of the editor.
`python python/licences.py` of the sources writes this file.
"""


def texts() -> str:
    """The content of the file."""
    by_text: dict[str, list[str]] = {}
    for name, licence, found in sorted([*_crates(), *_packages()]):
        for text in found:
            plain = "\n".join(line.rstrip() for line in text.strip().splitlines())
            by_text.setdefault(plain, []).append(f"{name} ({licence})")
    parts = [f"{', '.join(names)}\n\n{text}\n" for text, names in sorted(by_text.items(), key=lambda part: part[1])]
    return f"\n{'=' * 80}\n".join([_HEAD, *parts])


def _crates() -> Iterator[tuple[str, str, list[str]]]:
    """Name, licence and texts of each crate that the module is made of."""
    command = ["cargo", "metadata", "--locked", "--format-version", "1"]
    metadata = json.loads(subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout)
    packages = {package["id"]: package for package in metadata["packages"]}
    nodes = {node["id"]: node for node in metadata["resolve"]["nodes"]}
    waiting = [id for id, package in packages.items() if package["name"] == _CRATE]
    known = set(waiting)
    while waiting:
        for needed in nodes[waiting.pop()]["deps"]:
            linked = any(kind["kind"] is None for kind in needed["dep_kinds"])
            if linked and needed["pkg"] not in known:
                known.add(needed["pkg"])
                waiting.append(needed["pkg"])
    for package in (packages[id] for id in known):
        if package["source"] is not None:
            yield _name(package), package["license"] or "see its text", _of_crate(package)


def _name(package: dict[str, Any]) -> str:
    return f"{package['name']} {package['version']}"


def _of_crate(package: dict[str, Any]) -> list[str]:
    expression = package["license"] or ""
    found = _found(Path(package["manifest_path"]).parent)
    is_mit = "MIT" in re.split(r"[^A-Za-z0-9.-]+", expression)
    if is_mit and " AND " not in expression:
        mit = {name: text for name, text in found.items() if "mit" in name.lower()}
        notices = {name: text for name, text in found.items() if name.lower().startswith("notice")}
        found = {**mit, **notices} if mit else found
    if found:
        return list(found.values())
    if not is_mit:
        raise SystemExit(f"{_name(package)} has no licence text and is not under MIT: {expression}")
    plain = (ROOT / "LICENSE-MIT").read_text(encoding="utf-8")
    authors = ", ".join(package["authors"]) or f"the authors of {package['name']}"
    return [re.sub(r"^Copyright .*$", f"Copyright (c) {authors}", plain, count=1, flags=re.MULTILINE)]


def _packages() -> Iterator[tuple[str, str, list[str]]]:
    """Name, licence and texts of what the editor is made of."""
    lock = json.loads((ROOT / "web/package-lock.json").read_text(encoding="utf-8"))
    for place, package in lock["packages"].items():
        if place and not package.get("dev"):
            found = _found(ROOT / "web" / place)
            if not found:
                raise SystemExit(f"{place} has no licence text; is it installed? npm --prefix web ci")
            name = place.removeprefix("node_modules/")
            yield f"{name} {package['version']}", package["license"], list(found.values())
    yield "Inter", "OFL-1.1", [(ROOT / "web/public/fonts/Inter-OFL.txt").read_text(encoding="utf-8")]


def _found(folder: Path) -> dict[str, str]:
    """Licence texts of a package by file name."""
    files = sorted(file for file in folder.iterdir() if file.is_file() and _TEXT.match(file.name)) if folder.is_dir() else []
    return {file.name: file.read_text(encoding="utf-8", errors="replace") for file in files}


if __name__ == "__main__":
    FILE.write_text(texts(), encoding="utf-8")
