"""Runs step functions of the scripts beside it inside a real Blender with a window, on a virtual screen.

The add-on is loaded from its folder, without a zip: a scripts folder made for the run holds a link to it, and the skyprobe wheel
unpacked. The Blenders are what tests/setup_window.sh made and the `blender` of the PATH, or the one of SKYPROBE_BLENDER (a path) alone.
"""

import contextlib
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import zipfile
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PACKAGE = "skyprobe_addon"
SCREEN = (1600, 1000)  # [pixels]

# What Blender prints where a script went wrong in a place that cannot raise: a panel, a handler, a timer.
COMPLAINTS = ("Traceback (most recent call last)", "rna_uiItem", "Error: Python", "Freeing memory after the leak detector")


@dataclass(frozen=True)
class Blender:
    """A Blender that can open a window."""

    name: str
    command: tuple  # with which it starts


def find_blenders():
    """Return the Blenders that can open a window here, the newest first."""
    found = []
    if named := os.environ.get("SKYPROBE_BLENDER"):
        return [Blender("named", (named,))]
    if (ROOT / ".window" / "made").exists() and os.geteuid() == 0:
        enter = ("unshare", "--mount", HERE / "in_window_root.sh", ROOT / ".window", ROOT)
        found.append(Blender("sid", (*enter, "blender")))
    if installed := shutil.which("blender"):
        found.append(Blender("installed", (installed,)))
    return found


@contextlib.contextmanager
def virtual_screen(folder, size):
    """Yield the name of an X display of `size` pixels that nobody else uses; `folder`/Xvfb_screen0 holds its picture."""
    reading, writing = os.pipe()
    options = ["-screen", "0", f"{size[0]}x{size[1]}x24", "-fbdir", folder, "-nolisten", "tcp", "-noreset"]
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), *options],
        pass_fds=(writing,),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    os.close(writing)
    try:
        with os.fdopen(reading) as answer:
            number = answer.readline().strip()
        if not number:
            raise RuntimeError(f"Xvfb ended with {server.wait(10)}")
        yield f":{number}"
    finally:
        _kill(server)


def run(blender, function, wheel, timeout_s=180, complaints_allowed=False, screen=SCREEN, **arguments):
    """Let `function` ("module.name" of a script in this folder) run in a window of `blender`; return its answer.

    `function` is a generator function, called with the JSON `arguments`; window_child.py tells what it may yield. `wheel` is the
    path of the skyprobe wheel. Whatever Blender complains of on the way is an error unless `complaints_allowed`, with which the
    answer is the pair (answer, output). Without a graphics card each pixel costs: a step that draws often is given a small `screen`.
    """
    with tempfile.TemporaryDirectory(dir="/tmp") as folder, virtual_screen(folder, screen) as display:
        folder = Path(folder)
        _lay_out(folder, wheel)
        question, answer, log = folder / "question.json", folder / "answer.json", folder / "output.txt"
        question.write_text(json.dumps({"function": function, "arguments": arguments}), encoding="utf-8")
        environment = {
            **{name: value for name, value in os.environ.items() if name not in {"PYTHONHOME", "PYTHONPATH"}},
            # Debian's Blender takes its Python, and with it numpy, from where it finds one.
            "PATH": f"/usr/bin:/bin:{os.environ['PATH']}",
            "DISPLAY": display,
            "LIBGL_ALWAYS_SOFTWARE": "1",
            "BLENDER_USER_SCRIPTS": folder / "scripts",
            "BLENDER_USER_CONFIG": folder / "config",
            "SKYPROBE_SCREEN": folder / "Xvfb_screen0",
            "PYTHONDONTWRITEBYTECODE": "1",
            "PYTHONUNBUFFERED": "1",
        }
        options = ["--factory-startup", "-noaudio", "--enable-event-simulate", "--window-geometry", "0", "0", *map(str, screen), "--python-exit-code", "3"]
        paths = [HERE / "window_child.py", "--", folder / "site", question, answer]
        with log.open("w", encoding="utf-8") as output:
            process = subprocess.Popen(
                [*blender.command, *options, "--python", *paths],
                env=environment,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            try:
                process.wait(timeout_s)
            except subprocess.TimeoutExpired:
                raise RuntimeError(f"{function} did not end within {timeout_s} s:\n{log.read_text(errors='replace')}") from None
            finally:
                _kill(process)
        printed = log.read_text(encoding="utf-8", errors="replace")
        if not answer.exists():
            raise RuntimeError(f"Blender ended with {process.returncode}:\n{printed}")
        content = json.loads(answer.read_text(encoding="utf-8"))
    if "error" in content:
        raise RuntimeError(f"{content['error']}\n{printed}")
    if complaints_allowed:
        return content["answer"], printed
    if any(complaint in printed for complaint in COMPLAINTS):
        raise RuntimeError(f"Blender complained during {function}:\n{printed}")
    return content["answer"]


def _lay_out(folder, wheel):
    """Fill `folder` with what a run needs: the add-on where Blender looks for it, and the library."""
    (folder / "config").mkdir()
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder / "site")
    addons = folder / "scripts" / "addons"
    addons.mkdir(parents=True)
    (addons / PACKAGE).symlink_to(ROOT / "blender_addon")


def _kill(process):
    """End `process` and all that it started."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait(10)


def main():
    """Run one step function by hand: python tests/blender/window.py WHEEL FUNCTION [NAME=JSON]..."""
    wheel, function, *pairs = sys.argv[1:]
    arguments = {name: json.loads(value) for name, value in (pair.split("=", 1) for pair in pairs)}
    answer, printed = run(find_blenders()[0], function, wheel, complaints_allowed=True, **arguments)
    print(printed)
    print(json.dumps(answer, indent=1))


if __name__ == "__main__":
    main()
