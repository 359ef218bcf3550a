"""The wheel carries the licence texts of what is compiled into it."""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

import licences  # noqa: E402


def test_the_licence_texts_are_those_of_the_lock_files() -> None:
    wanted, written = licences.texts(), licences.FILE.read_text(encoding="utf-8")
    names = [set(text.split("\n" + "=" * 80 + "\n")) for text in (written, wanted)]
    changed = sorted(part.splitlines()[0][:80] for part in names[0] ^ names[1])
    assert written == wanted, f"python python/licences.py writes it anew: {changed}"


def test_they_go_into_the_wheel_and_name_each_crate() -> None:
    assert '"python/LICENCES.txt"' in (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    text = licences.FILE.read_text(encoding="utf-8")
    for name in ("candle-core", "pyo3", "axum", "tokio", "rusqlite", "preact", "Inter"):
        assert f"{name} " in text
    assert "Permission is hereby granted" in text and "Apache License" in text and "SIL OPEN FONT LICENSE" in text
