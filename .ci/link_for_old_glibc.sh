#!/bin/sh
# A linker for the wheel on Linux: zig's, against the glibc of 2018 that Blender asks for. It takes nothing but the place of the last link, so
# that all else is compiled once for wheel, tool and tests. Needs maturin on the path and ziglang for its python3 (tests/requirements.txt).
exec maturin zig cc -- -target "$(uname -m)-linux-gnu.2.28" "$@"
