"""A Slurm of one node, for tests: Debian's munge, slurmctld and slurmd, started by hand
in a folder, without systemd. Needs root, as slurmd does."""

import contextlib
import os
import shutil
import subprocess
import time
from pathlib import Path

PORTS = 17617, 17618
CONFIGURATION = """\
ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
JobRequeue=1
MinJobAge=3600
SchedulerParameters=batch_sched_delay=0,sched_interval=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def why_not():
    """Why there can be no Slurm here, or nothing."""
    missing = [
        name for name in ("munged", "mungekey", "slurmctld", "slurmd", "sbatch") if not shutil.which(name)
    ]
    if missing:
        return f"{', '.join(missing)} missing: tools/setup.sh slurm"
    return "" if os.geteuid() == 0 else "slurmd needs root"


@contextlib.contextmanager
def slurm(folder):
    """Runs it; SLURM_CONF in the environment leads to it."""
    folder = Path(folder)
    for name in ("state", "spool"):
        (folder / name).mkdir(parents=True)
    host = os.uname().nodename.split(".")[0]
    text = CONFIGURATION.format(host=host, folder=folder, ports=PORTS, cpus=os.cpu_count())
    (folder / "slurm.conf").write_text(text)
    key, socket = folder / "munge.key", folder / "munge.socket"
    for path in (folder, *folder.parents[:-1]):
        path.chmod(path.stat().st_mode | 0o711 & ~0o022)
    subprocess.run(["mungekey", "-c", "-k", key], check=True)
    os.environ["SLURM_CONF"] = str(folder / "slurm.conf")
    commands = [
        ["munged", "-F", "-f", "--key-file", key, "-S", socket, "--pid-file", folder / "munged.pid", "--log-file",
         folder / "munged.log", "--seed-file", folder / "munged.seed"],
        ["slurmctld", "-D"],
        ["slurmd", "-D", "-N", host],
    ]  # fmt: skip
    running = []
    quiet = {name: subprocess.DEVNULL for name in ("stdin", "stdout", "stderr")}
    try:
        for command in commands:
            running.append(subprocess.Popen(command, **quiet))
            time.sleep(1)
        for _ in range(60):
            said = subprocess.run(["sinfo", "-h", "-o", "%t"], capture_output=True, text=True)
            if said.stdout.strip() in ("idle", "mix", "alloc"):
                break
            time.sleep(1)
        else:
            logs = "".join((folder / f"{name}.log").read_text()[-2000:] for name in ("slurmctld", "slurmd"))
            raise RuntimeError(f"Slurm does not come up: {said.stdout}{said.stderr}\n{logs}")
        yield
    finally:
        del os.environ["SLURM_CONF"]
        for process in reversed(running):
            process.terminate()
        for process in running:
            process.wait()


def wait_for_jobs():
    while subprocess.run(["squeue", "-h"], capture_output=True, text=True, check=True).stdout.strip():
        time.sleep(0.5)
