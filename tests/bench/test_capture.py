# SPDX-License-Identifier: BSD-3-Clause
"""Capture Bench: the format of cases, the protocol of runners, and one quick case."""
import json
import os
import pathlib
import subprocess
import sys

import pytest

BENCH = pathlib.Path(os.environ["LIMBER_SOURCE"]) / "bench/capture"
sys.path.insert(0, str(BENCH))
from bench.case import CaseError, read_case  # noqa: E402

CASE = """
format = 1
title = "A sum"
question = "How much is two and two?"
description = "Two terms."

[[quantity]]
name = "sum"
what = "sum"
unit = "-"
reference = 4.0
uncertainty = 0.0
tolerance = 0.1
kind = "closed form"
source = "arithmetic"
"""
RUNNER = """#!/usr/bin/python3
import json, pathlib, sys
if sys.argv[1] == "list":
    print(json.dumps({"tool": "Abacus", "version": "1", "variants": ["only"]}))
else:
    pathlib.Path(sys.argv[sys.argv.index("--out") + 1]).write_text('ANSWER')
"""


def run(*arguments):
    return subprocess.run(
        [str(BENCH / "run"), *[str(a) for a in arguments]], capture_output=True, text=True, check=False
    )


def make_case(folder, text=CASE):
    (folder / "sum").mkdir()
    (folder / "sum/case.toml").write_text(text)
    return folder / "sum"


def ask(folder, answer):
    """The process and the page of a runner that answers so."""
    runner = folder / "abacus"
    runner.write_text(RUNNER.replace("ANSWER", answer))
    runner.chmod(0o755)
    done = run("--quick", "--runner", runner, "--work", folder / "work", "--out", folder / "out", make_case(folder))
    page = folder / "out/README.md"
    return done, page.read_text() if page.is_file() else ""


@pytest.mark.parametrize("folder", sorted(f.parent for f in BENCH.glob("cases/*/case.toml")), ids=lambda f: f.name)
def test_a_case_is_complete(folder):
    case = read_case(folder)
    assert case.quantities
    assert (folder / "limber.py").is_file() and (folder / "mujoco.py").is_file()
    assert f"cases/{folder.name}/case.toml" in (BENCH / "README.md").read_text()


@pytest.mark.parametrize(
    "change, words",
    [
        (("tolerance = 0.1", "tolerance = 0.0"), "tolerance > 0"),
        (("uncertainty = 0.0", "uncertainty = 0.2"), "exceeds the tolerance"),
        (("reference = 4.0", 'reference = "4"'), "'reference' is not a float"),
        (("reference = 4.0", "reference = nan"), "'reference' is not finite"),
        (('kind = "closed form"', 'kind = "our own"'), "'kind' is one of"),
        (("format = 1", "format = 2"), "format 2"),
        (('unit = "-"', 'unit = "-"\nunits = "m"'), "unknown key 'units'"),
        (('source = "arithmetic"', ""), "'source' is missing"),
    ],
)
def test_a_wrong_case_is_refused_in_words(tmp_path, change, words):
    folder = make_case(tmp_path, CASE.replace(*change))
    with pytest.raises(CaseError, match=words):
        read_case(folder)
    assert run(folder).returncode == 2


def test_a_hit_and_a_miss_are_told_apart(tmp_path):
    for value, verdict in ((4.05, "1 of 1 hit"), (4.2, "0 of 1 hit")):
        folder = tmp_path / str(value)
        folder.mkdir()
        done, page = ask(folder, json.dumps({"status": "answered", "answers": {"sum": value}, "cpu_s": 0.5}))
        assert done.returncode == 0, done.stderr
        assert verdict in done.stdout
        assert ("%) **miss** |" in page) == (value > 4.1)
        assert "4 ± 0" in page


def test_a_tool_replaces_its_own_results_alone(tmp_path):
    answer = json.dumps({"status": "answered", "answers": {"sum": 4}, "cpu_s": 0.5})
    ask(tmp_path, answer)
    runner = tmp_path / "other"
    for sum_ in (4, 5):
        runner.write_text(RUNNER.replace("ANSWER", answer.replace("4", str(sum_))).replace("Abacus", "Slate"))
        runner.chmod(0o755)
        done = run("--quick", "--runner", runner, "--work", tmp_path / "work", "--out", tmp_path / "out", tmp_path / "sum")
        assert done.returncode == 0, done.stderr
    found = json.loads((tmp_path / "out/results.json").read_text())["sum"]
    assert [(r["tool"], r["answers"]["sum"]) for r in found] == [("Abacus", 4), ("Slate", 5)]


def test_a_failure_is_shown_with_its_reason(tmp_path):
    done, page = ask(tmp_path, json.dumps({"status": "failed", "reason": "beads are stuck"}))
    assert done.returncode == 0
    assert "failed: beads are stuck" in page


@pytest.mark.parametrize(
    "answer, words",
    [
        ({"status": "answered", "answers": {"summ": 4}, "cpu_s": 1}, "no quantity 'summ'"),
        ({"status": "answered", "answers": {"sum": 4}}, "'cpu_s' > 0"),
        ({"status": "answered", "answers": {}, "cpu_s": 1}, "no answers"),
        ({"status": "done"}, "'status' is one of"),
    ],
)
def test_an_answer_outside_of_the_protocol_ends_the_bench(tmp_path, answer, words):
    done, page = ask(tmp_path, json.dumps(answer))
    assert done.returncode == 2
    assert words in done.stderr
    assert not page


def test_limber_hits_every_quantity_of_a_quick_case(tmp_path):
    done = run(
        "--quick", "--runner", BENCH / "runners/limber", "--work", tmp_path / "work", "--out", tmp_path, "five_ball_chain"
    )
    assert done.returncode == 0, done.stderr
    assert "5 of 5 hit" in done.stdout
    found = json.loads((tmp_path / "results.json").read_text())["five_ball_chain"][0]
    assert found["cpu_s"] > 0 and found["simulated_s"] > 0
    assert sum(found["answers"].values()) == pytest.approx(1.0, abs=1e-9)  # momentum


def test_references_are_computed_again(tmp_path):
    cases = ("five_ball_chain", "rods", "rotating_blade", "topple_and_land", "tumbling_catch")
    done = subprocess.run(
        [str(BENCH / "references/check"), *cases], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "DIFFERS" not in done.stdout
