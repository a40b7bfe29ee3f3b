"""A private Slurm cluster on loopback: one controller, nodes that are processes of this machine, a munge of its own.

It needs neither root, systemd nor cgroups, and leaves no process behind: whatever the cluster starts is a descendant of
this process, which adopts orphans (PR_SET_CHILD_SUBREAPER) and kills them at the end.
"""
import ctypes
import os
import pathlib
import pwd
import secrets
import shutil
import signal
import socket
import subprocess
import time

PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36 # linux/prctl.h
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "sinfo")
CPUS = 4 # of a node: what integrations/slurm/work.sbatch asks for, so a node runs one task at a time

LIBC = ctypes.CDLL(None, use_errno=True)


def user():
    """The name of this user, or nothing: a container may give a number alone, which Slurm does not take."""
    try:
        return pwd.getpwuid(os.getuid()).pw_name
    except KeyError:
        return ""


def what_is_missing():
    missing = [name for name in PROGRAMS if not shutil.which(name, path="/usr/sbin:/usr/bin")]
    return missing + ([] if user() else ["a name of this user"])


def free_ports(count):
    """Ports that no one listens on now, different ones."""
    sockets = [socket.socket() for _ in range(count)]
    try:
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]
    finally:
        for each in sockets:
            each.close()


def processes():
    """(pid, parent) of all processes."""
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                yield int(entry.name), int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
            except OSError: # it has ended
                continue


def descendants(root):
    found, all_processes = [root], list(processes())
    for pid in found: # grows as it is read
        found += [child for child, parent in all_processes if parent == pid]
    return found[1:]


def kill_descendants(root):
    """Kills until there are none: one may fork while the list is made."""
    while pids := descendants(root):
        for pid in pids:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        try:
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        except ChildProcessError:
            pass
        time.sleep(.05)


class Cluster:
    """with Cluster(folder, ["n1", "n2"], environment) as cluster: ... cluster.environment is that of sbatch and the like."""

    def __init__(self, folder, nodes, environment):
        self.folder = pathlib.Path(folder)
        self.nodes = nodes
        self.daemons = {}
        self.environment = dict(environment, SLURM_CONF=str(self.folder / "slurm.conf"))

    def __enter__(self):
        LIBC.prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
        try:
            self.start_munge()
            self.configure()
            self.start("slurmctld", "slurmctld", "-D")
            for node in self.nodes:
                self.start_node(node)
            self.wait(lambda: all(self.state(node) == "IDLE" for node in self.nodes), 60, "idle nodes")
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        kill_descendants(os.getpid())

    def start(self, name, *command):
        log = open(self.folder / f"{name}.out", "ab")
        self.daemons[name] = subprocess.Popen(
            command, env=self.environment, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
            preexec_fn=lambda: LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0))
        log.close()

    def start_munge(self):
        # munged wants folders that no one else can write to; a Unix socket's name has at most 107 bytes.
        munge = self.folder / "munge"
        munge.mkdir(mode=0o755)
        key = munge / "key"
        key.touch(mode=0o600)
        key.write_bytes(secrets.token_bytes(128))
        self.socket = munge / "socket"
        self.start("munged", "munged", "--foreground", "--force", f"--socket={self.socket}", f"--key-file={key}",
                   f"--pid-file={munge / 'pid'}", f"--seed-file={munge / 'seed'}", f"--log-file={munge / 'log'}")
        self.wait(self.socket.exists, 20, "munge's socket")

    def configure(self):
        host = socket.gethostname().split(".")[0]
        control, *ports = free_ports(1 + len(self.nodes))
        lines = [
            "ClusterName=parity",
            f"SlurmctldHost={host}(127.0.0.1)", f"SlurmctldPort={control}",
            f"SlurmUser={user()}", f"SlurmdUser={user()}",
            # cred_expire is also how long a task that is requeued waits.
            "AuthType=auth/munge", "CredType=cred/munge", f"AuthInfo=socket={self.socket},cred_expire=10",
            "ProctrackType=proctrack/linuxproc", "TaskPlugin=task/none", "JobAcctGatherType=jobacct_gather/none",
            "AccountingStorageType=accounting_storage/none", "MpiDefault=none",
            "CommunicationParameters=NoCtldInAddrAny,NoInAddrAny", # they listen on loopback only
            "SelectType=select/cons_tres", "SelectTypeParameters=CR_Core",
            "SlurmdParameters=config_overrides", # CPUs and memory are as written here, whatever the machine has
            "ReturnToService=2", "SlurmdTimeout=5", "SlurmctldTimeout=5", "KillWait=2", "JobRequeue=1",
            "SchedulerParameters=sched_min_interval=0,bf_interval=1,batch_sched_delay=0",
            f"StateSaveLocation={self.folder / 'state'}", f"SlurmdSpoolDir={self.folder / 'spool-%n'}",
            f"SlurmctldPidFile={self.folder / 'slurmctld.pid'}", f"SlurmdPidFile={self.folder / 'slurmd-%n.pid'}",
            f"SlurmctldLogFile={self.folder / 'slurmctld.log'}", f"SlurmdLogFile={self.folder / 'slurmd-%n.log'}",
        ]
        lines += [f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs={CPUS} RealMemory=16384"
                  for node, port in zip(self.nodes, ports)]
        lines += [f"PartitionName=all Nodes={','.join(self.nodes)} Default=YES MaxTime=INFINITE State=UP"]
        (self.folder / "state").mkdir()
        (self.folder / "slurm.conf").write_text("\n".join(lines) + "\n")

    def start_node(self, node):
        self.start(f"slurmd-{node}", "slurmd", "-D", "-N", node)

    def steps(self, node):
        """The processes of the tasks on a node, with their slurmstepd, which are no children of slurmd."""
        marked = f"SLURMD_NODENAME={node}".encode()
        steps = set()
        for pid, parent in processes():
            try:
                if marked in pathlib.Path(f"/proc/{pid}/environ").read_bytes().split(b"\0"):
                    steps |= {pid, parent} # slurmstepd itself has not the variable, what it runs has
            except OSError:
                continue
        return steps & set(descendants(os.getpid()))

    def hold(self, node, program):
        """Stops the program that a task on the node runs now, so that the task stays at work. The task's index in its array as
        text; empty where no task runs the program."""
        held = ""
        for pid in self.steps(node):
            try:
                process = pathlib.Path(f"/proc/{pid}")
                if (process / "exe").resolve().name != program:
                    continue
                os.kill(pid, signal.SIGSTOP)
                variables = dict(word.split(b"=", 1) for word in (process / "environ").read_bytes().split(b"\0") if b"=" in word)
                held = variables[b"SLURM_ARRAY_TASK_ID"].decode()
            except (OSError, KeyError): # it has ended
                continue
        return held

    def kill_node(self, node):
        """As if its power went off: slurmd and all that it started. How many processes of tasks there were."""
        daemon = self.daemons.pop(f"slurmd-{node}")
        daemon.kill()
        daemon.wait()
        steps = self.steps(node)
        for each in (signal.SIGSTOP, signal.SIGKILL): # else a slurmstepd that outlives its script would report that it failed
            for pid in steps:
                try:
                    os.kill(pid, each)
                except ProcessLookupError:
                    pass
        return len(steps)

    def run(self, *command):
        return subprocess.run(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, check=True,
                              text=True, timeout=60).stdout

    def state(self, node):
        """IDLE, MIXED, ALLOCATED, DOWN, ...; UNKNOWN where the controller does not answer."""
        try:
            shown = self.run("scontrol", "--oneliner", "show", "node", node)
        except subprocess.CalledProcessError:
            return "UNKNOWN"
        return next(word[len("State="):] for word in shown.split() if word.startswith("State="))

    def jobs(self):
        """Of each task that the controller remembers: its fields."""
        for line in self.run("scontrol", "--oneliner", "show", "jobs").splitlines():
            fields = dict(word.split("=", 1) for word in line.split() if "=" in word)
            if "JobId" in fields:
                yield fields

    def wait(self, condition, seconds, what):
        """Returns what the condition is when it holds."""
        end = time.monotonic() + seconds
        while not (holds := condition()):
            for name, daemon in self.daemons.items():
                if daemon.poll() is not None:
                    raise RuntimeError(f"{name} has ended with {daemon.returncode}: {self.tail(name)}")
            if time.monotonic() > end:
                raise TimeoutError(f"no {what} within {seconds} s")
            time.sleep(.2)
        return holds

    def tail(self, name):
        files = [file for file in (self.folder / f"{name}.out", self.folder / f"{name}.log") if file.exists()]
        return "\n".join(line for file in files for line in file.read_text(errors="replace").splitlines()[-8:])
