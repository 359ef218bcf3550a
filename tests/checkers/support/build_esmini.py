"""Builds esmini into target/esmini/bin, once: `python build_esmini.py [SOURCES]`. The check of our scenarios finds it
there. SOURCES is a folder with checkouts named esmini, fmt and fmi-standard; without it they are cloned. Takes some ten
minutes on two cores; needs git, a C++ compiler and PyPI (for cmake and ninja)."""

import pathlib
import shutil
import subprocess
import sys
import venv

ROOT = pathlib.Path(__file__).resolve().parents[3]
PLACE = ROOT / "target/esmini"
# Commits: esmini of July 2026 and its submodules. Where each lies in esmini.
SOURCES = {
    "esmini": ("https://github.com/esmini/esmini", "77028d83e6d402de52f7187e5384d1b1c02b7d1f", "."),
    "fmt": ("https://github.com/fmtlib/fmt", "40626af88bd7df9a5fb80be7b25ac85b122d6c21", "externals/fmt"),
    "fmi-standard": ("https://github.com/modelica/fmi-standard", "714d206bb6140fcfe34c2ab3266bf113373dc6d0", "externals/fmi2"),
}
# No window, no sensor messages, no traffic of others: it plays scenarios and records them.
OFF = ("USE_OSG", "USE_OSI", "USE_SUMO", "USE_GTEST", "USE_IMPLOT", "DOWNLOAD_EXTERNALS")
PROGRAMS = ("esmini", "dat2csv")


def run(*command):
    subprocess.run([str(part) for part in command], check=True)


def fetch(folder):
    """Clones what is needed; a server that does not answer ends it within a minute."""
    for name, (address, commit, _) in SOURCES.items():
        run("git", "init", "-q", folder / name)
        git = ("git", "-C", folder / name, "-c", "http.lowSpeedLimit=1", "-c", "http.lowSpeedTime=30")
        run(*git, "fetch", "-q", "--depth", "1", address, commit)
        run(*git, "checkout", "-q", "FETCH_HEAD")


def main():
    shutil.rmtree(PLACE, ignore_errors=True)
    given = sys.argv[1:]
    sources = pathlib.Path(given[0]) if given else PLACE / "sources"
    if not given:
        fetch(sources)
    tree = PLACE / "tree"
    for name, (_, _, inside) in SOURCES.items():
        shutil.copytree(sources / name, tree / inside, dirs_exist_ok=True, ignore=shutil.ignore_patterns(".git"))
    venv.create(PLACE / "env", with_pip=True)
    tools = PLACE / "env/bin"
    run(tools / "pip", "install", "-q", "cmake", "ninja")
    options = [f"-D{name}=OFF" for name in OFF]
    build = PLACE / "build"
    run(tools / "cmake", "-S", tree, "-B", build, "-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={tools / 'ninja'}", "-DCMAKE_BUILD_TYPE=Release", *options)
    run(tools / "ninja", "-C", build, *PROGRAMS)
    (PLACE / "bin").mkdir()
    for name in PROGRAMS:
        found = next(path for path in build.rglob(name) if path.is_file())
        shutil.copy2(found, PLACE / "bin" / name)
    print(PLACE / "bin/esmini")


main()
