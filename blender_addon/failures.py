# SPDX-License-Identifier: GPL-3.0-or-later
"""What went wrong, as one line for the user, and operators that never end in a traceback."""

import traceback
from pathlib import Path

import skyprobe

from . import jobs

# Letters of a line; of a longer one the beginning and the end are told, which name the parameter and what is allowed.
LONGEST = 400
# What Blender says when a script changes data while it draws, or thinks that it does.
LOCKED = "Writing to ID classes in this context is not allowed"


def line(error):
    """Return what the exception `error` means, in one line: what is wrong with which value and what to do."""
    if isinstance(error, OSError) and error.errno is not None and error.filename is not None:
        text = f"{error.filename}: {error.strerror}"
    elif isinstance(error, jobs.USER_ERRORS):
        text = str(error)
    elif isinstance(error, MemoryError):
        text = "memory = all in use: must be enough for the picture; choose a smaller resolution"
    elif isinstance(error, AttributeError) and LOCKED in str(error):
        text = "Blender = locked: must let scripts change its data, which a render can leave forbidden; save the file and start Blender again"
    else:
        text = f"Skyprobe failed, which is a fault in it: {type(error).__name__} {error} ({_origin(error)}); please report this line"
    text = " ".join(text.split())
    if len(text) > LONGEST:
        half = (LONGEST - 5) // 2
        text = f"{text[:half]} ... {text[-half:]}"
    return text


def _origin(error):
    frames = traceback.extract_tb(error.__traceback__)
    return f"{Path(frames[-1].filename).name}:{frames[-1].lineno}" if frames else "outside"


class Telling:
    """A base of operators: what `run` raises becomes a report, and the operator is cancelled."""

    def execute(self, context):
        return self.told(lambda: self.run(context))

    def told(self, work):
        """Return what `work` returns; report what it raises."""
        try:
            return work()
        except skyprobe.Cancelled as error:
            self.report({"INFO"}, f"Skyprobe: {error}")
        except Exception as error:
            self.report({"ERROR"}, line(error))
        return {"CANCELLED"}
