"""The program, a folder to work in, and a count of the checks that hold."""

import pathlib
import sys

program, work = sys.argv[1], pathlib.Path(sys.argv[2])
root = pathlib.Path(__file__).resolve().parents[3]
work.mkdir(parents=True, exist_ok=True)
passed = failed = 0


def check(name, holds):
    global passed, failed
    passed, failed = passed + bool(holds), failed + (not holds)
    if not holds:
        print("FAILED:", name)


def end():
    print(f"{passed} passed, {failed} failed")
    sys.exit(failed > 0)
