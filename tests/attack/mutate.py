# SPDX-License-Identifier: BSD-3-Clause
"""Seeded damage to texts and bytes."""

import re

NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
WORD = re.compile(r"[A-Za-z_][\w.-]*")
NUMBERS = [
    "0", "-1", "1e-300", "1e300", "-1e300", "nan", "inf", "-inf", "1e22",
    "1e-22", "9223372036854775808", "0x10", "1,5", "1.5.2", "", "true",
    "[1, 2]", '"1"', "4294967296", "-0.0", "1e-9", "1e9",
]
STRINGS = [
    "\0", "\x1b[2J", "\r", "\u202e", "'", '"', "]", "}", "[[", "{{{{", "=",
    "#", "<", "&#0;", "]]>", "../../..", "/dev/zero", "/dev/null", "%s%n",
    "A" * 5000, "\n" * 300, "(" * 2000,
]


def _pick(random, matches):
    matches = list(matches)
    return random.choice(matches) if matches else None


def _put(text, match, by):
    return text[: match.start()] + by + text[match.end() :]


def change_number(text, random):
    match = _pick(random, NUMBER.finditer(text))
    if match is None:
        return text
    if random.random() < 0.5:
        return _put(text, match, random.choice(NUMBERS))
    factor = random.choice([-1, 0.5, 1.1, 2, 10, 1e3, 1e6, 1e-3, 1e-6])
    return _put(text, match, repr(float(match.group()) * factor))


def change_word(text, random):
    words = list(WORD.finditer(text))
    if not words:
        return text
    other = random.choice(words).group()
    return _put(text, random.choice(words), other)


def insert_string(text, random):
    at = random.randrange(len(text) + 1)
    return text[:at] + random.choice(STRINGS) + text[at:]


def delete_piece(text, random):
    at = random.randrange(len(text))
    return text[:at] + text[at + random.choice([1, 3, 20, 200]) :]


def _on_lines(text, change):
    lines = text.splitlines(keepends=True)
    change(lines)
    return "".join(lines)


def delete_line(text, random):
    return _on_lines(text, lambda lines: lines.pop(random.randrange(len(lines))))


def repeat_line(text, random):
    def change(lines):
        line = random.choice(lines)
        lines[random.randrange(len(lines))] = line * random.choice([1, 2, 50])

    return _on_lines(text, change)


def swap_lines(text, random):
    def change(lines):
        i, k = random.randrange(len(lines)), random.randrange(len(lines))
        lines[i], lines[k] = lines[k], lines[i]

    return _on_lines(text, change)


def cut_off(text, random):
    return text[: random.randrange(len(text))]


TEXT_CHANGES = [
    change_number, change_number, change_number, change_word, insert_string,
    delete_piece, delete_line, repeat_line, swap_lines, cut_off,
]


def mutate_text(text, random):
    """One to three changes, most often one."""
    for _ in range(random.choice([1, 1, 1, 2, 3])):
        if text:
            text = random.choice(TEXT_CHANGES)(text, random)
    return text


def flip_bit(data, random):
    at = random.randrange(len(data))
    changed = bytearray(data)
    changed[at] ^= 1 << random.randrange(8)
    return bytes(changed)


def zero_block(data, random):
    at = random.randrange(len(data))
    size = min(random.choice([1, 8, 64, 4096]), len(data) - at)
    return data[:at] + b"\0" * size + data[at + size :]


def drop_block(data, random):
    at = random.randrange(len(data))
    return data[:at] + data[at + random.choice([1, 8, 512]) :]


def cut_bytes(data, random):
    return data[: random.randrange(len(data))]


def add_bytes(data, random):
    return data + random.randbytes(random.choice([1, 8, 4096]))


BYTE_CHANGES = [flip_bit, flip_bit, flip_bit, zero_block, drop_block,
                cut_bytes, add_bytes]


def mutate_bytes(data, random):
    """One change that leaves other bytes than there were."""
    while True:
        changed = random.choice(BYTE_CHANGES)(data, random)
        if changed != data:
            return changed
