#!/usr/bin/env python3
"""The calls of kubectl that integrations/kubernetes/run makes, answered by processes of this machine.

`create` runs a Job as its controller does: indices, retries of an index and podFailurePolicy. A pod is the program with
the container's arguments and variables, in FAKE_VOLUME, which stands for the folder that the volume is mounted at.
"""
import json
import os
import pathlib
import subprocess
import sys

import yaml

STATE = pathlib.Path(os.environ["FAKE_STATE"])
VOLUME = os.environ["FAKE_VOLUME"]


def run_pod(spec, index):
    """Its exit code; what it prints is added to the job's log."""
    container = spec["template"]["spec"]["containers"][0]
    mount = container["volumeMounts"][0]["mountPath"]
    environment = dict(os.environ, **{each["name"]: each["value"].replace(mount, VOLUME) for each in container["env"]})
    if index is not None:
        environment["JOB_COMPLETION_INDEX"] = str(index) # the Job controller's own variable
    command = container.get("command", ["parity"]) # the image's own entry point
    done = subprocess.run([*command, *container["args"]], cwd=container["workingDir"].replace(mount, VOLUME), env=environment,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.returncode, done.stdout


def action_of(code, spec):
    """What podFailurePolicy says of an exit code: the first rule that matches counts."""
    for rule in spec.get("podFailurePolicy", {}).get("rules", []):
        codes = rule.get("onExitCodes")
        if codes and (code in codes["values"]) == (codes["operator"] == "In"):
            return rule["action"]
    return "Count"


def run_job(spec):
    """Conditions as `kubectl get` prints them, the pods' exit codes in their order, and what they printed."""
    indices = range(spec["completions"]) if spec.get("completionMode") == "Indexed" else [None]
    retries = spec.get("backoffLimitPerIndex", spec.get("backoffLimit"))
    codes, said, failed = [], "", False
    for index in indices:
        for attempt in range(1 + retries):
            code, printed = run_pod(spec, index)
            codes.append(code)
            said += printed
            if code == 0:
                break
            if action_of(code, spec) == "FailJob":
                return "FailureTarget Failed", codes, said
            failed = failed or attempt == retries
    return "FailureTarget Failed" if failed else "SuccessCriteriaMet Complete", codes, said


def main(words):
    file = lambda name: STATE / f"{name}.json"
    if words[0] == "delete":
        file(words[-1]).unlink(missing_ok=True)
    elif words[0] == "create":
        job = yaml.safe_load(pathlib.Path(words[2]).read_text(encoding="utf-8"))
        assert not file(job["metadata"]["name"]).exists(), "AlreadyExists"
        conditions, codes, said = run_job(job["spec"])
        file(job["metadata"]["name"]).write_text(json.dumps({"conditions": conditions, "codes": codes, "said": said}), encoding="utf-8")
    elif words[:2] == ["get", "job"]:
        print(json.loads(file(words[2]).read_text(encoding="utf-8"))["conditions"], end="")
    elif words[:2] == ["get", "pods"]:
        print(json.loads(file(words[3].removeprefix("job-name=")).read_text(encoding="utf-8"))["codes"][0], end="")
    elif words[0] == "logs":
        print(json.loads(file(words[-1].removeprefix("job/")).read_text(encoding="utf-8"))["said"], end="")
    else:
        raise SystemExit(f"kubectl {' '.join(words)}: not one of the calls that are known")


main(sys.argv[1:])
