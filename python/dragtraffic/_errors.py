"""Finding and running the program."""

from __future__ import annotations

import os
import shutil
import subprocess
import sysconfig
from collections.abc import Sequence
from pathlib import Path


class DragTrafficError(Exception):
    """The program refused or failed.

    ``exit_code`` is the program's: 2 for what was asked, 3 for a file that cannot be read, 7 for weights;
    the message is what it said.
    """

    def __init__(self, message: str, exit_code: int) -> None:
        super().__init__(message)
        self.exit_code = exit_code


def program() -> Path:
    """Path of the program: ``DRAGTRAFFIC_BIN`` where it is set, else the wheel's own, else the one on ``PATH``."""
    named = os.environ.get("DRAGTRAFFIC_BIN")
    if named:
        return Path(named)
    name = "dragtraffic.exe" if os.name == "nt" else "dragtraffic"
    schemes = [sysconfig.get_preferred_scheme("prefix"), sysconfig.get_preferred_scheme("user")]
    for scheme in schemes:
        own = Path(sysconfig.get_path("scripts", scheme)) / name
        if own.is_file():
            return own
    found = shutil.which(name)
    if found is None:
        raise FileNotFoundError(
            "the program dragtraffic was not found: install this package with pip, put the program on PATH, "
            "or name it in DRAGTRAFFIC_BIN"
        )
    return Path(found)


def run(arguments: Sequence[str], document: bytes = b"") -> bytes:
    """What the program writes to its output for these arguments and this input.

    Raises:
        DragTrafficError: with what the program said, where it ends with another code than 0.
    """
    quiet = [] if arguments[0].startswith("-") else ["--quiet"]
    done = subprocess.run([program(), *arguments, *quiet], input=document, capture_output=True, check=False)
    if done.returncode != 0:
        said = done.stderr.decode(errors="replace").strip()
        raise DragTrafficError(said or f"dragtraffic ended with code {done.returncode}", done.returncode)
    return done.stdout


def version() -> str:
    """Version of the program."""
    return run(["--version"]).decode().split()[-1]
