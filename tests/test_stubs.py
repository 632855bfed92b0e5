"""The stubs say what the module says."""

from __future__ import annotations

import ast
import importlib.util
import inspect
import pathlib
import subprocess
import sys
from typing import Any

import pytest

import skyprobe as sp
from skyprobe import _core


def test_documentation_is_the_same_in_the_stubs_and_at_run_time() -> None:
    stubs = ast.parse((pathlib.Path(sp.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
    seen = 0
    for node in stubs.body:
        if not isinstance(node, ast.ClassDef):
            continue
        members: list[tuple[ast.ClassDef | ast.FunctionDef, Any]] = [(node, getattr(_core, node.name))]
        # Of several ways to call one method the last carries its documentation.
        methods = {member.name: member for member in node.body if isinstance(member, ast.FunctionDef) and member.name != "__new__"}
        members += [(member, inspect.getattr_static(getattr(_core, node.name), name)) for name, member in methods.items()]
        for stub, actual in members:
            actual = getattr(actual, "__func__", actual)
            assert inspect.cleandoc(actual.__doc__ or "") == ast.get_docstring(stub), f"{node.name}.{stub.name}"
            seen += 1
    assert seen > 60


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_the_stubs_agree_with_the_module(tmp_path: pathlib.Path) -> None:
    check = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "skyprobe._core"], capture_output=True, text=True, cwd=tmp_path, check=False
    )
    assert check.returncode == 0, check.stdout + check.stderr
