#!/usr/bin/env python3
"""The manifests of integrations/kubernetes obey Kubernetes' published schema: kubernetes_schema_test.py TYPES TSC

TYPES is a folder with the npm package kubernetes-types: the OpenAPI definitions as TypeScript, where optional fields,
required ones and their types are told apart. TSC is TypeScript's compiler, which also refuses a field that is not there.
"""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import yaml

MANIFESTS = sorted((pathlib.Path(__file__).resolve().parents[2] / "integrations" / "kubernetes").glob("*.yaml"))
TYPES = TSC = ""


def errors_of(objects):
    """For each object by its name: what the compiler says of it."""
    with tempfile.TemporaryDirectory(dir=TYPES) as folder: # whose packages it then finds
        lines = ['import type { Job } from "kubernetes-types/batch/v1";',
                 'import type { PersistentVolumeClaim } from "kubernetes-types/core/v1";']
        first = len(lines) + 1
        lines += [f"export const object{number}: {each['kind']} = {json.dumps(each)};"
                  for number, each in enumerate(objects.values())]
        file = pathlib.Path(folder) / "manifests.ts"
        file.write_text("\n".join(lines), encoding="utf-8")
        done = subprocess.run([TSC, "--noEmit", "--strict", "--module", "nodenext", file.name], cwd=folder,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=200, check=False)
    found = {name: [] for name in objects}
    for line in done.stdout.splitlines():
        if line.startswith(f"{file.name}("):
            found[list(objects)[int(line.split("(")[1].split(",")[0]) - first]].append(line)
    if done.returncode and not any(found.values()):
        raise AssertionError(done.stdout)
    return found


class Schema(unittest.TestCase):
    def read(self):
        return {file.name: yaml.safe_load(file.read_text(encoding="utf-8")) for file in MANIFESTS}

    def test_every_manifest_obeys_it(self):
        manifests = self.read()
        self.assertEqual(list(manifests), ["merge.yaml", "plan.yaml", "volume.yaml", "work.yaml"])
        for name, errors in errors_of(manifests).items():
            self.assertEqual(errors, [], name)

    def test_what_does_not_obey_it_is_found(self):
        job = self.read()["work.yaml"]
        wrong = {}

        def change(name, edit):
            wrong[name] = copy.deepcopy(job)
            edit(wrong[name]["spec"])

        change("an unknown field", lambda spec: spec.update(backoffLimitPerIndexes=2))
        change("a text for a number", lambda spec: spec.update(completions="64"))
        change("an unknown field of a container", lambda spec: spec["template"]["spec"]["containers"][0].update(arguments=[]))
        change("a rule without an action", lambda spec: spec["podFailurePolicy"]["rules"][0].pop("action"))
        change("a mount without a path", lambda spec: spec["template"]["spec"]["containers"][0]["volumeMounts"][0].pop("mountPath"))
        for name, errors in errors_of(wrong).items():
            self.assertEqual(len(errors), 1, name)

    # What the API server asks for beyond types: https://kubernetes.io/docs/concepts/workloads/controllers/job/
    def test_the_retry_of_an_index_has_what_it_depends_on(self):
        spec = self.read()["work.yaml"]["spec"]
        self.assertEqual(spec["completionMode"], "Indexed")
        self.assertEqual(spec["template"]["spec"]["restartPolicy"], "Never")
        self.assertNotIn("backoffLimit", spec)
        container = spec["template"]["spec"]["containers"][0]["name"]
        for rule in spec["podFailurePolicy"]["rules"]:
            self.assertIn(rule["action"], ("FailJob", "FailIndex", "Ignore", "Count"))
            self.assertEqual(len({"onExitCodes", "onPodConditions"} & set(rule)), 1, "one of both")
            if "onExitCodes" in rule:
                codes = rule["onExitCodes"]
                self.assertIn(codes["operator"], ("In", "NotIn"))
                self.assertEqual(codes["values"], sorted(set(codes["values"])))
                self.assertNotIn(0, codes["values"])
                self.assertEqual(codes["containerName"], container)


if __name__ == "__main__":
    TYPES, TSC = sys.argv.pop(1), sys.argv.pop(1)
    unittest.main()
