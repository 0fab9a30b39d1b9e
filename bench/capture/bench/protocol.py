# SPDX-License-Identifier: BSD-3-Clause
"""Calls runners: any executables that follow the protocol in bench/capture/README.md."""
import json
import math
import os
import subprocess

STATUSES = ("answered", "failed")


SLOW = 20.0  # s of processor time: a run beyond it is made once


class RunnerError(Exception):
    """A runner that does not keep to the protocol."""


def call(arguments):
    # One thread each, so that processor times compare.
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    done = subprocess.run(
        [str(a) for a in arguments], capture_output=True, text=True, check=False, env=environment
    )
    if done.returncode != 0:
        raise RunnerError(f"{arguments[0]}: exit status {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def read_json(text, where):
    try:
        found = json.loads(text)
    except json.JSONDecodeError as error:
        raise RunnerError(f"{where}: not JSON: {error}") from None
    if not isinstance(found, dict):
        raise RunnerError(f"{where}: a JSON object is required")
    return found


def list_variants(runner, case):
    """What a runner can do of a case: {tool, version, variants: [...], reason}."""
    where = f"{runner} list {case.name}"
    found = read_json(call([runner, "list", case.folder]), where)
    for key in ("tool", "version", "variants"):
        if key not in found:
            raise RunnerError(f"{where}: '{key}' is missing")
    if not found["variants"] and not found.get("reason"):
        raise RunnerError(f"{where}: no variants need a reason")
    return found


def check_answer(answer, case, where):
    if answer.get("status") not in STATUSES:
        raise RunnerError(f"{where}: 'status' is one of {', '.join(STATUSES)}")
    if answer["status"] == "failed":
        if not answer.get("reason"):
            raise RunnerError(f"{where}: a failure needs a reason")
        return answer
    cpu = answer.get("cpu_s")
    if not isinstance(cpu, (int, float)) or not cpu > 0:
        raise RunnerError(f"{where}: 'cpu_s' > 0 is required")
    known = {q.name for q in case.quantities}
    for name, value in answer.get("answers", {}).items():
        if name not in known:
            raise RunnerError(f"{where}: the case has no quantity '{name}'")
        if not isinstance(value, (int, float)) or not math.isfinite(value):
            raise RunnerError(f"{where}: answer '{name}' is not a finite number")
    if not answer.get("answers"):
        raise RunnerError(f"{where}: no answers")
    return answer


def run_once(runner, case, variant, work, fresh):
    file = work / "answer.json"
    file.unlink(missing_ok=True)
    arguments = [runner, "run", case.folder, variant, "--work", work, "--out", file]
    try:
        call(arguments + (["--fresh"] if fresh else []))
    except RunnerError as error:  # the other runs are worth having
        return {"status": "failed", "reason": str(error).splitlines()[-1]}
    where = f"{runner} run {case.name} {variant}"
    if not file.is_file():
        raise RunnerError(f"{where}: no {file}")
    return check_answer(read_json(file.read_text(encoding="utf-8"), where), case, where)


def run(runner, case, variant, work, repeats):
    """The answer, with the least processor time of `repeats` and set-up: a run from nothing less that."""
    work.mkdir(parents=True, exist_ok=True)
    fresh = run_once(runner, case, variant, work, True)
    if fresh["status"] == "failed":
        return fresh
    if fresh["cpu_s"] > SLOW:
        repeats = 0
    answers = [run_once(runner, case, variant, work, False) for _ in range(repeats)]
    for answer in answers:
        if answer["status"] == "failed":
            return answer
        if answer["answers"] != fresh["answers"]:
            fresh["changes"] = True  # differs from run to run
    fresh["repeats"] = repeats
    least = min((a["cpu_s"] for a in answers), default=fresh["cpu_s"])
    fresh["setup_s"] = max(0.0, fresh["cpu_s"] - least) if answers else None
    fresh["cpu_s"] = least
    return fresh
