#!/usr/bin/env python3
"""The adapter of Blender (Cycles) on a real contract: blender_test.py PARITY

The adapter's own test first, where node is there. 77: there is no Blender.
"""
import shutil
import sys
from pathlib import Path

from engine import SOURCE, check_calibration, flips_of, run, scenes, skip, temporary_folder, write_suite

EXTERNALS = '[[scene.external]]\nname = "Cycles"\ntest = "shots"\ncalibration = "shots/calibration.png"\n'


def main():
    parity = Path(sys.argv[1]).resolve()
    blender = shutil.which("blender")
    if not blender:
        skip("Blender is needed")
    if shutil.which("node"):
        print(run(["node", "--test", SOURCE / "integrations/blender/test.mjs"], SOURCE))
    with temporary_folder() as name:
        folder = Path(name)
        suite, size = write_suite(folder, EXTERNALS), ["--size", "128x128", "--samples", "16"]
        run([parity, "contract", "--suite", suite, "-o", "contract", *size], folder)
        print(run([blender, "-b", "--factory-startup", "--python", SOURCE / "integrations/blender/render.py", "--",
                   "contract", "shots", "--samples", "32"], folder))
        check_calibration(parity, folder, "shots", "srgb")
        print(run([parity, "report", "--suite", suite, "-o", "out", *size], folder, codes=(0, 1, 2)))
        for scene in scenes():
            flips = flips_of(folder / "out", scene)
            print(scene, flips)
            # The balls light one another in Cycles, in parity's paths they do not.
            if scene != "Balls" and not flips["Cycles"] < flips["mobile"]:
                sys.exit(f"{scene}: Cycles should be nearer to the high-end path than mobile is: {flips}")


main()
