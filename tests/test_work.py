"""Long work from Python: progress, cancelling, signals, threads, processes that were forked."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
import _thread
from collections.abc import Iterator

import pytest

import skyprobe as sp


@pytest.fixture(scope="module")
def air() -> sp.Atmosphere:
    return sp.Atmosphere(quality="draft")


@pytest.fixture(scope="module")
def whole_solve() -> tuple[float, int]:
    """How long a solve at standard quality takes here [s], and how often another thread had its turn meanwhile (200 times a second at most)."""
    air = sp.Atmosphere(quality="standard", cache=False)
    turns = 0
    done = threading.Event()

    def count() -> None:
        nonlocal turns
        while not done.wait(0.005):
            turns += 1

    thread = threading.Thread(target=count)
    thread.start()
    begin = time.perf_counter()
    air.solve()
    seconds = time.perf_counter() - begin
    done.set()
    thread.join()
    return seconds, turns


def test_progress_is_told_on_the_calling_thread_and_reaches_the_end() -> None:
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=sp.Atmosphere(quality="draft"))
    heard: list[tuple[str, float, int]] = []
    sky.render(width=64, progress=lambda stage, fraction: heard.append((stage, fraction, threading.get_ident())))
    assert {thread for _, _, thread in heard} == {threading.get_ident()}
    stages = list(dict.fromkeys(stage for stage, _, _ in heard))
    assert stages[0] == "solve" and len(stages) > 1
    for stage in stages:
        fractions = [fraction for name, fraction, _ in heard if name == stage]
        assert fractions == sorted(fractions) and 0.0 <= fractions[0] and fractions[-1] == 1.0, stage


def test_false_from_the_callback_cancels_and_the_air_can_be_used_again(whole_solve: tuple[float, int]) -> None:
    begin = time.perf_counter()
    with pytest.raises(sp.Cancelled):
        sp.Atmosphere(quality="standard", cache=False).solve(progress=lambda stage, fraction: False)
    assert time.perf_counter() - begin < 0.6 * whole_solve[0]
    air = sp.Atmosphere(quality="draft")
    with pytest.raises(sp.Cancelled):
        air.solve(progress=lambda stage, fraction: False)
    assert sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=air).illuminance().global_horizontal_lx > 0


def test_an_exception_of_the_callback_arrives_as_it_is() -> None:
    class Mine(Exception):
        pass

    def complain(stage: str, fraction: float) -> None:
        raise Mine(stage)

    with pytest.raises(Mine, match="solve"):
        sp.Atmosphere(quality="draft").solve(complain)
    with pytest.raises(TypeError):
        sp.Atmosphere(quality="draft").solve(lambda: None)  # type: ignore[arg-type,misc]


@pytest.fixture
def interruptible() -> Iterator[None]:
    """A shell starts its background jobs with SIGINT ignored, and Python leaves it so: then there is nothing to interrupt with."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_ctrl_c_interrupts_the_work(whole_solve: tuple[float, int]) -> None:
    air = sp.Atmosphere(quality="standard", cache=False)
    threading.Timer(0.05, _thread.interrupt_main).start()
    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        air.solve()
        time.sleep(5.0)
    assert time.perf_counter() - begin < 0.8 * whole_solve[0]


def test_other_threads_run_during_the_work(whole_solve: tuple[float, int]) -> None:
    seconds, turns = whole_solve
    # With the interpreter held there would be no turn at all; the machine may be busy, so a twentieth of them will do.
    assert turns > seconds / 0.005 / 20, f"{turns} turns in {seconds} s"


def test_several_threads_may_use_one_air(air: sp.Atmosphere) -> None:
    def zenith(altitude_deg: float) -> float:
        sky = sp.Sky.with_sun(altitude_deg=altitude_deg, azimuth_deg=0.0, atmosphere=air)
        return float(sky.spectral_radiance([0.0, 0.0, 1.0], [550.0])[0, 0])

    altitudes = [5.0, 20.0, 40.0, 60.0]
    results: dict[float, float] = {}
    threads = [threading.Thread(target=lambda a=a: results.update({a: zenith(a)})) for a in altitudes]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results == {altitude: zenith(altitude) for altitude in altitudes}


# Runs in a process of its own, so that a hang is one of that process. Each child says what it saw.
FORKING = """
import multiprocessing, sys, threading, time
import numpy, skyprobe as sp
from skyprobe import _core, post

air = sp.Atmosphere(quality="draft")
low = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=air)

def light(quality_of_new_air=None):
    own = air if quality_of_new_air is None else sp.Atmosphere(quality=quality_of_new_air)
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=own)
    pixels = sky.render(width=64).pixels
    shown, _ = post.tone_map(pixels, projection="latlong", white_luminance=1.0)
    times = [1.1e9 + 600.0 * k for k in range(200)]
    placed = sp.Sky(latitude=55.7, longitude=13.2, time="2005-06-21T13:00:00+02:00", atmosphere=own)
    return pixels, shown, sky.illuminance().global_horizontal_lx, placed.positions("Moon", times)

def same(a, b):
    return all(numpy.array_equal(x, y) for x, y in zip(a, b))

def main():
    fork = multiprocessing.get_context("fork")
    before = light()
    with fork.Pool(2) as pool:
        for found in pool.map(light, [None, "draft", None, "draft"]):
            assert same(found, before), "another light in a child"
    # A child of a child, after work in both.
    def child(connection):
        light()
        inner, outer = fork.Pipe()
        process = fork.Process(target=lambda: outer.send(light()))
        process.start()
        connection.send(inner.recv())
        process.join()
    here, there = fork.Pipe()
    process = fork.Process(target=child, args=(there,))
    process.start()
    assert same(here.recv(), before), "another light in a grandchild"
    process.join()
    assert same(light(), before), "the parent works on"
    print("equal")

def during():
    # A child made while another thread of its parent solves.
    fork = multiprocessing.get_context("fork")
    begun, go_on = threading.Event(), threading.Event()
    def listen(stage, fraction):
        begun.set()
        go_on.wait()
    thread = threading.Thread(target=lambda: sp.Atmosphere(quality="draft").solve(listen))
    thread.start()
    begun.wait()
    scene = sp.Scene(latitude=55.7, longitude=13.2, time="2005-06-21T13:00:00+02:00", output=["no_folder/a.exr"])
    tries = {
        "light": light,
        "Scene": lambda: sp.Scene(place="Lund", time="2005-06-21T13:00"),
        "Scene.from_json": lambda: sp.Scene.from_json(scene.to_json()),
        "Scene.load": lambda: sp.Scene.load("no_folder/a.json"),
        "Scene.replace": lambda: scene.replace(time="2005-06-21T14:00"),
        "Scene.save": lambda: scene.save("no_folder/a.json"),
        "Scene.render_to_files": scene.render_to_files,
        "render_to_file": lambda: low.render_to_file("no_folder/a.exr", width=64),
        "check_files": lambda: _core.check_files([], ["no_folder/a.exr"]),
    }
    def child(connection):
        for name, attempt in tries.items():
            try:
                attempt()
                connection.send(f"{name} worked")
            except RuntimeError as error:
                connection.send(str(error))
            except Exception as error:
                connection.send(f"{name}: {error!r}")
    here, there = fork.Pipe()
    process = fork.Process(target=child, args=(there,))
    process.start()
    for _ in tries:
        print(here.recv())
    process.join()
    go_on.set()
    thread.join()

def unpacking():
    # A child made while another thread of its parent asks the gazetteer its first question, which unpacks it.
    fork = multiprocessing.get_context("fork")
    thread = threading.Thread(target=lambda: sp.places.search("Lund"))
    thread.start()
    time.sleep(0.02)
    def child(connection):
        try:
            connection.send(sp.places.search("Lund")[0].name)
        except RuntimeError as error:
            connection.send(str(error))
    here, there = fork.Pipe()
    process = fork.Process(target=child, args=(there,))
    process.start()
    assert here.poll(60.0), "the child waits"
    print(here.recv())
    process.join()
    thread.join()

{"after": main, "during": during, "unpacking": unpacking}[sys.argv[1]]()
"""


def forked(when: str) -> str:
    environment = {**os.environ, "SKYPROBE_CACHE": "off", "PYTHONWARNINGS": "ignore"}
    done = subprocess.run(
        [sys.executable, "-c", FORKING, when], capture_output=True, text=True, timeout=120, check=False, env=environment
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.skipif(not hasattr(os, "fork"), reason="a system without fork")
def test_children_of_a_process_that_has_worked_work_and_see_the_same() -> None:
    assert forked("after") == "equal\n"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="a system without fork")
def test_a_child_of_a_process_at_work_says_so_at_once() -> None:
    told = forked("during").splitlines()
    assert len(told) == 9 and all("forked while another thread of its parent was at work" in line for line in told), told


@pytest.mark.skipif(not hasattr(os, "fork"), reason="a system without fork")
def test_a_child_made_while_the_gazetteer_is_unpacked_does_not_wait_for_ever() -> None:
    told = forked("unpacking")
    assert told == "Lund\n" or "forked while another thread of its parent was at work" in told
