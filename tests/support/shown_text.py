# SPDX-License-Identifier: BSD-3-Clause
"""Whether a program printed what a page shows."""
import re

NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def is_near(shown, printed):
    digits, _, exponent = shown.partition("e")
    places = len(digits.partition(".")[2])
    last = 10.0 ** (int(exponent or 0) - places) if places or exponent else 0.0
    return abs(float(shown) - float(printed)) <= max(0.02 * abs(float(shown)), 2.0 * last)


def has_line(shown, output):
    """Whether a line of the output is the shown one."""
    is_cut = shown.endswith("...")
    shown = " ".join(shown.removesuffix("...").split())
    words, numbers = NUMBER.split(shown), NUMBER.findall(shown)
    for line in (" ".join(line.split()) for line in output.splitlines()):
        its_words, its_numbers = NUMBER.split(line), NUMBER.findall(line)
        if is_cut:
            its_words = its_words[:len(words)]
            its_words[-1] = its_words[-1][:len(words[-1])]
            its_numbers = its_numbers[:len(numbers)]
        if its_words == words and all(map(is_near, numbers, its_numbers)):
            return True
    return False
