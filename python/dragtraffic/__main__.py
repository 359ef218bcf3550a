"""The command ``dragtraffic``: ``python -m dragtraffic`` opens the editor, ``--help`` lists the commands."""

import signal
import sys

from . import _native


def main() -> int:
    """Runs the command line and returns its exit code."""
    # The program answers Ctrl-C by itself; Python's handler would wait for it to end.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.main(["dragtraffic", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
