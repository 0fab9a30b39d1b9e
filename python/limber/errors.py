# SPDX-License-Identifier: BSD-3-Clause
"""What Limber raises. Each says what is wrong, where, and what would fix it."""


class InputError(ValueError):
    """A file, key or value is wrong.

    ``problems`` lists all that is wrong with it, a text each.
    """

    def __init__(self, *texts):
        super().__init__(*texts)
        self.problems = [str(text) for text in texts]


class NumericalError(ArithmeticError):
    """A computation cannot continue.

    ``run`` is the :class:`limber.Run` until there, if there is one; a Python
    exception that is the reason, as one in a controller, is ``__cause__``.
    """

    run = None


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a computation between two steps.

    ``run`` is the :class:`limber.Run` until there, if there is one. In a
    notebook it is still at hand as ``sys.last_value.run``.
    """

    run = None


class ContractError(Exception):
    """A programming error of the caller, as an index of another model."""


class LimberWarning(UserWarning):
    """What the command prints as a warning."""
