# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions of Limber. Each states what is wrong, where, and how to fix it."""


class InputError(ValueError):
    """A file, key or value is wrong.

    ``problems`` lists all of its errors, one text each.
    """

    def __init__(self, *texts):
        super().__init__(*texts)
        self.problems = [str(text) for text in texts]


class NumericalError(ArithmeticError):
    """A computation cannot continue.

    ``run`` is the :class:`limber.Run` up to then, if there is one; if a Python
    exception is the reason, as in a controller, it is ``__cause__``.
    """

    run = None


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a computation between two steps.

    ``run`` is the :class:`limber.Run` up to then, if there is one. In a notebook
    it is still available as ``sys.last_value.run``.
    """

    run = None


class ContractError(Exception):
    """A programming error of the caller, such as an index of another model."""


class LimberWarning(UserWarning):
    """A warning, as the command prints it."""
