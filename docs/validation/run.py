"""Recomputes the figures of docs/validation.md and its plots.

    python docs/validation/run.py                 all parts
    python docs/validation/run.py twilight day    these parts

Needs skyprobe, numpy, scipy, matplotlib and pvlib; mitsuba and bpy where they are compared. A part that lacks a package or a reference table says so and
leaves what stands in the document.
"""

import importlib
import os
import sys
import time

# Every figure is computed anew, unless the environment says otherwise.
os.environ.setdefault("SKYPROBE_CACHE", "off")

from common import ROOT, Skipped  # noqa: E402

PARTS = ["tables", "measured_skies", "standard_spectrum", "day", "twilight", "convergence", "colour", "other_models"]
DOCUMENT = ROOT / "docs" / "validation.md"


def replace(part: str, text: str) -> None:
    """Puts `text` between the markers of `part`."""
    begin, end = f"<!-- begin {part} -->\n", f"<!-- end {part} -->"
    document = DOCUMENT.read_text()
    before, rest = document.split(begin)
    DOCUMENT.write_text(before + begin + text.strip() + "\n" + end + rest.split(end)[1])


def main() -> int:
    failed = 0
    for part in sys.argv[1:] or PARTS:
        start = time.monotonic()
        try:
            text = importlib.import_module(part).report()
        except (Skipped, ModuleNotFoundError) as lack:
            print(f"SKIPPED {part}: {lack}")
            continue
        except Exception as error:  # the other parts still run
            failed += 1
            print(f"FAILED {part}: {error!r}")
            continue
        replace(part, text)
        print(f"{part}: {time.monotonic() - start:.0f} s\n{text}", flush=True)
    return failed


if __name__ == "__main__":
    sys.exit(main())
