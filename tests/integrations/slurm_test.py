#!/usr/bin/env python3
"""integrations/slurm on a real Slurm: slurm_test.py PARITY

A private cluster of two nodes compares 24 scenes in 12 shards. One task ends with 75, and one node dies in the middle of a
shard. Slurm runs both shards again, and the merged report has the bytes of `parity report`. Then a unit is lost, and `submit`
makes it again.
Exit code 77: there is no Slurm here (packages slurm-wlm and munge).
"""
import json
import pathlib
import shutil
import signal
import sys
import tempfile
import time

from night import INTEGRATIONS, differences, fail_work, make_environment, pictures, run, write_suite
from slurm_cluster import Cluster, what_is_missing

SCENES, SHARDS, LIMIT_S = 24, 12, 420
FAILING = 0 # the shard whose first try ends with 75
SUBMIT = INTEGRATIONS / "slurm" / "submit"
OPTIONS = ["--suite", "assets/night.toml", "--size", "96x96"]
started = time.monotonic()


def log(text):
    print(f"{time.monotonic() - started:6.1f} s  {text}", flush=True)


def check(holds, text):
    if not holds:
        raise AssertionError(text)


def tasks_of(cluster, job):
    """The tasks of an array job by their shards."""
    return {int(task["ArrayTaskId"]): task for task in cluster.jobs()
            if task.get("ArrayJobId") == job and task.get("ArrayTaskId", "").isdigit()}


def job_of(cluster, job):
    return next(each for each in cluster.jobs() if each["JobId"] == job)


def submit(cluster, folder, *words):
    """The ids of the array job, or none, and of the merge."""
    said = run([SUBMIT, *words], folder, cluster.environment)
    for line in said.splitlines():
        if line.startswith(("work:", "merge:")):
            log(f"submit | {line}")
    jobs = {line.split(":")[0]: line.split()[2].rstrip(",") for line in said.splitlines()
            if line.startswith(("work:", "merge:"))}
    return jobs.get("work"), jobs["merge"]


def wait_for_end(cluster, job):
    """How the merge has ended: its state and exit code."""
    cluster.wait(lambda: job_of(cluster, job)["JobState"] not in ("PENDING", "RUNNING", "COMPLETING"), 300, "end of the merge")
    ended = job_of(cluster, job)
    return ended["JobState"], int(ended["ExitCode"].split(":")[0])


def kill_a_node_at_work(cluster, node, job):
    """The shard that it was working on."""
    cluster.wait(lambda: sum(task["JobState"] == "COMPLETED" for task in tasks_of(cluster, job).values()) >= 2, 120, "two shards")
    shard = int(cluster.wait(lambda: cluster.hold(node, "parity"), 120, f"task on {node}"))
    killed = cluster.kill_node(node)
    log(f"{node}: slurmd and {killed} processes of shard {shard} killed")
    check(killed >= 3, "no shard was at work") # slurmstepd, the script, parity
    cluster.wait(lambda: cluster.state(node).startswith("DOWN"), 90, f"{node} that is down")
    log(f"{node}: down; shard {shard} waits again")
    cluster.start_node(node)
    cluster.wait(lambda: cluster.state(node) in ("IDLE", "ALLOCATED", "MIXED"), 60, f"{node} back in service")
    log(f"{node}: slurmd started again, in service")
    return shard


def test(program, folder):
    environment = make_environment(folder, program)
    for words in ([], ["night"], ["-x", "night", "out"], ["night", "out", "--suite", "assets/night.toml"]):
        run([SUBMIT, *words], folder, environment, expected=(64,))
    write_suite(folder / "assets" / "night.toml", SCENES, SCENES - 1) # long enough that a node can die at work
    alone = make_environment(folder / "alone", program) # another cache: nothing of the cluster's is recalled
    run(["parity", "report", *OPTIONS, "-o", "reference"], folder, alone, expected=(2,))
    log(f"parity report of {SCENES} scenes: {pictures(folder / 'reference')} pictures, exit code 2")

    (folder / "slurm").mkdir()
    with Cluster(folder / "slurm", ["n1", "n2"], environment) as cluster:
        log("cluster: controller, nodes n1 and n2")
        fail_work(folder, FAILING, [75])
        work, merge = submit(cluster, folder, "-k", "8", "night", "out", "--", *OPTIONS, "--shards", str(SHARDS))
        lost = kill_a_node_at_work(cluster, "n2", work)
        state, code = wait_for_end(cluster, merge)
        tasks = tasks_of(cluster, work)
        for shard, task in sorted(tasks.items()):
            log(f"shard {shard:2}: {task['JobState'].lower()} on {task['NodeList']}, exit code {task['ExitCode'].split(':')[0]}, "
                f"{task['Restarts']} restarts")
        check(set(tasks) == set(range(SHARDS)), "the array has other tasks than the plan has shards")
        check(all(task["ExitCode"] == "0:0" for task in tasks.values()), "a shard failed")
        restarted = {shard for shard, task in tasks.items() if task["Restarts"] != "0"}
        check(restarted == {lost, FAILING}, f"other shards ran again than that of the dead node and the one that ended with 75")
        log(f"merge: {state.lower()}, exit code {code}")
        check(code == 2, (folder / "night/logs/merge.log").read_text())
        compare(folder)

        lose_a_unit(folder)
        shutil.rmtree(folder / "out")
        check(run([SUBMIT.parent / "merge.sbatch", "night", "out"], folder, cluster.environment, expected=(4,)), "")
        log("a unit removed: merge has exit code 4")
        shutil.rmtree(folder / "out", ignore_errors=True)
        again, merge = submit(cluster, folder, "night", "out")
        state, code = wait_for_end(cluster, merge)
        check(len(tasks_of(cluster, again)) == 1, "more than the shard of the lost unit ran again")
        log(f"merge: {state.lower()}, exit code {code}")
        check(code == 2, (folder / "night/logs/merge.log").read_text())
        compare(folder)
        again, merge = submit(cluster, folder, "night", "out2")
        check(again is None, "shards were submitted although nothing was missing")
    log("cluster: ended")


def lose_a_unit(folder):
    units = sorted((folder / "night" / "units").glob("*.unit"))
    check(len(units) == SCENES, f"{len(units)} units of {SCENES} scenes")
    units[len(units) // 2].unlink()


def compare(folder):
    found = differences(folder / "out", folder / "reference")
    check(not found, "\n".join(found[:20]))
    rows = json.loads((folder / "out" / "report.json").read_text())
    check(len(rows["scenes"]) == SCENES, "report.json has other scenes")
    log(f"report.json and {pictures(folder / 'out')} pictures: the bytes of parity report")


def main():
    if missing := what_is_missing():
        print(f"skipped: there is not {', nor '.join(missing)} (packages slurm-wlm and munge)")
        return 77

    def give_up(number, _):
        raise TimeoutError(f"ended by {signal.Signals(number).name}; {LIMIT_S} s are allowed")

    for number in (signal.SIGALRM, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, give_up) # so that the cluster is ended, too
    signal.alarm(LIMIT_S) # before ctest kills this process, which then could not
    # A short name, as munge's socket lies in it.
    folder = pathlib.Path(tempfile.mkdtemp(prefix="parity-"))
    try:
        test(pathlib.Path(sys.argv[1]).resolve(), folder)
    except BaseException:
        for file in sorted([folder / "slurm" / "slurmctld.log", *folder.glob("night/logs/*")]):
            if file.exists():
                print(f"--- {file.relative_to(folder)}\n" + "\n".join(file.read_text(errors="replace").splitlines()[-12:]))
        raise
    finally:
        shutil.rmtree(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
