# SPDX-License-Identifier: BSD-3-Clause
"""Signals, limits, odd files, full disks, odd environments, two runs at once."""

import os
import re
import resource
import shutil
import signal
import subprocess
from random import Random

import scene
from command import Ended, as_status, judge, text
from damaged import RESUME, RUN, prepare
from studies import STUDY, TABLE, prepare_study, tables_differ

KEEPING = [*RUN, "--checkpoint-interval", "0"]
RUN_SECONDS = 0.5  # s, in which a moment is drawn


def _end_at_a_moment(limber, random, by):
    moment = random.uniform(0.0, RUN_SECONDS)
    return limber.run_until(*KEEPING, moment=moment, by=by)


def _resume_to_the_whole(limber, problems):
    """Whatever happened before, a resume gives what an undisturbed run does."""
    ended = limber.run(*RESUME)
    problems += ended.problems
    if ended.status != 0:
        problems.append(f"resume: status {ended.status}: {ended.errors[-200:]}")
        return
    differs = scene.answers_differ(limber.place / "out", prepare(limber) / "whole")
    if differs:
        problems.append(f"resume: {differs}")


def attack_kill(seed, limber):
    """kill -9 at a random moment, then --resume."""
    prepare(limber)
    scene.lay_out(limber.place)
    ended = _end_at_a_moment(limber, Random(f"kill {seed}"), signal.SIGKILL)
    _resume_to_the_whole(limber, ended.problems)
    return ended


def attack_signal(seed, limber):
    """SIGINT and SIGTERM end a run with results and a checkpoint."""
    prepare(limber)
    random = Random(f"signal {seed}")
    by = random.choice([signal.SIGINT, signal.SIGTERM])
    scene.lay_out(limber.place)
    ended = _end_at_a_moment(limber, random, by)
    # Before its handlers are there, the signal's own way.
    if ended.status not in (0, 128 + by):
        ended.problems.append(f"status {ended.status} after {by.name}")
    if ended.seconds > 2.0:
        ended.problems.append(f"ended {ended.seconds:.1f} s after {by.name}")
    _resume_to_the_whole(limber, ended.problems)
    return ended


def _limit(kind, most):
    return lambda: resource.setrlimit(kind, (most, most))


MEGABYTE = 1 << 20
LIMITS = (
    [(f"memory {n} MB", _limit(resource.RLIMIT_AS, n * MEGABYTE))
     for n in (50, 100, 150, 200, 250, 300, 400, 500, 700, 1000, 2000)]
    + [(f"file size {n}", _limit(resource.RLIMIT_FSIZE, n))
       for n in (0, 1, 100, 1000, 4096, 10000, 100000, 1000000)]
    + [(f"{n} open files", _limit(resource.RLIMIT_NOFILE, n))
       for n in (3, 4, 5, 6, 8, 10, 16, 32)]
    + [(f"stack {n} kB", _limit(resource.RLIMIT_STACK, n << 10))
       for n in (64, 256, 1024)]
    + [("one process", _limit(resource.RLIMIT_NPROC, 1))]
)

LIMITED = [RUN, STUDY, ["view", "whole"], ["export", "whole", "-o", "out.glb"]]


def attack_limit(number, limber):
    """A limit ends a run in words, or does not matter."""
    name, before = LIMITS[number % len(LIMITS)]
    words = LIMITED[number // len(LIMITS)]
    prepared = prepare(limber)
    prepare_study(limber)
    scene.lay_out(limber.place)
    shutil.copytree(prepared / "whole", limber.place / "whole")
    ended = limber.run(*words, before=before)
    if name.startswith(("memory", "stack", "3 open", "4 open")) and (
        ended.status == 127
    ):
        ended.problems.clear()  # the loader's word, before any of ours
    if words is RUN:
        _expect_the_answer(limber, ended, prepared)
    elif words is STUDY and ended.status == 0 and tables_differ(limber):
        ended.problems.append(f"status 0 and {tables_differ(limber)}")
    return ended


LIMIT_COUNT = len(LIMITS) * len(LIMITED)


def _expect_the_answer(limber, ended, prepared):
    if ended.status != 0:
        return
    differs = scene.answers_differ(limber.place / "out", prepared / "whole")
    if differs:
        ended.problems.append(f"status 0 and {differs}")


def _make_program(place, name, script):
    folder = place / "bin"
    folder.mkdir(exist_ok=True)
    (folder / name).write_text("#!/bin/sh\n" + script)
    (folder / name).chmod(0o755)
    return f"{folder}:{os.environ['PATH']}"


ENVIRONMENTS = {
    "no HOME, no cache": {"HOME": None, "LIMBER_CACHE": None},
    "no HOME": {"HOME": None},
    "HOME is no folder": {"HOME": "/dev/null", "LIMBER_CACHE": None},
    "relative cache": {"LIMBER_CACHE": "cache here"},
    "cache is a file": {"LIMBER_CACHE": "/etc/passwd"},
    "empty cache": {"LIMBER_CACHE": ""},
    "no TMPDIR": {"TMPDIR": None},
    "TMPDIR is not there": {"TMPDIR": "/nowhere/at/all"},
    "TMPDIR cannot be written": {"TMPDIR": "/proc"},
    "nothing": {"HOME": None, "TMPDIR": None, "PATH": None},
    "no PATH": {"PATH": "/nowhere"},
    "German": {"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8"},
    "no such locale": {"LC_ALL": "xx_YY"},
    "one thread": {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
    "two threads": {"OMP_NUM_THREADS": "2", "OPENBLAS_NUM_THREADS": "2"},
    "many threads": {"OMP_NUM_THREADS": "1000"},
    "no number of threads": {"OMP_NUM_THREADS": "x"},
    "traps": {"GLIBC_TUNABLES": "glibc.malloc.perturb=165"},
    "old settings": {"GMSH_HOME": "/nowhere", "HDF5_DISABLE_VERSION_CHECK": "2"},
}
GNUPLOTS = {
    "gnuplot hangs": "sleep 1000",
    "gnuplot fails": "exit 1",
    "gnuplot dies": "kill -9 $$",
    "gnuplot says no": "echo no >&2; cat >/dev/null; exit 3",
}


def attack_environment(number, limber):
    """An odd environment changes no answer."""
    place = prepare(limber)
    scene.lay_out(limber.place)
    name = [*ENVIRONMENTS, *GNUPLOTS][number]
    changes = ENVIRONMENTS.get(name, {})
    cache = []
    if name in GNUPLOTS:
        changes = {"PATH": _make_program(limber.place, "gnuplot", GNUPLOTS[name])}
        scenario = scene.read("arm.toml").replace("pictures = false", "")
        (limber.place / "arm.toml").write_text(scenario)
        limber.run(*scene.run_words("arm", "whole"))  # the file records the scenario
        place = limber.place
    elif "cache" not in name and "HOME" not in name:
        cache = ["--cache", "fresh_cache"]
    ended = limber.run(*RUN, *cache, environment=changes)
    if ended.stopped:
        ended.problems.append("took more than 30 s")
    _expect_the_answer(limber, ended, place)
    return ended


ENVIRONMENT_COUNT = len(ENVIRONMENTS) + len(GNUPLOTS)


def _fifo(path):
    os.mkfifo(path)


def _sparse(path):
    with open(path, "wb") as file:
        file.truncate(1 << 36)


ODD_FILES = {
    "fifo": _fifo,
    "zeros": lambda path: path.symlink_to("/dev/zero"),
    "folder": lambda path: path.mkdir(),
    "empty": lambda path: path.touch(),
    "huge": _sparse,
    "itself": lambda path: path.symlink_to(path),
    "full": lambda path: path.symlink_to("/dev/full"),
    "memory": lambda path: path.symlink_to("/proc/self/mem"),
}
# The place, and what is run; of the others the run that reads them.
ODD_PLACES = {
    "arm.toml": RUN, "arm.urdf": RUN, "bar.geo": RUN, "bar.msh": RUN,
    "bar.step": RUN, "body.h5": RUN, "values.txt": RUN,
    "checkpoint.bin": RESUME,
    "block.stl": scene.run_words("craft"), "wedge.obj": scene.run_words("craft"),
    "nodes.txt": scene.run_words("craft"), "u.txt": scene.run_words("craft"),
    "study.toml": STUDY, TABLE: STUDY,
    "parts.sqlite": ["study", "--collect", "parts.sqlite", "--out", "all"],
    "from.sqlite": ["run", "--from", "from.sqlite#0", "--out", "out"],
    "results.h5": ["view", "results.h5"],
    "motion.h5": ["export", "motion.h5", "-o", "out.glb"],
    "info.h5": ["info", "info.h5"],
}


def _put_odd_file(limber, name, make):
    """Puts a file in the place of one that the scene reads."""
    place = limber.place
    path = place / name
    if name in ("checkpoint.bin", TABLE):
        (place / "out").mkdir()
        path = place / "out" / name
    elif name in ("bar.msh", "bar.step"):
        robot = scene.read("arm.urdf").replace("bar.geo", name)
        (place / "arm.urdf").write_text(robot)
    elif name == "body.h5":
        begin = '<mesh file="bar.geo" unit="m"/>'
        robot = scene.read("arm.urdf").replace(begin, '<reduced file="body.h5"/>')
        # These a saved body has of its own.
        robot = re.sub(r"<(material y|basis |interface )[^>]*/>", "", robot)
        (place / "arm.urdf").write_text(robot)
        scenario = re.sub(r"\[basis\]\n[^\[]*", "", scene.read("arm.toml"))
        (place / "arm.toml").write_text(scenario)
    elif name == "values.txt":
        scenario = scene.read("arm.toml").replace(
            "times = [0.0, 0.3, 0.4], values = [0.0, 0.0, 1.0]",
            'file = "values.txt"',
        )
        (place / "arm.toml").write_text(scenario)
    if path.exists():
        path.unlink()
    make(path)


def attack_odd_file(number, limber):
    """What is no file of the expected kind is refused at once; an empty file is a
    table without runs."""
    name = list(ODD_PLACES)[number // len(ODD_FILES)]
    kind = list(ODD_FILES)[number % len(ODD_FILES)]
    scene.lay_out(limber.place)
    _put_odd_file(limber, name, ODD_FILES[kind])
    ended = limber.run(*ODD_PLACES[name], before=_limit(resource.RLIMIT_AS, 4 << 30))
    if ended.status != (0 if (name, kind) == (TABLE, "empty") else 2):
        ended.problems.append(f"{kind} as {name}: status {ended.status}")
    if ended.seconds > 5.0:
        ended.problems.append(f"{kind} as {name}: {ended.seconds:.0f} s")
    return ended


ODD_FILE_COUNT = len(ODD_PLACES) * len(ODD_FILES)

OUTPUTS = [["run", "arm.toml", "--out", "out"],
           ["run", "arm.toml", "--out", "out", "--json"],
           ["info", "arm.urdf"], ["--help"], ["--version"],
           ["frequencies", "arm.toml"], ["frequencies", "arm.toml", "--json"],
           ["modes", "bar.geo", *scene.MATERIAL],
           ["study", "study.toml", "--out", "out", "--json"],
           ["view", "whole"], ["export", "whole", "-o", "out.glb"]]


def attack_stream(number, limber):
    """Words that cannot be said are an error, not a success."""
    scene.lay_out(limber.place)
    shutil.copytree(prepare(limber) / "whole", limber.place / "whole")
    words = OUTPUTS[number // 3]
    kind = ["full", "closed", "pipe"][number % 3]
    if kind == "full":
        with open("/dev/full", "w") as full:
            ended = limber.run(*words, stdout=full)
    elif kind == "closed":
        ended = limber.run(*words, before=lambda: os.close(1))
    else:
        read, write = os.pipe()
        os.close(read)
        ended = limber.run(*words, stdout=write)
        os.close(write)
    if ended.status == 0:
        ended.problems.append(f"{' '.join(words)}: {kind} output was a success")
    return ended


STREAM_COUNT = 3 * len(OUTPUTS)


DISKS = ["size=4k", "size=16k", "size=64k", "size=256k", "size=512k",
         "size=1m", "size=1m,nr_inodes=3", "size=16m,ro"]
# What is written, and where; the disk is the folder `out`.
DISK_COMMANDS = [
    (KEEPING, "results.h5"),
    (STUDY, "study.csv"),
    (["view", "whole", "-o", "out/view.html"], "view.html"),
    (["export", "whole", "-o", "out/scene.glb"], "scene.glb"),
]


def _run_on_disk(limber, words, options):
    """Runs with a small file system under `out`, whose files go to `kept`."""
    for name in ("out", "kept"):
        (limber.place / name).mkdir()
    script = (
        f"mount -t tmpfs -o {options} tmpfs out && "
        f"{{ {limber.program} {' '.join(words)}; end=$?; }} && "
        f"cp -r out/. kept && exit $end"
    )
    child = subprocess.run(
        ["unshare", "-m", "sh", "-c", script], cwd=limber.place,
        env=limber.environment(), capture_output=True, timeout=120,
    )
    return Ended(as_status(child.returncode), text(child.stdout),
                 text(child.stderr), 0.0)


def attack_disk(number, limber):
    """A full or read-only disk loses nothing without a word."""
    words, name = DISK_COMMANDS[number // len(DISKS)]
    scene.lay_out(limber.place)
    shutil.copytree(prepare(limber) / "whole", limber.place / "whole")
    ended = _run_on_disk(limber, words, DISKS[number % len(DISKS)])
    if "permission denied" in ended.errors.lower() and os.geteuid() != 0:
        return ended  # only root may mount
    ended.problems += judge(ended)
    if ended.status == 0:
        limber.run(*words)
        kept, whole = (limber.place / at / name for at in ("kept", "out"))
        if not kept.exists() or kept.read_bytes() != whole.read_bytes():
            ended.problems.append(f"status 0 and another {name}")
    return ended


DISK_COUNT = len(DISKS) * len(DISK_COMMANDS)


def attack_two(seed, limber):
    """Of two runs in one folder one is refused and names the other."""
    prepared = prepare(limber)
    random = Random(f"two {seed}")
    scene.lay_out(limber.place)
    ended, statuses = limber.run_twice(*KEEPING, apart=random.uniform(0.0, 0.3))
    if statuses == [0, 0]:
        ended.problems.append("both succeeded")
    _expect_the_answer(limber, ended, prepared)
    shutil.rmtree(limber.place / "out", ignore_errors=True)
    return ended
