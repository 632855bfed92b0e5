#!/usr/bin/env bash
# Builds the command line tool, the wheel and the extension's zip for Windows on a Debian, and tries the tool under Wine. Optional: no part of
# the test command. Needs root, the mirror and the registry of crates that this machine uses anyway, 8 GB and, on two cores, three quarters of an hour.
#
#     .ci/windows.sh            # all
#     .ci/windows.sh tool       # or one of: root, tool, wheel, tests
#
# What is made lies in dist/: skyprobe-VERSION-windows_x64-tool.zip, skyprobe-VERSION-cp311-abi3-win_amd64.whl, skyprobe-VERSION-windows_x64.zip.
# The root (Debian sid with its Rust, MinGW and Wine) is target/windows-root, the build target/windows; `rm -rf` of both undoes it. The standard
# library is compiled too: no distribution has it for this target. docs/packaging.md says what was run.
set -euo pipefail
checkout=$(cd "$(dirname "$0")/.." && pwd)
root=$checkout/target/windows-root
build=$checkout/target/windows
target=x86_64-pc-windows-gnu
packages=(ca-certificates rustc cargo rust-src gcc-mingw-w64-x86-64 wine wine64 python3)

fail() {
    echo "windows: $*" >&2
    exit 1
}

make_root() {
    [ ! -e "$root/made" ] || return 0
    command -v debootstrap > /dev/null || { apt-get update -qq && apt-get install -y -qq --no-install-recommends debootstrap > /dev/null; }
    # The mirror that this machine is set up for.
    local mirror
    mirror=$(apt-get indextargets --format '$(SITE) $(ORIGIN) $(CREATED_BY)' | awk '$2 == "Debian" && $3 == "Packages" { print $1; exit }')
    [ -n "$mirror" ] || fail "this machine has no Debian mirror"
    rm -rf "$root"
    mkdir -p "$build"
    echo "windows: making the root"
    debootstrap --variant=minbase sid "$root" "$mirror" > "$build/root.log" 2>&1 || fail "debootstrap failed; see target/windows/root.log"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    # No services start in there.
    printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"
    chmod +x "$root/usr/sbin/policy-rc.d"
    chroot "$root" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}" \
        > "$build/root.log" 2>&1 || fail "packages could not be installed; see target/windows/root.log"
    rm -rf "$root"/var/cache/apt/* "$root"/var/lib/apt/lists/*
    # How this machine reaches the registry of crates, and whom it trusts.
    cp /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/ca-certificates.crt"
    mkdir -p "$root/root/.cargo" "$root/skyprobe"
    local settings
    for settings in config.toml config; do
        [ ! -e "${CARGO_HOME:-$HOME/.cargo}/$settings" ] || cp "${CARGO_HOME:-$HOME/.cargo}/$settings" "$root/root/.cargo/"
    done
    touch "$root/made"
}

# inside COMMAND...: in the root, with the checkout in /skyprobe. Its mounts end with it. Folders are the same on every machine, so that none of
# this one gets into what is built.
inside() {
    unshare --mount bash -c '
        set -e
        mount --bind "$1" "$2/skyprobe"
        mount -t proc proc "$2/proc"
        mount --rbind /dev "$2/dev"
        root=$2
        shift 2
        exec chroot "$root" env --chdir=/skyprobe "$@"
    ' inside "$checkout" "$root" -i PATH=/usr/bin:/bin HOME=/root CARGO_TARGET_DIR=/skyprobe/target/windows CARGO_TERM_COLOR=never \
        SSL_CERT_FILE=/etc/ssl/certs/ca-certificates.crt RUSTC_BOOTSTRAP=1 \
        $(env | grep -iE '^((http|https|all|no)_proxy|cargo_(http|net)_[a-z_]*)=' | tr '\n' ' ') "$@"
}

build_tool() {
    inside cargo build --release --locked --target "$target" -Zbuild-std=std,panic_abort
    inside sh -c 'cd /tmp && XDG_RUNTIME_DIR=/tmp WINEDEBUG=-all wine /skyprobe/target/windows/$1/release/skyprobe.exe --version' version "$target"
}

version() {
    sed -n 's/^version = "\(.*\)"/\1/p' "$checkout/Cargo.toml" | head -1
}

pack_tool() {
    local folder
    folder=$(mktemp -d)
    cp "$build/$target/release/skyprobe.exe" "$checkout"/LICENSE-* "$folder"
    cp "$folder/skyprobe.exe" "$root/tmp/skyprobe.exe"
    inside x86_64-w64-mingw32-strip /tmp/skyprobe.exe
    mv "$root/tmp/skyprobe.exe" "$folder/skyprobe.exe"
    mkdir -p "$checkout/dist"
    rm -f "$checkout/dist/skyprobe-$(version)-windows_x64-tool.zip"
    (cd "$folder" && python3 -m zipfile -c "$checkout/dist/skyprobe-$(version)-windows_x64-tool.zip" *)
    rm -rf "$folder"
}

# maturin is the one of the tests' environment (tests/setup_hosts.sh), which needs no Python to make an abi3 wheel.
build_wheel() {
    local maturin=${MATURIN:-$checkout/.venv/bin/maturin} wheel
    [ -x "$maturin" ] || fail "there is no $maturin: run tests/setup_hosts.sh, or name one in MATURIN"
    cp "$maturin" "$root/usr/bin/maturin"
    inside maturin build --release --locked --target "$target" -Zbuild-std=std,panic_abort --out /skyprobe/dist
    wheel=$checkout/dist/skyprobe-$(version)-cp311-abi3-win_amd64.whl
    [ -e "$wheel" ] || fail "the wheel is not $wheel"
    python3 "$checkout/.ci/check_windows_module.py" "$wheel"
    python3 "$checkout/blender_addon/build.py" "$wheel"
}

run_tests() {
    # Wine keeps names beyond ASCII only where the system's are UTF-8.
    inside env LANG=C.UTF-8 CARGO_TARGET_X86_64_PC_WINDOWS_GNU_RUNNER=wine WINEDEBUG=-all XDG_RUNTIME_DIR=/tmp PROPTEST_RNG_SEED=20051 \
        cargo test --release --locked --target "$target" -Zbuild-std=std,panic_abort --test integration -- cli:: cli_files:: windows::
}

[ "$(id -u)" = 0 ] || fail "a folder becomes a root only for root"
make_root
case ${1:-all} in
    root) ;;
    tool) build_tool && pack_tool ;;
    wheel) build_wheel ;;
    tests) run_tests ;;
    all)
        build_tool
        pack_tool
        run_tests
        build_wheel
        ;;
    *) fail "what is $1? root, tool, wheel or tests" ;;
esac
