#!/usr/bin/env bash
# Makes what the tests need around skyprobe itself, at the root of the checkout:
#   .venv         maturin, pytest, Mitsuba and what judges the results   (tests/requirements.txt)
#   .venv-bpy42   Blender 4.2 LTS as a Python module                     (tests/requirements-bpy42.txt)
#   .venv-bpy45   Blender 4.5 LTS                                        (tests/requirements-bpy45.txt)
#   .venv-bpy52   Blender 5.2 LTS, with Python 3.13                      (tests/requirements-bpy52.txt)
#   .venv-bpy53   Blender 5.3, with Python 3.13                          (tests/requirements-bpy53.txt)
# and the Debian packages that they load; with --python .venv alone. A bpy that is no longer on the index gives way to the newest of its series. What is there already is left alone, so that a second call takes no time.
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

# find_python VERSION: prints the path of a Python of that version, such as 3.11, that can make virtual environments.
find_python() {
    local candidate
    for candidate in "python$1" python3 "/usr/bin/python$1" "${PYENV_ROOT:-$HOME/.pyenv}/versions/$1"*/"bin/python$1"; do
        candidate=$(command -v "$candidate" 2> /dev/null) || continue
        "$candidate" -c "import sys, ensurepip, venv; sys.exit('%d.%d' % sys.version_info[:2] != '$1')" 2> /dev/null || continue
        "$candidate" -c 'import sys; print(sys.executable)'
        return 0
    done
    return 1
}

# new_environment PYTHON FOLDER: an empty virtual environment.
new_environment() {
    if [ "$1" = "$root/.python313/bin/python" ]; then
        mkdir -p "$2/bin" "$2/lib/python3.13/site-packages"
        cp "$1" "$2/bin/python"
        cp "$root/.python313/pyvenv.cfg" "$2/pyvenv.cfg"
    else
        "$1" -m venv "$2"
    fi
}

# fill_environment FOLDER REQUIREMENTS: with the pip of .venv, as not every environment has one.
fill_environment() {
    "$root/.venv/bin/python" -m pip --python "$1/bin/python" install --quiet --disable-pip-version-check --requirement "$2"
}

# make_environment PYTHON FOLDER REQUIREMENTS: as stated there, made anew only if the statement or the Python changed.
make_environment() {
    local python=$1 folder=$root/$2 requirements=$root/tests/$3 wanted
    wanted="$("$python" -V) $(cksum < "$requirements")"
    if [ "$(cat "$folder/made-from" 2> /dev/null || true)" = "$wanted" ]; then
        echo "setup: $2 is there"
        return 0
    fi
    echo "setup: making $2"
    rm -rf "$folder"
    new_environment "$python" "$folder"
    if ! fill_environment "$folder" "$requirements" 2> "$folder/log"; then
        if ! grep -q '^bpy==' "$requirements" || ! grep -q 'No matching distribution found for bpy==' "$folder/log"; then
            cat "$folder/log" >&2
            fail "$2 could not be made"
        fi
        sed -E 's/^bpy==([0-9]+\.[0-9]+)\..*/bpy==\1.*/' "$requirements" > "$folder/requirements.txt"
        echo "setup: $(grep '^bpy==' "$requirements") is no longer on the index; taking the newest of $(grep '^bpy==' "$folder/requirements.txt")"
        fill_environment "$folder" "$folder/requirements.txt" || fail "$2 could not be made"
    fi
    echo "$wanted" > "$folder/made-from"
}

[ "${1:-}" = --python ] || install_missing "${packages[@]}"
if ! python311=$(find_python 3.11); then
    # Debian ships the interpreter without the part that makes environments.
    /usr/bin/python3.11 -V > /dev/null 2>&1 || fail "Python 3.11 is missing (the bpy modules of Blender 4 exist for it only)"
    install_missing python3.11-venv
    python311=$(find_python 3.11) || fail "Python 3.11 cannot make virtual environments (module ensurepip)"
fi
make_environment "$python311" .venv requirements.txt
[ "${1:-}" != --python ] || exit 0
if ! python313=$(find_python 3.13); then
    "$root/tests/setup_python313.sh"
    python313=$root/.python313/bin/python
fi
for version in 42 45 52 53; do
    # The bpy modules exist for one Python each.
    case $version in
        4*) python=$python311 ;;
        *) python=$python313 ;;
    esac
    make_environment "$python" ".venv-bpy$version" "requirements-bpy$version.txt"
    # From another folder, where nothing hides the module; it may hang when the interpreter winds down.
    (cd / && "$root/.venv-bpy$version/bin/python" -c 'import bpy, os, sys; print("setup: Blender", bpy.app.version_string, "loads"); sys.stdout.flush(); os._exit(0)') \
        || fail "the bpy of .venv-bpy$version does not load"
done
(cd / && "$root/.venv/bin/python" -c 'import mitsuba; print("setup: Mitsuba", mitsuba.__version__, "loads")') || fail "Mitsuba does not load"
