"""Another engine's adapter on a real contract: what it renders is calibrated and compared, material by material."""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def run(command, folder, codes=(0,)):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode not in codes:
        sys.exit(f"{command}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def scenes():
    """By their names; a shared asset where there is one."""
    found = {"Balls": "builtin:materials"}
    bottle = Path(os.environ.get("PARITY_SHARED", SOURCE / "../shared")).resolve() / "assets/WaterBottle/WaterBottle.gltf"
    if bottle.exists():
        found["WaterBottle"] = str(bottle)
    else:
        print("not tried: WaterBottle, there are no shared assets")
    return found


def write_suite(folder, externals):
    """externals: tables of TOML for each scene."""
    suite = Path(folder) / "suite.toml"
    suite.write_text("".join(f'[[scene]]\nname = "{name}"\nfile = "{file}"\nenvironment = "builtin:studio"\n{externals}'
                             for name, file in scenes().items()))
    return suite


def check_calibration(parity, folder, shots, curve):
    """The engine does as the contract says."""
    found = run([parity, "calibrate", shots], folder)
    print(found)
    number = r"([-+]?\d+\.\d+)"
    place = re.search(rf"place +{number} pixels to the right, {number} down; scale {number}", found)
    width = re.search(rf"filter +as wide as a box of {number}", found)
    turn = re.search(rf"environment +turned by {number} degrees about the vertical, {number} in all \((\d) spots", found)
    wrong = [name for name, is_right in {
        "place": place and max(abs(float(place[1])), abs(float(place[2]))) < 0.05 and abs(float(place[3]) - 1) < 1e-3,
        "curve": f"curve        {curve}" in found,
        "filter": width and abs(float(width[1]) - 1) < 0.2,
        "environment": turn and float(turn[2]) < 0.2,
    }.items() if not is_right]
    if wrong:
        sys.exit(f"the calibration is not that of an engine that does as the contract says: {', '.join(wrong)}")


def flips_of(folder, scene):
    """Of a report: each test's FLIP of the whole, and whether some material of each was judged."""
    report = json.loads((Path(folder) / "report.json").read_text())
    views = next(each["views"] for each in report["scenes"] if each["name"] == scene)
    for view in views:
        if not any(material["figures"] for material in view["materials"]):
            sys.exit(f"{scene}, {view['name']}: no material was judged")
    return {view["test"]: view["whole"]["figures"]["metrics"]["flip.mean"] for view in views}


def temporary_folder():
    return tempfile.TemporaryDirectory(prefix="parity-engine-")
