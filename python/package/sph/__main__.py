"""The command line: ``python -m sph run SCENE`` is ``sph run SCENE``."""

import sys

from . import _sph


def main() -> None:
    """Runs the command line and ends the process with its exit code."""
    sys.exit(_sph.main(["sph", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
