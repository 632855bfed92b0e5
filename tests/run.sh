#!/usr/bin/env bash
# Sets up and passes all tests: the one command for a fresh Debian machine with Rust and Python 3.11.
#
#     tests/run.sh             # all
#     tests/run.sh --fast      # while you work: no Blender, no Mitsuba, no integration tests, no packages
#
# Makes its environments (setup_hosts.sh), builds the wheel and the Blender extension, checks the sources, runs the Rust and the Python
# tests; further arguments are for pytest. The last line says how many tests ran; the exit code is 0 only if nothing failed. Tests that need
# the shared reference (`../shared/reference`, or the folder that SKYPROBE_REFERENCE names) count as skipped where it is absent.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1
root=$PWD
fast=
[ "${1:-}" != --fast ] || { fast=1; shift; }
logs=$root/target/test-logs
mkdir -p "$logs"
# The wheel, the command line tool and the tests share one profile and one target folder, so that each dependency is compiled once.
export CARGO_TERM_COLOR=${CARGO_TERM_COLOR:-never}
export CARGO_TARGET_DIR=$root/target
python=$root/.venv/bin/python
export PYO3_PYTHON=$python
# Property tests draw the same inputs each time here, so that a change is judged by what it does; plain `cargo test` draws new ones.
export PROPTEST_RNG_SEED=${PROPTEST_RNG_SEED:-20051}
unset PYTHONPATH PYTHONHOME
# An air that several tests use is solved once. Neither the user's cache of solved light nor what an earlier run left has a part in the tests:
# the folder is of this run alone. Tests of a solve or of the cache say which cache they want, or none.
unset SKYPROBE_CACHE
mkdir -p "$CARGO_TARGET_DIR"
SKYPROBE_CACHE_DIR=$(mktemp -d "$CARGO_TARGET_DIR/light-of-this-run.XXXXXX") || exit 1
export SKYPROBE_CACHE_DIR
trap 'rm -rf "$SKYPROBE_CACHE_DIR"' EXIT
reference=${SKYPROBE_REFERENCE:-$root/../shared/reference}

failed=()
durations=()

# stage NAME COMMAND...: runs it, keeps its output in the logs too, notes how long it took and whether it failed.
stage() {
    local name=$1 start=$SECONDS status
    shift
    echo
    echo "=== $name"
    "$@" 2>&1 | tee "$logs/${name// /_}.log"
    status=${PIPESTATUS[0]}
    durations+=("$name $((SECONDS - start)) s")
    [ "$status" = 0 ] || failed+=("$name")
    return "$status"
}

build_wheel() {
    # One wheel in dist/, so that nobody tests an old one.
    rm -f dist/skyprobe-*.whl dist/skyprobe-*.zip
    # maturin finds zig by the python3 on the path. Linked by it the wheel loads where Blender does, whatever glibc is here; maturin checks that.
    PATH=$root/.venv/bin:$PATH "$root/.venv/bin/maturin" build --release --locked --out dist --interpreter "$python" \
        --compatibility manylinux_2_28 -- -C linker="$root/.ci/link_for_old_glibc.sh" \
        && "$python" -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall dist/skyprobe-*.whl \
        && (cd / && "$python" -c 'import skyprobe; print("skyprobe", skyprobe.__version__, "loads")')
}

clippy() {
    cargo clippy --version > /dev/null 2>&1 || { echo "clippy is not installed: left out"; return 0; }
    cargo clippy --release --locked --all-targets -- -D warnings \
        && cargo clippy --release --locked --lib --features python -- -D warnings
}

format() {
    cargo fmt --version > /dev/null 2>&1 || { echo "rustfmt is not installed: left out"; return 0; }
    cargo fmt --check
}

# With the tests come the tool and what they share: built by itself the tool would compile the library again, as the tests' own dependencies
# switch features of shared ones on.
build() {
    cargo test --release --locked --no-run
}

rust_tests() {
    local asked=()
    if [ -d "$reference" ]; then
        asked=(-- --include-ignored)
    else
        echo "skipped: needs ../shared/reference (each \"ignored\" below)"
    fi
    cargo test --release --locked --no-fail-fast "${asked[@]}"
}

python_tests() {
    SKYPROBE_BINARY=$root/target/release/skyprobe "$python" -m pytest --junitxml="$logs/python.xml" "$@"
}

fast_build() {
    cargo build --release --locked --bin skyprobe && cargo test --release --locked --lib --no-run
}

# The module as it is in the sources, without a wheel.
fast_module() {
    cargo build --release --locked --lib --features python \
        && rm -rf target/module && mkdir target/module && cp -r python/skyprobe target/module/ \
        && cp target/release/libskyprobe.so target/module/skyprobe/_core.abi3.so
}

fast_python_tests() {
    PYTHONPATH=$root/target/module python_tests --ignore=tests/blender --ignore=tests/mitsuba --ignore=tests/test_two_renderers.py \
        --ignore=tests/test_packages.py "$@"
}

# Prints "ran failed skipped" of each side, from what the tools reported.
count_rust() {
    awk '/^test result:/ { ran += $4 + $6; failed += $6; skipped += $8 } END { print ran + 0, failed + 0, skipped + 0 }' "$logs/Rust_tests.log" 2> /dev/null \
        || echo 0 0 0
}

count_python() {
    "$python" - "$logs/python.xml" 2> /dev/null << 'COUNT' || echo 0 0 0
import sys
import xml.etree.ElementTree as ElementTree

totals = {name: 0 for name in ("tests", "failures", "errors", "skipped")}
for suite in ElementTree.parse(sys.argv[1]).getroot().iter("testsuite"):
    for name in totals:
        totals[name] += int(suite.get(name, 0))
print(totals["tests"] - totals["skipped"], totals["failures"] + totals["errors"], totals["skipped"])
COUNT
}

rm -f "$logs"/*
stage "setup" tests/setup_hosts.sh ${fast:+--python} || { echo "tests: 0 ran, setup failed"; exit 1; }
# For everything that is compiled, not the wheel alone: other flags would compile each dependency again.
CARGO_ENCODED_RUSTFLAGS=$("$python" .ci/remap_paths.py) || { echo "tests: 0 ran, cargo does not know the crates"; exit 1; }
export CARGO_ENCODED_RUSTFLAGS
stage "format" format
if [ -n "$fast" ]; then
    # The crate is compiled by parts, its dependencies as they are.
    export CARGO_INCREMENTAL=1
    stage "clippy" clippy
    stage "build" fast_build
    stage "Rust tests" cargo test --release --locked --lib
    stage "module" fast_module && stage "Python tests" fast_python_tests "$@"
else
    stage "clippy" clippy
    stage "build" build
    stage "Rust tests" rust_tests
    if stage "wheel" build_wheel; then
        stage "Blender extension" "$python" blender_addon/build.py
        stage "Python tests" python_tests "$@"
    fi
fi

read -r rust_ran rust_failed rust_skipped < <(count_rust)
read -r python_ran python_failed python_skipped < <(count_python)
echo
echo "=== durations"
printf '%s\n' "${durations[@]}"
[ ${#failed[@]} = 0 ] || echo "failed stages: $(IFS=,; echo "${failed[*]}")"
echo "tests: $((rust_ran + python_ran)) ran ($rust_ran Rust, $python_ran Python), $((rust_failed + python_failed)) failed," \
    "$((rust_skipped + python_skipped)) skipped, in $SECONDS s"
[ ${#failed[@]} = 0 ] && [ "$rust_ran" -gt 0 ] && [ "$python_ran" -gt 0 ]
