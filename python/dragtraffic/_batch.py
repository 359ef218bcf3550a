"""Batches: the chunks of a plan, made here or on a cluster of Dask."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import CancelledError
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from . import _program
from ._errors import DragTrafficError

if TYPE_CHECKING:
    from distributed import Client

#: Most shares that the command divides chunks into.
_MOST_SHARES = 100_000
#: Between two looks at the tasks of a cluster, seconds.
_LOOK_S = 0.05


def batch(
    plan: Union[str, os.PathLike[str]], output: Union[str, os.PathLike[str]], *, client: Client | None = None
) -> dict[str, Any]:
    """Makes the chunks of a plan that are not in the folder yet, and says how far the batch is.

    ``plan`` is the file of a plan, ``output`` the folder of results or its URL in an object store: docs/batch.md
    describes both. Without ``client`` all cores of this machine work. With a client of Dask (``pip install
    dragtraffic[dask]``) its workers do, each chunk is a task with one thread; they have this package, and see the folder
    under the same path. A call that was interrupted goes on when it is made again, also on another cluster. Other
    processes may work on the same folder.

    Returns:
        ``chunks``, ``chunks_done``, ``shares_due`` (those with a chunk that is not there), ``units``, ``units_done``,
        ``scenes`` and ``tally`` (outcomes and problem codes).

    Raises:
        DragTrafficError: the plan or an input cannot be read, the folder has another batch, a chunk cannot be written, or
            is there with other bytes (``not-reproducible``), or the scheduler was lost.
    """
    folder = os.fspath(output)
    if "://" not in folder:
        folder = os.path.abspath(folder)
    if client is None:
        _command("batch", os.fspath(plan), "-o", folder)
    else:
        # The last of many shares is empty or short: this reads the inputs and records them, for the workers to find.
        _command("batch", os.fspath(plan), "-o", folder, "--shard", f"{_MOST_SHARES - 1}/{_MOST_SHARES}")
        _spread(client, Path(plan).read_text(encoding="utf-8"), folder)
    status = _status(folder)
    # Tasks of a scheduler that is lost end without an error.
    if (there := int(status["chunks_done"])) < (all := int(status["chunks"])):
        raise DragTrafficError(f"{there} of {all} chunks are there: the cluster was lost; call again", "batch-failed")
    return status


def _spread(client: Client, plan: str, folder: str) -> None:
    """Has the workers of a cluster make the chunks that are not there; the first one that fails ends the call."""
    from distributed import as_completed

    status = _status(folder)
    count = min(int(status["chunks"]), _MOST_SHARES)
    due = sorted({int(share) % count for share in status["shares_due"]})
    tasks = client.map(_chunk, due, plan=plan, folder=folder, count=count, pure=False)
    finished = as_completed(tasks, with_results=True)
    try:
        # A scheduler that is lost cancels tasks, but not all of them: the rest would be waited for without end. The
        # caller counts the chunks.
        while client.status not in ("closing", "closed") and not finished.is_empty():
            if not finished.has_ready():
                time.sleep(_LOOK_S)
            elif next(finished)[0].cancelled():
                break
    except CancelledError:
        pass
    finally:
        if client.status == "running":
            client.cancel(tasks)


def _chunk(share: int, plan: str, folder: str, count: int) -> None:
    """One task: the chunks of a share."""
    with tempfile.TemporaryDirectory() as own:
        copy = Path(own, "plan.toml")
        copy.write_text(plan, encoding="utf-8")
        _command("batch", str(copy), "-o", folder, "--shard", f"{share}/{count}", "--jobs", "1", "--quiet")


def _status(folder: str) -> dict[str, Any]:
    status: dict[str, Any] = json.loads(_command("batch", "status", folder, "--json"))
    return status


def _command(*arguments: str) -> bytes:
    """Runs the command line and gives what it prints. Its messages are shown, and are those of an error."""
    command = [sys.executable, _program.__file__, *arguments]
    said: list[str] = []
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stdout is not None and process.stderr is not None
        for line in process.stderr:
            said.append(line.decode(errors="replace"))
            sys.stderr.write(said[-1])
        printed = process.stdout.read()
    if process.returncode != 0:
        message = "".join(said[-20:]).strip() or f"the command ended with {process.returncode}"
        raise DragTrafficError(message, "not-reproducible" if "not-reproducible" in message else "batch-failed")
    return printed
