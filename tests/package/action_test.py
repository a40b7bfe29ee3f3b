#!/usr/bin/env python3
"""The GitHub Action's own steps, run as a runner runs them: action_test.py PARITY [unittest options...]

PARITY is the built program. Where a test is about the steps alone, a shell script stands in for it and for apt-get,
curl and the like: the log of their calls is what is checked.
"""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

ACTION = pathlib.Path(__file__).resolve().parents[2] / "integrations" / "github"
PROGRAM = ""


def read_action():
    return yaml.safe_load((ACTION / "action.yml").read_text(encoding="utf-8"))


def evaluate(text, values):
    """Every ${{ a || b }} of the text: the first of its names that has a value."""

    def value(match):
        names = [name.strip() for name in match.group(1).split("||")]
        for name in names:
            if name not in values:
                raise KeyError(f"{name} is known to no runner")
        return next((values[name] for name in names if values[name]), "")

    return re.sub(r"\$\{\{(.*?)\}\}", value, text)


class ActionFile(unittest.TestCase):
    def setUp(self):
        self.action = read_action()
        self.steps = self.action["runs"]["steps"]
        self.scripts = [step for step in self.steps if "run" in step]

    def test_no_input_becomes_a_part_of_a_script(self):
        self.assertEqual(len(self.scripts), 2)
        for step in self.scripts:
            self.assertNotIn("${{", step["run"])
            self.assertEqual(step["shell"], "bash")

    def test_every_input_is_used_and_described_and_no_other_is(self):
        used = set(re.findall(r"inputs\.([a-z0-9-]+)", yaml.safe_dump(self.steps)))
        self.assertEqual(used, set(self.action["inputs"]))
        for name, given in self.action["inputs"].items():
            self.assertTrue(given["description"], name)
            self.assertIsInstance(given["default"], str, name)

    def test_every_variable_of_a_script_is_given_to_it(self):
        for step in self.scripts:
            script = (ACTION / re.search(r"/([a-z]+\.sh)\"$", step["run"]).group(1)).read_text(encoding="utf-8")
            self.assertEqual(set(re.findall(r"\$\{?(PARITY_[A-Z0-9_]+)", script)), set(step["env"]), step["id"])

    def test_outputs_come_from_a_step_that_makes_them(self):
        made = set(re.findall(r'echo "([a-z-]+)=', (ACTION / "report.sh").read_text(encoding="utf-8")))
        for name, output in self.action["outputs"].items():
            self.assertEqual(output["value"], "${{ steps.report.outputs.%s }}" % name)
            self.assertIn(name, made)

    def test_the_examples_of_the_readme_are_workflows_with_inputs_that_exist(self):
        text = (ACTION / "README.md").read_text(encoding="utf-8")
        examples = re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)
        self.assertTrue(examples)
        uses = 0
        for example in examples:
            for job in yaml.safe_load(example)["jobs"].values():
                for step in job["steps"]:
                    if "integrations/github" in step.get("uses", ""):
                        uses += 1
                        self.assertLessEqual(set(step["with"]), set(self.action["inputs"]))
        self.assertGreater(uses, 0)
        for name in self.action["inputs"]:
            self.assertIn(f"`{name}`", text)


class Steps(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.workspace = self.folder / "workspace"
        self.bin = self.folder / "bin"
        for folder in (self.workspace, self.bin):
            folder.mkdir()

    def fake(self, name, script):
        """A program on the PATH that logs its words, one a line, and then does this."""
        file = self.bin / name
        file.write_text(f'#!/bin/sh\nprintf "%s\\n" {name} "$@" >>"{self.folder}/calls"\n{script}\n', encoding="utf-8")
        file.chmod(0o755)

    def calls(self):
        """Without the name of the summary's file, which is random."""
        file = self.folder / "calls"
        lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
        return [line for line in lines if not line.startswith("--summary=")]

    def run_step(self, step_id, **inputs):
        """What the step with that id ends with, what it prints, its outputs and its summary."""
        action = read_action()
        given = {name: value["default"] for name, value in action["inputs"].items()}
        given.update({name.replace("_", "-"): value for name, value in inputs.items()})
        self.assertEqual(set(given), set(action["inputs"]))
        values = {f"inputs.{name}": value for name, value in given.items()}
        values["github.action_repository"] = "maker/parity"
        step = next(step for step in action["runs"]["steps"] if step["id"] == step_id)
        output, summary = self.folder / "output", self.folder / "summary"
        for file in (output, summary):
            file.write_text("", encoding="utf-8")
        script = self.folder / "step.sh"
        script.write_text(step["run"], encoding="utf-8")
        environment = {
            "PATH": f"{self.bin}:/usr/bin:/bin",
            "HOME": str(self.folder),
            "RUNNER_TEMP": str(self.folder),
            "GITHUB_ACTION_PATH": str(ACTION),
            "GITHUB_OUTPUT": str(output),
            "GITHUB_STEP_SUMMARY": str(summary),
            "GITHUB_SERVER_URL": "https://forge.example",
            "ASAN_OPTIONS": "detect_leaks=0",
        }
        environment.update({name: evaluate(text, values) for name, text in step["env"].items()})
        # As GitHub runs `shell: bash`.
        done = subprocess.run(["bash", "--noprofile", "--norc", "-eo", "pipefail", script], cwd=self.workspace,
                              env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=200, check=False)
        outputs = dict(line.split("=", 1) for line in output.read_text(encoding="utf-8").splitlines())
        return done.returncode, done.stdout, outputs, summary.read_text(encoding="utf-8")


class Report(Steps):
    def fake_parity(self, code, verdict="pass"):
        self.fake("parity", 'for word; do case $word in --output=*) folder=${word#--output=};; esac; done\n'
                            f'mkdir -p "$folder"; printf \'{{\\n  "verdict": "{verdict}"\\n\' >"$folder/report.json"\n'
                            'echo "  fail  gold"; echo "::error::gold"; printf "%s\\n" "\\`\\`\\`"; echo "error: lost" >&2\n'
                            f'exit {code}')

    def test_the_built_program_makes_report_summary_and_exit_code(self):
        os.symlink(PROGRAM, self.bin / "parity")
        quick = "--env\nbuiltin:white\n--size\n64x64\n--prefilter-size=64\n--prefilter-samples=8\n--material\ngold\n"
        code, said, outputs, summary = self.run_step("report", scenes="builtin:spheres\n", args=quick, report="a report")
        self.assertEqual(code, 2, said)
        self.assertEqual(outputs, {"exit-code": "2", "verdict": "fail", "report": "a report"})
        self.assertTrue((self.workspace / "a report" / "junit.xml").is_file())
        self.assertIn("::error title=parity", said)
        self.assertTrue(summary.startswith("## parity: fail\n"))
        self.assertIn("\n### Failures (", summary)
        self.assertRegex(summary, r"(?m)^\| gold \| spheres, view auto \| mean FLIP ")
        self.assertNotIn("::error", summary)

    def test_the_built_program_refuses_what_is_no_scene(self):
        os.symlink(PROGRAM, self.bin / "parity")
        hostile = '$(touch pwned)\n"; touch pwned; "\n`touch pwned`\n--json=pwned\n${{ github.token }}\n'
        code, said, outputs, _ = self.run_step("report", scenes=hostile, fail_on="error")
        self.assertEqual(code, 4, said)
        self.assertEqual(outputs["verdict"], "error")
        self.assertFalse((self.workspace / "pwned").exists())

    def test_inputs_are_words_as_they_are(self):
        self.fake_parity(0)
        odd = "a b;$(touch pwned)'\"`x`*"
        self.run_step("report", suite=odd, budgets=odd, baseline=odd, approvals=odd, report="out", args=f"--size\r\n\n{odd}",
                      annotate="false")
        self.assertEqual(self.calls(), ["parity", "report", "--output=out", f"--suite={odd}", f"--budgets={odd}",
                                        f"--baseline={odd}", f"--approvals={odd}", "--size", odd])
        self.assertFalse((self.workspace / "pwned").exists())

    def test_scenes_are_no_options(self):
        self.fake_parity(0)
        self.run_step("report", scenes="--json=x\nb c.glb", report="out")
        self.assertEqual(self.calls()[2:], ["--output=out", "--annotate=github", "--", "--json=x", "b c.glb"])

    def test_fail_on_says_which_exit_codes_fail(self):
        for code, verdict, fails in ((0, "pass", ()), (1, "warn", ("warning",)), (2, "fail", ("warning", "over-budget")),
                                     (3, "error", ("warning", "over-budget", "error")),
                                     (4, "error", ("warning", "over-budget", "error")),
                                     (64, "error", ("warning", "over-budget", "error")),
                                     (139, "error", ("warning", "over-budget", "error"))):
            self.fake_parity(code, verdict)
            for fail_on in ("warning", "over-budget", "error"):
                with self.subTest(code=code, fail_on=fail_on):
                    ended, said, outputs, summary = self.run_step("report", scenes="a.glb", fail_on=fail_on)
                    self.assertEqual(ended, code if fail_on in fails else 0, said)
                    self.assertEqual(outputs["exit-code"], str(code))
                    self.assertEqual(outputs["verdict"], verdict)
                    self.assertIn("    error: lost", summary)
                    self.assertEqual("--warn-exit" in self.calls(), fail_on == "warning")
                    (self.folder / "calls").unlink()

    def test_warnings_are_a_verdict_without_an_exit_code(self):
        self.fake_parity(0, "warn")
        self.assertEqual(self.run_step("report", scenes="a.glb")[2]["verdict"], "warn")

    def test_nothing_that_the_program_prints_ends_the_block_of_the_summary(self):
        self.fake_parity(2)
        summary = self.run_step("report", scenes="a.glb")[3]
        head, rest = summary.split("\n", 1)
        self.assertEqual(head, "## parity: fail")
        for line in rest.splitlines():
            self.assertTrue(not line or line.startswith("    "), line)

    def test_wrong_inputs_are_errors_of_usage(self):
        self.fake_parity(0)
        for inputs in ({}, {"scenes": " \n"}, {"scenes": "a.glb", "suite": "b.toml"}, {"scenes": "a.glb", "fail_on": "never"},
                       {"scenes": "a.glb", "annotate": "yes"}, {"scenes": "a.glb", "report": ""},
                       {"scenes": "a.glb", "report": "a\nverdict=pass"}):
            with self.subTest(inputs=inputs):
                code, said, outputs, _ = self.run_step("report", **inputs)
                self.assertEqual((code, outputs), (64, {}))
                self.assertIn("::error title=parity::", said)
        self.assertEqual(self.calls(), [])


class Install(Steps):
    def setUp(self):
        super().setUp()
        self.fake("sudo", 'exec "$@"')
        self.fake("apt-get", f'ln -sf parity.installed "{self.bin}/parity"')
        self.fake("parity.installed", "echo parity 0.2.0")
        self.fake("dpkg", "echo amd64")
        self.fake("curl", 'while [ "$1" != --output ]; do shift; done; echo package >"$2"')

    def test_a_package_of_the_workspace_is_installed_by_its_whole_name(self):
        (self.workspace / "a b.deb").write_text("package\n", encoding="utf-8")
        code, said, _, _ = self.run_step("install", deb="a b.deb")
        self.assertEqual(code, 0, said)
        self.assertIn(str(self.workspace / "a b.deb"), self.calls())

    def test_a_version_comes_from_the_releases_of_the_repository(self):
        for repository, expected in (("", "maker/parity"), ("fork/parity", "fork/parity")):
            code, said, _, _ = self.run_step("install", version="0.2.0", repository=repository)
            self.assertEqual(code, 0, said)
            self.assertIn(f"https://forge.example/{expected}/releases/download/v0.2.0/parity_0.2.0-1_amd64.deb",
                          self.calls())

    def test_a_package_of_another_checksum_is_refused_before_it_is_installed(self):
        right = hashlib.sha256(b"package\n").hexdigest()
        self.assertEqual(self.run_step("install", version="0.2.0", sha256="0" * 64)[0], 64)
        self.assertNotIn("apt-get", self.calls())
        code, said, _, _ = self.run_step("install", version="0.2.0", sha256=right)
        self.assertEqual(code, 0, said)
        self.assertIn("apt-get", self.calls())

    def test_without_a_package_the_parity_of_the_path_serves(self):
        self.assertEqual(self.run_step("install")[0], 64)
        self.fake("parity", "echo parity 0.2.0")
        self.assertEqual(self.run_step("install")[0], 0)

    def test_wrong_inputs_install_nothing(self):
        for inputs in ({"deb": "missing.deb"}, {"deb": "a.deb", "version": "0.2.0"}, {"version": "0.2.0; touch pwned"},
                       {"version": "latest"}, {"version": "0.2.0", "repository": "../../x"}, {"sha256": "0" * 64}):
            with self.subTest(inputs=inputs):
                code, said, _, _ = self.run_step("install", **inputs)
                self.assertEqual(code, 64, said)
        self.assertNotIn("apt-get", self.calls())

    def test_a_package_that_apt_refuses_fails_the_step(self):
        (self.workspace / "a.deb").write_text("package\n", encoding="utf-8")
        self.fake("apt-get", 'case $* in *install*) exit 100;; esac')
        code, said, _, _ = self.run_step("install", deb="a.deb")
        self.assertEqual(code, 64, said)
        self.assertIn("Debian 12", said)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
