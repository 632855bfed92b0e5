"""Runs functions of the scripts beside it inside real Blenders: one virtual environment with a bpy wheel per version.

The environments `.venv-bpy42`, `.venv-bpy45`, `.venv-bpy52`, `.venv-bpy53` lie at the root of the checkout. Where one is missing the tests that
need it fail, unless SKYPROBE_SKIP_HOSTS=1 says that no hosts are wanted.
"""

import json
import os
import subprocess
import tempfile
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
VERSIONS = ("4.2", "4.5", "5.2", "5.3")


# What the lines of Python's warnings about our own code name.
OURS = ("skyprobe", str(HERE))


def python_of(version):
    """Return the interpreter that has the bpy of Blender `version`; fail or skip the test without one."""
    python = ROOT / f".venv-bpy{version.replace('.', '')}" / "bin" / "python"
    if python.exists():
        return python
    if os.environ.get("SKYPROBE_SKIP_HOSTS") == "1":
        pytest.skip(f"no Blender {version}, and SKYPROBE_SKIP_HOSTS=1")
    pytest.fail(f"{python} is missing: make it with tests/setup_hosts.sh, or set SKYPROBE_SKIP_HOSTS=1")


def run(version, function, resources, timeout_s=240, **arguments):
    """Call `function` ("module.name" of a script in this folder) with JSON `arguments` in Blender `version`; return its answer.

    A warning of Python's about our code is an error. `resources` is the folder in which that Blender keeps its preferences and extensions. Each call is a process of its own.
    """
    with tempfile.TemporaryDirectory() as folder:
        question, answer = Path(folder) / "question.json", Path(folder) / "answer.json"
        question.write_text(json.dumps({"function": function, "arguments": arguments}), encoding="utf-8")
        process = subprocess.run(
            [python_of(version), HERE / "child.py", question, answer],
            env={**os.environ, "BLENDER_USER_RESOURCES": str(resources), "PYTHONWARNINGS": "always"},
            capture_output=True,
            text=True,
            timeout=timeout_s,
        )
        if not answer.exists():
            raise RuntimeError(f"Blender {version} ended with {process.returncode}:\n{process.stdout}\n{process.stderr}")
        content = json.loads(answer.read_text(encoding="utf-8"))
    if warnings := [line for line in process.stderr.splitlines() if "Warning: " in line and any(name in line for name in OURS)]:
        raise RuntimeError(f"warnings in Blender {version}:\n" + "\n".join(warnings))
    if "error" in content:
        raise RuntimeError(f"in Blender {version}:\n{content['error']}\n{process.stdout}\n{process.stderr}")
    return content["answer"]
