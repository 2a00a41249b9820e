"""How a script refuses input that is missing or cannot be read."""

import sys


class Unusable(Exception):
    """What is wrong with the input, in one line."""


def exit_status(program, action):
    """Calls `action`. Returns 0, or 2 after one line on stderr where it raises Unusable."""
    try:
        action()
    except Unusable as error:
        print(f"{program}: {error}", file=sys.stderr)
        return 2
    return 0
