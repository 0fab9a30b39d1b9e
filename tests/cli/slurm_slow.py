#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does what docs/how-to/slurm.md says on a Slurm of this machine, with a node that dies.

  slurm_slow.py LIMBER SOURCE_FOLDER WORK_FOLDER

Status 77: Slurm cannot be started here.
"""
import os
import pathlib
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import threading
import time

limber, source, work = (pathlib.Path(text).resolve() for text in sys.argv[1:4])
sys.path.insert(0, str(source / "tests/support"))
from page_blocks import read_blocks  # noqa: E402

ROBOT = """<robot name='r'><link name='world'/>
<link name='sled'><inertial><mass value='3'/><inertia ixx='0.1' iyy='0.1'
  izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='rail' type='prismatic'><parent link='world'/><child link='sled'/>
  <axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='0' velocity='0'/>
</joint>
<spring name='coil' stiffness='10' free_length='1'>
  <from link='world' point='-1 0 0'/><to link='sled'/></spring></robot>
"""
SCENARIO = """robot = 'robot.urdf'
[time]
duration = 2.0
step = 1e-3
output_interval = 0.01
[[load]]
name = 'push'
link = 'sled'
force = [1, 0, 0]
[[probe]]
name = 'sled'
link = 'sled'
"""
STUDY = """scenario = 'scenario.toml'
[design]
kind = 'latin-hypercube'
samples = 1000
[[factor]]
name = 'force'
path = 'load.push.force.0'
uniform = [-2.0, 2.0]
[[factor]]
name = 'stiffness'
path = 'robot.spring.coil.stiffness'
log_range = [1.0, 100.0]
[[response]]
name = 'x'
probe = 'sled.ux'
"""


def prepare():
    shutil.rmtree(work, ignore_errors=True)
    (work / "bin").mkdir(parents=True)
    (work / "bin/limber").symlink_to(limber)
    for name, text in [("robot.urdf", ROBOT), ("scenario.toml", SCENARIO),
                       ("study.toml", STUDY)]:
        (work / name).write_text(text)
    os.chdir(work)
    os.environ["PATH"] = f"{work / 'bin'}:{os.environ['PATH']}"
    os.environ["LIMBER_CACHE"] = str(work / "cache")


def count_rows(file):
    try:
        with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as results:
            return results.execute("SELECT count(*) FROM runs").fetchone()[0]
    except sqlite3.Error:
        return 0


def find_processes(node):
    """The node's daemon, and, of each of its tasks, the shepherd and the rest."""
    here = pathlib.Path(os.environ["SLURM_HERE"])
    found = [int((here / f"{node}.pid").read_text())]
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            environment = (process / "environ").read_bytes()
            if f"SLURMD_NODENAME={node}\0".encode() in environment and \
                    str(here).encode() in environment:
                found.append(int(process.name))
                status = (process / "stat").read_text().rsplit(")", 1)[1]
                found.append(int(status.split()[1]))  # its parent
        except OSError:
            continue
    return {pid for pid in found if pid > 1 and pid != os.getpid()}


def count_restarts(task):
    jobs = subprocess.run(["scontrol", "show", "--oneliner", "jobs"], check=True,
                          capture_output=True, text=True).stdout.splitlines()
    job, = (line for line in jobs if f"ArrayTaskId={task} " in line)
    return int(re.search(r" Restarts=(\d+) ", job).group(1))


def kill_node(node, killed):
    """Once a task has rows and is not at its end: the node dies, and comes back."""
    while True:
        lines = subprocess.run(["squeue", "--noheader", "--states=R", "--format=%K %N"],
                               capture_output=True, text=True).stdout.split("\n")
        tasks = [line.split()[0] for line in lines if line.endswith(node)]
        rows = count_rows(f"parts/study-{tasks[0]}-of-8.sqlite") if tasks else 0
        if 5 <= rows <= 100:
            break
        time.sleep(0.05)
    for pid in find_processes(node):
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    killed["task"] = tasks[0]
    killed["rows"] = rows
    time.sleep(10)  # until the controller has missed it
    killed["daemon"] = subprocess.Popen(
        ["slurmd", "-D", "-N", node], env={**os.environ, "PATH": "/usr/sbin:/usr/bin:/bin"},
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def run_inside():
    """In the environment of scripts/slurm-here."""
    blocks = read_blocks(source / "docs/how-to/slurm.md")
    for block in blocks:
        if "file" in block.values:
            pathlib.Path(block.values["file"]).write_text(block.text)
    killed = {}
    killer = threading.Thread(target=kill_node, args=("here2", killed), daemon=True)
    killer.start()
    for block in blocks:
        if block.language == "sh" and not block.values:
            subprocess.run(["bash", "-euc", block.text], check=True)
    assert "task" in killed, "no task was killed"
    restarted = sorted(int(file.stem.split("-")[1])
                       for file in pathlib.Path(".").glob("strike-*.log")
                       if file.read_text().count("results in") > 0)
    assert restarted == list(range(1, 9)), f"tasks that ended: {restarted}"
    assert count_restarts(killed["task"]) == 1, "the killed task was not requeued"
    subprocess.run([limber, "study", "study.toml", "--out", "alone", "--csv"], check=True,
                   stdout=subprocess.DEVNULL)
    joined = pathlib.Path("whole/study.csv").read_bytes()
    assert joined == pathlib.Path("alone/study.csv").read_bytes(), "the tables differ"
    runs = [int(line.split(",")[0]) for line in joined.decode().split("\n")[1:] if line]
    assert runs == list(range(1000)), "rows are lost or doubled"
    print(f"task {killed['task']} was killed after {killed['rows']} of 125 runs; "
          "all 1000 rows are there once")
    killed["daemon"].kill()


def main():
    inside = [sys.executable, pathlib.Path(__file__).resolve(), limber, source, work,
              "inside"]
    prepare()
    return subprocess.run([source / "scripts/slurm-here", *inside]).returncode


if len(sys.argv) > 4:
    os.chdir(work)
    run_inside()
else:
    sys.exit(main())
