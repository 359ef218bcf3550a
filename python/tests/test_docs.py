"""The Python blocks of the documentation run, and print what their comments say."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ADDRESS = "127.0.0.1:8080"
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
#: A line that prints one value, and the value behind it.
PRINTED = re.compile(r"^print\(.*\)\s+# (\S+)$", re.MULTILINE)


def pages() -> list[Path]:
    """Pages with Python blocks."""
    found = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [page for page in found if BLOCK.search(page.read_text())]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "assets").symlink_to(ROOT / "assets")
    return tmp_path


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A server on a free port."""
    store = tmp_path_factory.mktemp("store") / "scenes.sqlite"
    command = [sys.executable, "-m", "dragtraffic", "serve", "--port", "0", "--db", str(store)]
    own = {**os.environ, "PYTHONPATH": str(ROOT / "python")}
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=own
    ) as server:
        assert server.stdout is not None
        line = server.stdout.readline()
        yield line.strip().removeprefix("DragTraffic is at http://").rstrip("/")
        server.terminate()


def test_there_are_pages() -> None:
    assert len(pages()) >= 3


@pytest.mark.parametrize("page", pages(), ids=lambda page: str(page.relative_to(ROOT)))
def test_blocks_run(page: Path, folder: Path, address: str) -> None:
    # The blocks of a page follow each other, as a reader types them.
    code = "\n".join(BLOCK.findall(page.read_text())).replace(ADDRESS, address)
    script = folder / "page.py"
    script.write_text(f"import matplotlib\nmatplotlib.use('Agg')\n{code}")
    run = subprocess.run(
        [sys.executable, script],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT / "python")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    printed = iter(run.stdout.splitlines())
    for wanted in PRINTED.findall(code):
        assert wanted in printed, f"{wanted} is not printed: {run.stdout}"
