#!/usr/bin/env python3
"""integrations/gitlab, run as GitLab runs it: gitlab_test.py PARITY [unittest options...]

Each job has a checkout of its own. What it leaves of its artifacts' paths is all that later jobs see.
"""
import re
import shutil
import subprocess

import yaml

from night import INTEGRATIONS, Night, fail_work, main


def read_jobs():
    """The jobs with what they extend, and the stages."""
    text = yaml.safe_load((INTEGRATIONS / "gitlab" / "parity.yml").read_text(encoding="utf-8"))
    jobs = {name: dict(text[job["extends"]], **job) for name, job in text.items() if name != "stages" and not name.startswith(".")}
    return jobs, text["stages"]


class Pipeline(Night):
    def setUp(self):
        super().setUp()
        self.jobs, _ = read_jobs()
        self.artifacts = {} # of a job's name: folders, one for each of its parallel jobs

    def run_job(self, name, index=None):
        """The exit code of the last attempt, and how many there were. An attempt starts from a fresh checkout."""
        job = self.jobs[name]
        for attempt in range(1 + job.get("retry", {}).get("max", 0)):
            folder = self.checkout(name)
            for need in job.get("needs", []):
                for artifact in self.artifacts.get(need, {}).values():
                    shutil.copytree(artifact, folder, dirs_exist_ok=True)
            environment = dict(self.environment, CI_PROJECT_DIR=str(folder), **(
                {"CI_NODE_INDEX": str(index), "CI_NODE_TOTAL": str(job["parallel"])} if index else {}))
            for variable, value in job["variables"].items():
                environment[variable] = re.sub(r"\$(\w+)", lambda match: environment[match.group(1)], value)
            caches = self.made / "caches" / str(index)
            for path in job.get("cache", {}).get("paths", []):
                if (caches / path).exists():
                    shutil.copytree(caches / path, folder / path)
            done = subprocess.run(["bash", "-eo", "pipefail", "-c", "\n".join(job["script"])], cwd=folder, env=environment,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  timeout=300, check=False)
            self.said = done.stdout
            for path in job.get("cache", {}).get("paths", []):
                if (folder / path).exists():
                    shutil.copytree(folder / path, caches / path, dirs_exist_ok=True)
            if done.returncode == 0 or job["artifacts"].get("when") == "always":
                kept = self.folder / "artifacts" / f"{name}-{index}"
                shutil.rmtree(kept, ignore_errors=True)
                for path in job["artifacts"]["paths"]:
                    if (folder / path).exists():
                        shutil.copytree(folder / path, kept / path)
                self.artifacts.setdefault(name, {})[index] = kept
            if done.returncode not in job.get("retry", {}).get("exit_codes", []):
                break
        return done.returncode, attempt + 1

    def run_work(self, indices=None):
        return {index: self.run_job("work", index) for index in indices or range(1, 1 + self.jobs["work"]["parallel"])}

    def test_the_jobs_make_the_report_of_one_machine(self):
        self.assertEqual(self.run_job("plan"), (0, 1), getattr(self, "said", ""))
        fail_work(self.folder, 2, [75])
        worked = self.run_work()
        self.assertEqual(worked.pop(2), (0, 2), "exit code 75 is tried again")
        self.assertEqual(set(worked.values()), {(0, 1)}, self.said)
        self.assertEqual(self.run_job("merge")[0], 2, self.said)
        self.assert_same(self.artifacts["merge"][None] / "parity-report")

    def test_a_shard_that_fails_is_an_error_of_the_merge_and_can_run_again(self):
        self.assertEqual(self.run_job("plan"), (0, 1))
        fail_work(self.folder, 3, [78])
        worked = self.run_work()
        self.assertEqual(worked.pop(3), (78, 1), "another build is not tried again")
        self.assertEqual(set(worked.values()), {(0, 1)})
        self.assertEqual(self.jobs["merge"]["when"], "always")
        self.assertEqual(self.run_job("merge")[0], 4, self.said)
        self.assertEqual(self.run_work([3]), {3: (0, 1)}, self.said)
        self.assertEqual(self.run_job("merge")[0], 2, self.said)
        self.assert_same(self.artifacts["merge"][None] / "parity-report")

    def test_there_are_as_many_jobs_as_shards(self):
        self.assertIn(f"--shards {self.jobs['work']['parallel']} ", self.jobs["plan"]["script"][0])

    def test_a_job_needs_only_jobs_of_earlier_stages(self):
        jobs, stages = read_jobs()
        for name, job in jobs.items():
            self.assertEqual(job["image"]["entrypoint"], [""], "the image's own is parity, and GitLab needs a shell")
            for need in job.get("needs", []):
                self.assertLess(stages.index(jobs[need]["stage"]), stages.index(job["stage"]), name)


if __name__ == "__main__":
    main("__main__")
