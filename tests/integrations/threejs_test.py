#!/usr/bin/env python3
"""The adapter of three.js on a real contract: threejs_test.py PARITY FOLDER

FOLDER has the packages of integrations/threejs (npm ci). 77: there is no Chromium.
"""
import os
import shutil
import sys
from pathlib import Path

from engine import SOURCE, check_calibration, flips_of, run, scenes, skip, temporary_folder, write_suite

EXTERNALS = """[[scene.external]]
name = "three.js"
test = "shots"
calibration = "shots/calibration.png"
[[scene.external]]
name = "three.js, Cineon"
test = "curved"
transfer = "fitted"
calibration = "curved/calibration.png"
"""


def main():
    parity, packages = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    if not shutil.which("node") or not os.access(os.environ.get("CHROMIUM", "/usr/bin/chromium"), os.X_OK):
        skip("node and Chromium are needed")
    with temporary_folder() as name:
        folder = Path(name)
        suite, size = write_suite(folder, EXTERNALS), ["--size", "192x192", "--samples", "4"]
        run([parity, "contract", "--suite", suite, "-o", "contract", *size], folder)
        shutil.copytree(SOURCE / "integrations/threejs", folder / "threejs", ignore=shutil.ignore_patterns("node_modules"))
        (folder / "threejs/node_modules").symlink_to(packages / "node_modules")
        print(run(["node", "threejs/render.mjs", "contract", "shots"], folder))
        run(["node", "threejs/render.mjs", "contract", "curved", "--tone", "cineon"], folder)
        check_calibration(parity, folder, "shots", "srgb")
        check_calibration(parity, folder, "curved", "none of the known ones")
        print(run([parity, "report", "--suite", suite, "-o", "out", *size], folder, codes=(0, 1, 2)))
        for scene in scenes():
            flips = flips_of(folder / "out", scene)
            print(scene, flips)
            if not flips["three.js"] < flips["mobile"]:
                sys.exit(f"{scene}: three.js should be nearer to the high-end path than mobile is: {flips}")
            if abs(flips["three.js, Cineon"] - flips["three.js"]) > 0.02:
                sys.exit(f"{scene}: a tone curve that is read from the calibration should change little: {flips}")


main()
