"""The add-on under misuse: each case is told in a line that says what to do, and leaves the scene and Blender as they were.

The cases are in misuse_settings, misuse_scenes, misuse_files, misuse_renders (headless) and misuse_window_steps (in a window).
"""

import subprocess

import pytest

THEMES = {"misuse_settings": 25, "misuse_scenes": 20, "misuse_files": 35, "misuse_renders": 18}


@pytest.fixture(scope="module")
def disks(tmp_path_factory):
    """Paths of a disk of 128 kB and of one that cannot be written to; None where nothing can be mounted, which skips their cases."""
    folder = tmp_path_factory.mktemp("disks")
    mounted = {}
    try:
        for name, options in {"tiny": "size=128k", "read_only": "size=64k,ro"}.items():
            path = folder / name
            path.mkdir()
            mount = ["mount", "-t", "tmpfs", "-o", options, "tmpfs", path]
            try:
                subprocess.run(mount, check=True, capture_output=True)
            except (OSError, subprocess.CalledProcessError):
                break
            mounted[name] = str(path)
        yield mounted if len(mounted) == 2 else None
    finally:
        for path in mounted.values():
            subprocess.run(["umount", path], check=True)


@pytest.mark.parametrize("theme", THEMES)
def test_misuse_is_told_in_a_line_and_breaks_nothing(host, theme, disks, tmp_path, monkeypatch):
    # The air of most cases is the same.
    monkeypatch.delenv("SKYPROBE_CACHE", raising=False)
    monkeypatch.setenv("SKYPROBE_CACHE_DIR", str(tmp_path))
    rows = host.run("misuse_steps.run", theme=theme, disks=disks)
    for row in rows:
        print(f"{row['seconds']:.2f} s  {row['name']}: {row['told'][:150]}")
    wrong = [
        f"{row['name']} ({row['what']})\n  is {', '.join(row['wrong'])}\n  told: {row['told']}\n  not: {row['expected']}\n{row['output']}"
        for row in rows
        if row["wrong"]
    ]
    assert not wrong, "\n\n".join(wrong)
    assert len(rows) >= THEMES[theme]


def test_misuse_in_a_window(windowed):
    answers = windowed.run("misuse_window_steps.run", timeout_s=400)
    wrong = {name: answer for name, answer in answers.items() if answer != "fine"}
    assert not wrong and len(answers) >= 8, answers
