# SPDX-License-Identifier: BSD-3-Clause
"""The fenced blocks of a page in docs/, so that a test runs what the page says."""
import dataclasses
import pathlib
import re


@dataclasses.dataclass
class Block:
    language: str
    values: dict  # of "name=value" after the language, as file=tube.geo
    text: str
    line: int  # of its fence in the page, from 1


def read_blocks(page):
    blocks, open_block = [], None
    for number, line in enumerate(pathlib.Path(page).read_text().splitlines(), 1):
        fence = re.fullmatch(r"```(.*)", line)
        if open_block is None and fence:
            language, *rest = fence.group(1).split() or [""]
            values = dict(part.split("=", 1) for part in rest)
            open_block = Block(language, values, "", number)
        elif open_block is not None and line == "```":
            blocks.append(open_block)
            open_block = None
        elif open_block is not None:
            open_block.text += line + "\n"
    if open_block is not None:
        raise ValueError(f"{page}:{open_block.line}: a block without an end")
    return blocks
