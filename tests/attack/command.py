# SPDX-License-Identifier: BSD-3-Clause
"""Runs the command as a stranger would, and judges how it ended."""

import ctypes
import os
import signal
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

PATIENCE = 60.0  # s, after which a command counts as hung
STOP_AFTER = 30.0  # s, after which a long run is asked to end
STOP_WITHIN = 10.0  # s, in which it has to
ALLOWED = {0, 2, 3, 130, 143}
PR_SET_CHILD_SUBREAPER = 36


@dataclass
class Ended:
    """How one command ended."""

    status: int  # as a shell counts: 128 + signal
    out: str
    errors: str
    seconds: float
    stopped: bool = False  # it was long and ended when asked
    problems: list[str] = field(default_factory=list)


def adopt_orphans():
    """Processes that outlive their parent become this process's children."""
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def _children():
    path = Path(f"/proc/{os.getpid()}/task/{os.getpid()}/children")
    return [int(word) for word in path.read_text().split()]


def find_orphans():
    """Ends what a command left running, and says what it was."""
    orphans = []
    for _ in range(100):  # 5 s: gigabytes of a killed mesher take the system two
        alive = []
        for child in _children():
            if os.waitpid(child, os.WNOHANG)[0] == 0:
                alive.append(child)
        if not alive:
            return []
        time.sleep(0.05)
    for child in alive:
        try:
            orphans.append(Path(f"/proc/{child}/comm").read_text().strip())
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
        except OSError:
            pass
    return orphans


class Limber:
    """The command under attack, in a folder of its own."""

    def __init__(self, program, place, cache):
        self.program = str(program)
        self.place = Path(place)
        self.cache = Path(cache)
        for name in ("home", "tmp"):
            (self.place / name).mkdir(exist_ok=True)

    def environment(self, changes=None):
        variables = {
            "PATH": os.environ["PATH"],
            "HOME": str(self.place / "home"),
            "TMPDIR": str(self.place / "tmp"),
            "LIMBER_CACHE": str(self.cache),
        }
        for name, value in (changes or {}).items():
            if value is None:
                variables.pop(name, None)
            else:
                variables[name] = value
        return variables

    def start(self, *words, environment=None, before=None, **streams):
        """Starts it in a session of its own. @param before runs in the child"""
        streams.setdefault("stdin", subprocess.DEVNULL)
        streams.setdefault("stdout", subprocess.PIPE)
        streams.setdefault("stderr", subprocess.PIPE)
        return subprocess.Popen(
            [self.program, *map(str, words)],
            cwd=self.place,
            env=self.environment(environment),
            preexec_fn=before,
            start_new_session=True,
            **streams,
        )

    def run(self, *words, **options):
        """Runs it to its end; a long run is asked to end after a while."""
        begin = time.monotonic()
        child = self.start(*words, **options)
        stopped = False
        try:
            out, errors = child.communicate(timeout=STOP_AFTER)
        except subprocess.TimeoutExpired:
            stopped = True
            out, errors = self._stop(child)
        seconds = time.monotonic() - begin
        ended = Ended(
            as_status(child.returncode), text(out), text(errors), seconds, stopped
        )
        ended.problems = judge(ended)
        return ended

    def run_until(self, *words, moment, by):
        """Runs it, with a signal after `moment` s, from which its seconds count."""
        child = self.start(*words)
        time.sleep(moment)
        child.send_signal(by)
        begin = time.monotonic()
        out, errors = child.communicate()
        return Ended(as_status(child.returncode), text(out), text(errors),
                     time.monotonic() - begin)

    def run_twice(self, *words, apart):
        """Runs it twice at once in one folder, of which one may be refused.

        @param apart s between their starts
        @return the end of that with the lower status, and both statuses
        """
        first = self.start(*words)
        time.sleep(apart)
        second = self.start(*words)
        ends = []
        for child in (first, second):
            out, errors = child.communicate()
            ends.append(Ended(as_status(child.returncode), text(out), text(errors), 0.0))
        ends.sort(key=lambda end: end.status)
        ended = ends[0]
        ended.problems = [problem for end in ends for problem in judge(end)]
        statuses = [end.status for end in ends]
        if statuses not in ([0, 0], [0, 2]):
            ended.problems.append(f"ended {statuses}")
        return ended, statuses

    @staticmethod
    def _stop(child):
        child.send_signal(signal.SIGINT)
        try:
            return child.communicate(timeout=STOP_WITHIN)
        except subprocess.TimeoutExpired:
            os.killpg(child.pid, signal.SIGKILL)
            return child.communicate()


def as_status(returncode):
    return 128 - returncode if returncode < 0 else returncode


def text(stream):
    return (stream or b"").decode(errors="replace")


def judge(ended):
    """What is wrong with how a command ended, whatever it was given."""
    problems = []
    if ended.status == 128 + signal.SIGKILL and ended.stopped:
        problems.append(f"hung: did not end {STOP_WITHIN:.0f} s after SIGINT")
    elif ended.status not in ALLOWED:
        problems.append(f"status {ended.status}")
    if ended.status in (2, 3) and "limber: error:" not in ended.errors:
        problems.append(f"status {ended.status} without a word")
    if ended.seconds > PATIENCE:
        problems.append(f"took {ended.seconds:.0f} s")
    orphans = find_orphans()
    if orphans:
        problems.append(f"left running: {', '.join(orphans)}")
    return problems
