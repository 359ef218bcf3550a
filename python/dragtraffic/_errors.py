"""Refusals of the engine."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any


class DragTrafficError(Exception):
    """The engine refused a call, or could not read a file.

    The message is a sentence for people. ``code`` never changes and is for programs (``out-of-range``,
    ``unknown-agent``, ...: ``/docs/problems`` of a server explains them). ``errors`` are the single faults, with
    ``pointer`` and ``detail``.
    """

    def __init__(self, message: str, code: str, errors: Sequence[dict[str, Any]] = ()) -> None:
        super().__init__(message)
        self.code = code
        self.errors = list(errors)

    def __reduce__(self) -> tuple[Any, ...]:
        # It travels between processes with all that it says.
        return type(self), (str(self), self.code, self.errors)


def refusal(detail: str, code: str, errors: str) -> DragTrafficError:
    """A refusal as the native module says it. A fault whose place is known begins with it."""
    faults: list[dict[str, Any]] = json.loads(errors or "[]")
    lines = [f"{fault['pointer'].lstrip('/')}: {fault['detail']}" for fault in faults if fault.get("pointer")]
    return DragTrafficError("\n".join(lines) or detail, code, faults)
