#!/usr/bin/env bash
# Makes what the tests need around skyprobe itself, at the root of the checkout:
#   .venv         maturin, pytest, Mitsuba and what judges the results   (tests/requirements.txt)
#   .venv-bpy42   Blender 4.2 LTS as a Python module                     (tests/requirements-bpy42.txt)
#   .venv-bpy45   Blender 4.5 LTS                                        (tests/requirements-bpy45.txt)
#   .venv-bpy50   Blender 5.0                                            (tests/requirements-bpy50.txt)
# and the Debian packages that they load. What is there already is left alone, so that a second call takes no time.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

fail() {
    echo "setup: $*" >&2
    exit 1
}

# The bpy modules load the graphics and window libraries even without a window; Dr.Jit compiles Mitsuba's llvm_* variants with LLVM
# (Debian's LLVM 15 fails on recent processors); rustc links with cc.
packages=(
    libgl1 libegl1 libgomp1 libice6 libsm6 libx11-6 libxext6 libxfixes3 libxi6 libxkbcommon0 libxrender1 libxxf86vm1
    libllvm19
    gcc libc6-dev ca-certificates
    # A Blender with a window, a virtual screen and OpenGL in software; it takes numpy from the system.
    blender python3-numpy xvfb libgl1-mesa-dri
)

as_root() {
    if [ "$(id -u)" = 0 ]; then
        "$@"
    elif command -v sudo > /dev/null; then
        sudo "$@"
    else
        fail "these Debian packages are missing, and this is neither root nor is there sudo; install them and come back: ${missing[*]}"
    fi
}

install_missing() {
    command -v dpkg-query > /dev/null || fail "this is not Debian; install what stands for these packages: $*"
    missing=()
    for package in "$@"; do
        state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null || true)
        [ "$state" = installed ] || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    echo "setup: installing ${missing[*]}"
    as_root apt-get update -qq
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null
}

# Prints the path of a Python 3.11 that can make virtual environments; bpy exists for this version only.
find_python() {
    local candidate
    for candidate in python3.11 python3 /usr/bin/python3.11 "${PYENV_ROOT:-$HOME/.pyenv}"/versions/3.11*/bin/python3.11; do
        candidate=$(command -v "$candidate" 2> /dev/null) || continue
        "$candidate" -c 'import sys, ensurepip, venv; sys.exit(sys.version_info[:2] != (3, 11))' 2> /dev/null || continue
        "$candidate" -c 'import sys; print(sys.executable)'
        return 0
    done
    return 1
}

# make_environment FOLDER REQUIREMENTS: as stated there, made anew only if the statement or the Python changed.
make_environment() {
    local folder=$root/$1 wanted
    wanted="$("$python" -V) $(cksum < "$root/tests/$2")"
    if [ "$(cat "$folder/made-from" 2> /dev/null || true)" = "$wanted" ]; then
        echo "setup: $1 is there"
        return 0
    fi
    echo "setup: making $1"
    rm -rf "$folder"
    "$python" -m venv "$folder"
    "$folder/bin/python" -m pip install --quiet --disable-pip-version-check --requirement "$root/tests/$2"
    echo "$wanted" > "$folder/made-from"
}

install_missing "${packages[@]}"
if ! python=$(find_python); then
    # Debian ships the interpreter without the part that makes environments.
    /usr/bin/python3.11 -V > /dev/null 2>&1 || fail "Python 3.11 is missing (the bpy modules exist for it only)"
    install_missing python3.11-venv
    python=$(find_python) || fail "Python 3.11 cannot make virtual environments (module ensurepip)"
fi
make_environment .venv requirements.txt
for version in 42 45 50; do
    make_environment ".venv-bpy$version" "requirements-bpy$version.txt"
    # From another folder, where nothing hides the module; it may hang when the interpreter winds down.
    (cd / && "$root/.venv-bpy$version/bin/python" -c 'import bpy, os, sys; print("setup: Blender", bpy.app.version_string, "loads"); sys.stdout.flush(); os._exit(0)') \
        || fail "the bpy of .venv-bpy$version does not load"
done
(cd / && "$root/.venv/bin/python" -c 'import mitsuba; print("setup: Mitsuba", mitsuba.__version__, "loads")') || fail "Mitsuba does not load"
