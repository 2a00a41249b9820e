"""Exceptions of the library. Wrong types of arguments, such as complex arrays, are a TypeError."""

__all__ = ["Error", "InputError", "InterruptedRunError", "RunError"]


class Error(Exception):
    """What the library cannot do: one line that says what, where and what is allowed."""


class InputError(Error, ValueError):
    """The caller's data or options."""


class RunError(Error, RuntimeError):
    """A run that ended before its goal, or a defect of the library."""


class InterruptedRunError(RunError):
    """A run that its progress function ended before it had a result."""
