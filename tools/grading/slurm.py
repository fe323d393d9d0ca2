"""Grades on a cluster: one array of jobs, and a job for the page when it has ended.

Each job of the array judges a share of the submissions and leaves their results in
the shared folder. What a job did not finish (it was preempted, or its node is gone)
is not there, and the last job judges it. So nothing is lost or counted twice.
"""

import os
import shlex
import shutil
import subprocess
import sys

from tools.tree import BUILD, ROOT, Failure

MOST_JOBS = 100


def words_of(options):
    """This program's words again, without those of the engine."""
    words = [sys.executable, "-B", "-m", "tools.grading", options.folder.absolute(), options.stage]
    for name in ("out", "roster", "hidden"):
        if value := getattr(options, name):
            words += [f"--{name}", value.absolute()]
    words += ["--hide-names"] if options.hide_names else []
    return [str(word) for word in words]


def sbatch(name, words, folder, *options):
    """Submits a job; returns its number."""
    command = ["sbatch", "--parsable", f"--job-name={name}", f"--output={folder}/{name}-%A-%a.log"]
    command += [f"--chdir={ROOT}", "--requeue", *options, "--wrap", shlex.join(words)]
    environment = os.environ | {"LIGHTWALK_BUILD": str(BUILD)}
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode:
        raise Failure(f"sbatch: {(done.stderr or done.stdout).strip()}")
    return done.stdout.strip().split(";")[0]


def submit(whole, options):
    """The array, and the job that comes after it. Returns at once."""
    if not shutil.which("sbatch"):
        raise Failure("ENGINE=slurm: there is no sbatch on this machine")
    logs = whole.folder / "logs"
    logs.mkdir(parents=True, exist_ok=True)
    count = min(MOST_JOBS, len(whole.submissions))
    words = words_of(options)
    share = shlex.join(words) + f' --jobs "${{SLURM_CPUS_ON_NODE:-1}}" --share "$SLURM_ARRAY_TASK_ID/{count}"'
    array = sbatch("class", ["sh", "-c", share], logs, f"--array=0-{count - 1}")
    last = sbatch("class-page", words, logs, f"--dependency=afterany:{array}")
    print(f"{len(whole.submissions)} submissions are judged by job {array}, {count} elements.")
    print(f"Job {last} then makes {whole.folder / 'index.html'}. `squeue` shows both.")
    return 0
