"""The command line as a process of its own, for those who start it often: ``python PATH_OF_THIS_FILE batch ...``.

The package is left out, since its imports (numpy) take ten times as long as the program's start. The process ends when
its standard input does, and with it the process that started it: a worker that is killed leaves nothing running.
"""

import importlib
import os
import sys
import threading


def _end_with_input() -> None:
    while os.read(0, 4096):
        pass
    # Files are created whole or not at all, so that a sudden end is harmless.
    os._exit(1)


if __name__ == "__main__":
    threading.Thread(target=_end_with_input, daemon=True).start()
    # As a script, it has the package's folder as its first path.
    native = importlib.import_module("_native")
    sys.exit(native.main(["dragtraffic", *sys.argv[1:]]))
