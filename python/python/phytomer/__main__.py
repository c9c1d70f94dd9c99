"""The command `phytomer`: the whole program, as `phytomer` in a shell and as `python -m phytomer`."""

import signal
import sys

from . import _phytomer


def main() -> None:
    """Obeys the command line and ends with its exit code."""
    # The program hears Ctrl-C itself; Python's handler would wait for the interpreter, which is released meanwhile.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_phytomer.main(["phytomer", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
