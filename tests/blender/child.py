"""The process that hosts.run starts: imports bpy, calls one function, writes its answer and ends at once.

bpy can hang or crash while the interpreter winds down, so the process ends without that.
"""

import importlib
import json
import os
import sys
import traceback
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main(question, answer):
    sys.path[:0] = [str(HERE), str(HERE.parent)]
    try:
        import bpy  # noqa: F401  before anything that needs its modules

        task = json.loads(Path(question).read_text(encoding="utf-8"))
        module, name = task["function"].rsplit(".", 1)
        content = {"answer": getattr(importlib.import_module(module), name)(**task["arguments"])}
    except BaseException:
        content = {"error": traceback.format_exc()}
    Path(answer).write_text(json.dumps(content), encoding="utf-8")
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


if __name__ == "__main__":
    main(*sys.argv[1:])
