"""``python -m skyprobe``: the command line tool."""

import sys

from ._core import run_command_line


def main() -> int:
    """Run the tool with the arguments of this process and return its exit code."""
    return run_command_line(["skyprobe", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
