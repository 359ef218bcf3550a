"""The command ``dragtraffic``: ``python -m dragtraffic`` opens the editor, ``--help`` lists the commands. ``drive`` is
Python's own: it runs planners that are written in Python."""

import signal
import sys

from . import _native


def main() -> int:
    """Runs the command line and returns its exit code."""
    if sys.argv[1:2] == ["drive"]:
        from ._drive import main as drive

        return drive(sys.argv[2:])
    # The program answers Ctrl-C by itself; Python's handler would wait for it to end.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.main(["dragtraffic", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
