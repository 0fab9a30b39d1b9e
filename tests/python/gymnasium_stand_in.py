# SPDX-License-Identifier: BSD-3-Clause
"""What limber.gym uses of Gymnasium, for machines without it: the same names, and the
behaviour that its documentation states."""

import enum
import sys
import types

import numpy


class AutoresetMode(enum.Enum):
    NEXT_STEP = "NextStep"
    SAME_STEP = "SameStep"
    DISABLED = "Disabled"


class VectorEnv:
    _random = None

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self._random = numpy.random.default_rng(seed)

    @property
    def np_random(self):
        if self._random is None:
            self._random = numpy.random.default_rng()
        return self._random


class Box:
    def __init__(self, low, high, shape, dtype):
        self.low = numpy.broadcast_to(numpy.asarray(low, dtype), shape)
        self.high = numpy.broadcast_to(numpy.asarray(high, dtype), shape)
        self.shape, self.dtype = tuple(shape), numpy.dtype(dtype)


def batch_space(space, n):
    return Box(numpy.tile(space.low, (n, 1)), numpy.tile(space.high, (n, 1)),
               (n, *space.shape), space.dtype)


def install():
    """Takes the place of the package in this process."""
    package = types.ModuleType("gymnasium")
    package.spaces = types.SimpleNamespace(Box=Box)
    package.vector = types.ModuleType("gymnasium.vector")
    package.vector.AutoresetMode, package.vector.VectorEnv = AutoresetMode, VectorEnv
    package.vector.utils = types.ModuleType("gymnasium.vector.utils")
    package.vector.utils.batch_space = batch_space
    sys.modules.update({"gymnasium": package, "gymnasium.vector": package.vector,
                        "gymnasium.vector.utils": package.vector.utils})
