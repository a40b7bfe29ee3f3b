#!/usr/bin/env python3
"""integrations/kubernetes: kubernetes_test.py PARITY [unittest options...]

The manifests are run by their own script, with a kubectl that does on this machine what the Job controller does.
"""
import json
import shutil
import subprocess

import yaml

from night import INTEGRATIONS, ROOT, Night, fail_work, main

MANIFESTS = INTEGRATIONS / "kubernetes"
SCENES, SHARDS = 5, 6 # one shard has nothing to do


def read_job(name):
    return yaml.safe_load((MANIFESTS / f"{name}.yaml").read_text(encoding="utf-8"))["spec"]


def copy_for_fewer_shards(folder):
    """The script and its jobs, as one changes them for a smaller night: the numbers of shards and of pods alone."""
    shutil.copytree(MANIFESTS, folder)
    for name, words in (("plan", "--shards 64 "), ("work", "completions: 64 ")):
        file = folder / f"{name}.yaml"
        text = file.read_text(encoding="utf-8")
        assert text.count(words) == 1, f"{name}.yaml has not '{words}'"
        file.write_text(text.replace(words, words.replace("64", str(SHARDS))), encoding="utf-8")


class Jobs(Night):
    SCENES = SCENES

    def setUp(self):
        super().setUp()
        self.volume, self.state = self.folder / "volume", self.folder / "state"
        self.state.mkdir()
        shutil.copytree(self.made / "repository" / "ci", self.volume)
        copy_for_fewer_shards(self.folder / "manifests")
        bin_folder = self.folder / "bin"
        (bin_folder / "kubectl").write_text(
            f'#!/bin/sh\nexec /usr/bin/python3 -B "{ROOT}/tests/integrations/fake_kubectl.py" "$@"\n', encoding="utf-8")
        (bin_folder / "sleep").write_text("#!/bin/sh\n", encoding="utf-8")
        for name in ("kubectl", "sleep"):
            (bin_folder / name).chmod(0o755)
        self.environment.update(FAKE_STATE=str(self.state), FAKE_VOLUME=str(self.volume))

    def run_night(self, *words):
        """The exit code of the script; self.said is what it printed."""
        done = subprocess.run([self.folder / "manifests" / "run", *words], env=self.environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=400, check=False)
        self.said = done.stdout
        return done.returncode

    def pods(self, job):
        return json.loads((self.state / f"parity-{job}.json").read_text(encoding="utf-8"))["codes"]

    def test_the_jobs_make_the_report_of_one_machine(self):
        fail_work(self.folder, 2, [75, 137])
        (self.volume / "night").mkdir()
        (self.volume / "night" / "plan.json").write_text("{}", encoding="utf-8") # of the night before
        self.assertEqual(self.run_night(), 2, self.said)
        self.assertEqual(len(self.pods("work")), SHARDS + 2, "two pods were tried again")
        self.assert_same(self.volume / "out")

    def test_a_shard_that_fails_thrice_leaves_the_others_and_can_run_again(self):
        fail_work(self.folder, 3, [75, 75, 75])
        self.assertEqual(self.run_night(), 4, self.said)
        self.assertEqual(len(self.pods("work")), SHARDS + 2)
        self.assertIn("a shard has failed", self.said)
        self.assertEqual(self.run_night("--again"), 2, self.said)
        self.assert_same(self.volume / "out")

    def test_another_build_ends_the_job_at_once(self):
        fail_work(self.folder, 3, [78])
        self.assertEqual(self.run_night(), 4, self.said)
        self.assertEqual(self.pods("work"), [0, 0, 0, 78])

    def test_other_words_are_an_error_of_usage(self):
        self.assertEqual(self.run_night("--once"), 64)
        self.assertEqual(list(self.state.iterdir()), [])

    def test_there_are_as_many_pods_as_shards(self):
        words = read_job("plan")["template"]["spec"]["containers"][0]["args"][0].split()
        self.assertEqual(words[words.index("--shards") + 1], str(read_job("work")["completions"]))

    def test_the_memory_is_enough_for_the_workers(self):
        container = read_job("work")["template"]["spec"]["containers"][0]
        given = dict(zip(container["args"], container["args"][1:]))
        workers = int(given["--jobs"]) * int(given["--memory"].removesuffix("G"))
        self.assertEqual(container["resources"]["limits"]["memory"], f"{workers + 1}Gi")


if __name__ == "__main__":
    main("__main__")
