"""A small night for the tests of integrations/: a suite, the program on the PATH, and what `parity report` makes of it."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
INTEGRATIONS = ROOT / "integrations"

# They hold times and the command line (docs/cache.md): no run repeats them.
NOT_REPEATED = {"index.html", "junit.xml", "run.json"}

# A file beside the suite: a worker in another folder must find it by the plan.
TRIANGLE = """{
  "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "material": 0}]}],
  "materials": [{"name": "copper", "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.5, 0.4, 1], "roughnessFactor": 0.3}}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36}],
  "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}]
}
"""


def write_suite(file, scenes, builtin=1):
    """A suite of `scenes` scenes: of a file in an environment, of built-in scenes in environments, and of the file under suns,
    which takes a tenth of their time."""
    names = ["spheres", "materials", "lamps", "shadows", "room", "lights"]
    environments = ["studio", "sky", "night", "white"]
    lines = ['name = "night"', "[defaults]", "prefilter_size = 64", "prefilter_samples = 8"]
    lines += ["[[scene]]", 'file = "triangle.gltf"', 'environment = "builtin:sky"']
    for index in range(builtin):
        name, environment = names[index // len(environments)], environments[index % len(environments)]
        lines += ["[[scene]]", f'file = "builtin:{name}"', f'name = "{name} in {environment}"',
                  f'environment = "builtin:{environment}"']
    for index in range(scenes - 1 - builtin):
        lines += ["[[scene]]", 'file = "triangle.gltf"', f'name = "copper under sun {index}"', f"sun = [{30 * index}, 50, 4]"]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    (file.parent / "triangle.gltf").write_text(TRIANGLE, encoding="utf-8")


# What the commands in integrations/ do not say, so that pictures are small.
SMALL = ["--size", "96x96", "--pixel-data", "none"]

# In place of the program: ends as a test wants it to (fail_work), else becomes the program.
STAND_IN = """#!/bin/sh
codes={folder}/codes-${{PARITY_SHARD-${{SLURM_ARRAY_TASK_ID-${{JOB_COMPLETION_INDEX-${{CI_NODE_INDEX-}}}}}}}}
if [ "$1" = work ] && [ "$3" = --shard ] && [ -s "$codes" ]; then
  code=$(head -n 1 "$codes")
  sed -i 1d "$codes"
  exit "$code"
fi
[ "$1" != plan ] || set -- "$@" {options}
exec {program} "$@"
"""


def make_environment(folder, program, options=()):
    """With a folder for the program on the PATH, as `parity`, and a cache of its own. The options are for `parity plan`.
    The driver's compiled shaders are shared with all tests: they are no results, and each cold start would take seconds."""
    bin_folder = folder / "bin"
    bin_folder.mkdir(parents=True)
    (bin_folder / "parity").write_text(STAND_IN.format(folder=folder, program=program, options=" ".join(options)), encoding="utf-8")
    (bin_folder / "parity").chmod(0o755)
    kept = {name: os.environ[name] for name in ("HOME", "LANG", "VK_ICD_FILENAMES", "VK_DRIVER_FILES") if name in os.environ}
    return dict(kept, PATH=f"{bin_folder}:/usr/sbin:/usr/bin:/sbin:/bin", XDG_CACHE_HOME=str(folder / "cache"),
                MESA_SHADER_CACHE_DIR=str(pathlib.Path(program).parent / "test-caches"), ASAN_OPTIONS="detect_leaks=0")


def fail_work(folder, index, codes):
    """`parity work` of the shard with this index, as the engine counts, does nothing and ends with these codes, a call each."""
    (folder / f"codes-{index}").write_text("".join(f"{code}\n" for code in codes), encoding="utf-8")


def run(command, folder, environment, expected=(0,)):
    """What the command prints; another exit code than an expected one is an error that shows it."""
    done = subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=600, check=False)
    if done.returncode not in expected:
        raise AssertionError(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


def files_of(folder):
    return {str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file()}


def content_of(file):
    """The file's bytes; of a scene's details without the commands, which name the suite by the path that was given."""
    content = file.read_bytes()
    return re.sub(rb'"again":\[.*\]}\);\n$', b"", content, flags=re.DOTALL) if file.parent.name == "scenes" else content


def differences(report, reference):
    """Files of a report that are not, byte for byte, those of the other; what is missing or too much, too."""
    ours, theirs = files_of(report), files_of(reference)
    found = [f"{name}: missing" for name in theirs - ours] + [f"{name}: too much" for name in ours - theirs]
    for name in sorted(ours & theirs):
        if name not in NOT_REPEATED and content_of(report / name) != content_of(reference / name):
            found.append(f"{name}: other bytes")
    return sorted(found)


def pictures(report):
    return len([name for name in files_of(report) if name.endswith(".png")])


class Night(unittest.TestCase):
    """A test case with a folder, a repository that holds the suite ci/nightly.toml, and the report of one machine."""

    PROGRAM = ""
    SCENES = 9

    @classmethod
    def setUpClass(cls):
        cls.made = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.made)
        write_suite(cls.made / "repository" / "ci" / "nightly.toml", cls.SCENES)
        cls.reference = cls.made / "reference"
        run(["parity", "report", "--suite", "ci/nightly.toml", *SMALL, "-o", cls.reference], cls.made / "repository",
            make_environment(cls.made / "alone", cls.PROGRAM), expected=(2,))

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.environment = make_environment(self.folder, self.PROGRAM, SMALL)
        self.environment["XDG_CACHE_HOME"] = str(self.made / "cache")

    def checkout(self, name):
        """A folder of its own for a job, with the repository in it."""
        folder = pathlib.Path(tempfile.mkdtemp(prefix=f"{name}-", dir=self.folder))
        return pathlib.Path(shutil.copytree(self.made / "repository", folder, dirs_exist_ok=True))

    def assert_same(self, report):
        self.assertEqual(differences(report, self.reference), [])
        self.assertGreaterEqual(pictures(report), self.SCENES)


def main(case):
    """Runs the tests of the program that the command line names first."""
    Night.PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(module=case)
