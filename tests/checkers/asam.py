# /// script
# requires-python = ">=3.11"
# dependencies = [
#     "asam-qc-openscenarioxml==1.0.0",
#     "asam-qc-opendrive==1.0.0",
#     "scenariogeneration==0.16.7",
# ]
# ///
"""Scenarios and maps that we write, held against ASAM's own checkers and read back by scenariogeneration.

    python asam.py PROGRAM WORKFOLDER
"""

import pathlib
import subprocess
import sys
import xml.etree.ElementTree as ET
import zipfile

from scenariogeneration import xosc

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Application, program and how many checks of a file must have been made: where the schema fails, the rest is skipped.
CHECKERS = {
    ".xosc": ("xoscBundle", "qc_openscenario", 17),
    ".xodr": ("xodrBundle", "qc_opendrive", 22),
}


def faults(file: pathlib.Path) -> list[str]:
    """What a checker has to say of a file."""
    bundle, tool, checks = CHECKERS[file.suffix]
    config, result = file.with_suffix(".config.xml"), file.with_suffix(file.suffix + ".xqar")
    result.unlink(missing_ok=True)
    config.write_text(
        f'<Config><Param name="InputFile" value="{file}"/><CheckerBundle application="{bundle}">'
        f'<Param name="resultFile" value="{result}"/></CheckerBundle></Config>'
    )
    program = pathlib.Path(sys.executable).with_name(tool)
    ran = subprocess.run([program, "-c", config], capture_output=True, text=True)
    if not result.exists():
        return [f"{tool} wrote no result: {ran.stderr[-300:]}"]
    checkers = list(ET.parse(result).getroot().iter("Checker"))
    found = [
        f"{checker.get('checkerId')}: {issue.get('description')}"
        for checker in checkers
        for issue in checker.iter("Issue")
    ]
    done = sum(checker.get("status") == "completed" for checker in checkers)
    if done < checks:
        found.append(f"{done} checks were made, {checks} expected")
    return found


def main() -> int:
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    passed = failed = 0

    def tell(what: str, wrong: list[str]) -> None:
        nonlocal passed, failed
        passed += not wrong
        failed += bool(wrong)
        for fault in wrong[:5]:
            print(f"{what}: {fault}")

    for scene in sorted((ROOT / "assets/scenes").glob("demo-*.json")):
        own = folder / scene.stem
        own.mkdir(parents=True, exist_ok=True)
        packed = own / "scene.xosc.zip"
        command = [program, "convert", scene, "--to", "openscenario", "-o", packed, "--force"]
        subprocess.run(command, check=True, capture_output=True)
        with zipfile.ZipFile(packed) as archive:
            names = archive.namelist()
            archive.extractall(own)
        for name in names:
            tell(name, faults(own / name))
        scenario = next(own / name for name in names if name.endswith(".xosc"))
        element = ET.parse(scenario).getroot()
        entities = xosc.Entities.parse(element.find("Entities"))
        expected = len(element.findall("Entities/ScenarioObject"))
        got = len(entities.scenario_objects)
        tell(f"{scenario.name} by scenariogeneration", [] if got == expected > 0 else [f"{got} of {expected} entities"])
        xosc.StoryBoard.parse(element.find("Storyboard"))
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
