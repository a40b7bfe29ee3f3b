#!/usr/bin/env python3
"""integrations/github/nightly.yml, run as GitHub runs it: github_test.py PARITY [unittest options...]

Each job has a workspace of its own. Artifacts carry files from one to the next as actions/upload-artifact@v4 does: neither
hidden files nor empty folders.
"""
import json
import re
import shutil
import subprocess

import yaml

from night import INTEGRATIONS, Night, fail_work, main

GITHUB = INTEGRATIONS / "github"
INSTALL = "OWNER/parity/integrations/github/install@v"


def read_jobs():
    return yaml.safe_load((GITHUB / "nightly.yml").read_text(encoding="utf-8"))["jobs"]


def holds(condition, results):
    """Whether an `if:` of the workflow holds, of a run that no one cancels."""
    text = condition.removeprefix("${{").removesuffix("}}").strip()
    text = re.sub(r"needs\.(\w+)\.result", lambda match: f"'{results[match.group(1)]}'", text)
    for function, value in (("!cancelled()", "True"), ("always()", "True"), ("&&", "and")):
        text = text.replace(function, value)
    if not re.fullmatch(r"(True|and|==|'\w+'| )+", text):
        raise AssertionError(f"not understood: {condition}")
    return eval(text) # pylint: disable=eval-used


class Workflow(Night):
    def setUp(self):
        super().setUp()
        self.jobs = read_jobs()
        self.results, self.outputs, self.artifacts = {}, {}, {}
        self.said = ""

    def evaluate(self, text, matrix):
        values = {"github.run_id": "1"}
        values.update({f"matrix.{name}": str(value) for name, value in matrix.items()})
        values.update({f"needs.{job}.outputs.{name}": value for job, outputs in self.outputs.items() for name, value in outputs.items()})
        return re.sub(r"\$\{\{ *(?:fromJSON\()?([\w.]+)\)? *\}\}", lambda match: values[match.group(1)], text)

    def run_step(self, step, workspace, matrix):
        given = {name: self.evaluate(str(value), matrix) for name, value in step.get("with", {}).items()}
        action = step.get("uses", "")
        if "run" in step:
            output = workspace.parent / f"{workspace.name}.output"
            output.touch()
            environment = dict(self.environment, GITHUB_OUTPUT=str(output), GITHUB_WORKSPACE=str(workspace), GITHUB_ACTIONS="true")
            environment.update({name: self.evaluate(value, matrix) for name, value in step.get("env", {}).items()})
            done = subprocess.run(["bash", "-e", "-c", step["run"]], cwd=workspace, env=environment, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300, check=False)
            self.said += done.stdout
            self.step_outputs[step.get("id")] = dict(line.split("=", 1) for line in output.read_text(encoding="utf-8").splitlines())
            return done.returncode
        if action == "actions/upload-artifact@v4":
            self.upload(workspace / given["path"], given["name"], given.get("overwrite") == "True")
        elif action == "actions/download-artifact@v4":
            self.download(workspace / given["path"], given)
        else:
            self.assertTrue(action.startswith((INSTALL, "actions/checkout@v4", "actions/cache@v4")), action)
        return 0

    def upload(self, path, name, overwrite):
        self.assertTrue(overwrite or name not in self.artifacts, f"{name}: GitHub refuses a second artifact of a name")
        files = [file for file in path.rglob("*") if file.is_file()
                 and not any(part.startswith(".") for part in file.relative_to(path).parts)]
        self.artifacts[name] = {file.relative_to(path): file.read_bytes() for file in files}

    def download(self, path, given):
        names = [given["name"]] if "name" in given else [
            name for name in self.artifacts if re.fullmatch(given["pattern"].replace("*", ".*"), name)]
        self.assertTrue("name" in given or given["merge-multiple"] == "True", "else each artifact has a folder of its own")
        for name in names:
            for file, content in self.artifacts[name].items():
                (path / file).parent.mkdir(parents=True, exist_ok=True)
                (path / file).write_bytes(content)

    def run_job(self, name, matrix):
        """The exit code of its first step that failed, or 0."""
        workspace, failed, self.step_outputs = self.checkout(name), 0, {}
        for step in self.jobs[name]["steps"]:
            if failed == 0 or ("if" in step and holds(step["if"], self.results)):
                failed = self.run_step(step, workspace, matrix) or failed
        for output, value in self.jobs[name].get("outputs", {}).items():
            step, key = re.fullmatch(r"\$\{\{ steps\.(\w+)\.outputs\.(\w+) \}\}", value).groups()
            self.outputs.setdefault(name, {})[output] = self.step_outputs[step][key]
        return failed

    def run_work(self, shards=None):
        """The exit codes of the shards."""
        self.assertFalse(self.jobs["work"]["strategy"]["fail-fast"])
        if shards is None:
            shards = json.loads(self.evaluate(self.jobs["work"]["strategy"]["matrix"]["shard"], {}))
        codes = {shard: self.run_job("work", {"shard": shard}) for shard in shards}
        self.results["work"] = "failure" if any(codes.values()) else "success"
        return codes

    def run_plan(self):
        self.assertEqual(self.run_job("plan", {}), 0, self.said)
        self.results["plan"] = "success"

    def run_merge(self):
        self.assertTrue(holds(self.jobs["merge"]["if"], self.results), "the merge does not run")
        return self.run_job("merge", {})

    def assert_report(self):
        report = self.folder / "report"
        shutil.rmtree(report, ignore_errors=True)
        self.download(report, {"name": "parity-report"})
        self.assert_same(report)

    def test_the_jobs_make_the_report_of_one_machine(self):
        self.run_plan()
        fail_work(self.folder, 2, [75])
        codes = self.run_work()
        self.assertEqual(list(codes), list(range(8)), "the shards of the plan")
        self.assertEqual(set(codes.values()), {0}, "exit code 75 is tried again: " + self.said)
        self.assertEqual(self.run_merge(), 2, self.said)
        self.assert_report()

    def test_a_shard_that_fails_is_an_error_of_the_merge_and_can_run_again(self):
        self.run_plan()
        fail_work(self.folder, 3, [75, 75])
        codes = self.run_work()
        self.assertEqual(codes.pop(3), 75)
        self.assertEqual(set(codes.values()), {0})
        self.assertEqual(self.run_merge(), 4, self.said)
        # "Re-run failed jobs" runs what failed and what needs it; artifacts of the first attempt stay.
        self.assertEqual(self.run_work([3]), {3: 0}, self.said)
        self.assertEqual(self.run_merge(), 2, self.said)
        self.assert_report()

    def test_the_merge_does_not_follow_a_plan_that_failed(self):
        self.assertFalse(holds(self.jobs["merge"]["if"], {"plan": "failure", "work": "skipped"}))

    def test_the_workflow_gives_the_install_action_inputs_that_it_has(self):
        action = yaml.safe_load((GITHUB / "install" / "action.yml").read_text(encoding="utf-8"))
        whole = yaml.safe_load((GITHUB / "action.yml").read_text(encoding="utf-8"))
        for name, described in action["inputs"].items():
            self.assertEqual(described, whole["inputs"][name], "both install in the same way")
        self.assertEqual(action["runs"]["steps"][0]["env"], whole["runs"]["steps"][0]["env"])
        script = action["runs"]["steps"][0]["run"].removeprefix('bash "$GITHUB_ACTION_PATH/').removesuffix('"')
        self.assertTrue((GITHUB / "install" / script).is_file())
        uses = [step for job in self.jobs.values() for step in job["steps"] if step.get("uses", "").startswith(INSTALL)]
        self.assertEqual(len(uses), len(self.jobs))
        for step in uses:
            self.assertLessEqual(set(step["with"]), set(action["inputs"]))


if __name__ == "__main__":
    main("__main__")
