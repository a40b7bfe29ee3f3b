"""The adapter of three.js on a real contract: what it renders is calibrated and compared, material by material.

Usage: threejs_test.py PARITY FOLDER. FOLDER has the packages of integrations/threejs (npm ci). 77: there is no Chromium.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]


def run(command, folder, codes=(0,)):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode not in codes:
        sys.exit(f"{command}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def main():
    parity, packages = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    chromium = os.environ.get("CHROMIUM", "/usr/bin/chromium")
    if not shutil.which("node") or not os.access(chromium, os.X_OK):
        print("skipped: node and Chromium are needed")
        sys.exit(77)
    scenes = [("Balls", "builtin:materials")]
    assets = Path(os.environ.get("PARITY_SHARED", SOURCE / "../shared")) / "assets"
    if (assets / "WaterBottle/WaterBottle.gltf").exists():
        scenes.append(("WaterBottle", str(assets / "WaterBottle/WaterBottle.gltf")))
    else:
        print("not tried: WaterBottle, there are no shared assets")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        suite = folder / "suite.toml"
        suite.write_text("".join(
            f'[[scene]]\nname = "{scene}"\nfile = "{file}"\nenvironment = "builtin:studio"\n'
            '[[scene.external]]\nname = "three.js"\ntest = "shots"\ncalibration = "shots/calibration.png"\n'
            for scene, file in scenes))
        size = ["--size", "192x192"]
        run([parity, "contract", "--suite", suite, "-o", "contract", *size], folder)
        shutil.copytree(SOURCE / "integrations/threejs", folder / "threejs", ignore=shutil.ignore_patterns("node_modules"))
        (folder / "threejs/node_modules").symlink_to(packages / "node_modules")
        print(run(["node", "threejs/render.mjs", "contract", "shots"], folder))
        found = run([parity, "calibrate", "shots"], folder)
        print(found)
        if "curve        srgb" not in found or "mirrored" in found:
            sys.exit("the calibration is not that of an engine that does as the contract says")
        print(run([parity, "report", "--suite", suite, "-o", "out", *size], folder, codes=(0, 1, 2)))
        report = json.loads((folder / "out/report.json").read_text())
        for scene in report["scenes"]:
            rows = {view["test"]: view for view in scene["views"]}
            flips = {test: view["whole"]["figures"]["metrics"]["flip.mean"] for test, view in rows.items()}
            print(scene["name"], flips)
            if not flips["three.js"] < flips["mobile"]:
                sys.exit(f"{scene['name']}: three.js should be nearer to the high-end path than mobile is: {flips}")
            if not any(material["figures"] for material in rows["three.js"]["materials"]):
                sys.exit(f"{scene['name']}: no material was judged")


main()
