#!/usr/bin/env bash
# Makes .python313 at the root of the checkout: Python 3.13 of Debian trixie for older Debians, unpacked and nowhere installed, so that neither
# root nor another root folder is needed. 25 s, 49 MB; `rm -rf .python313` undoes it. Its libraries are its own: the interpreter runs by its own
# loader. Prints nothing if it is there.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
target=$root/.python313
suite=trixie
packages=(
    python3.13-minimal libpython3.13-minimal libpython3.13-stdlib
    libc6 libgcc-s1 libstdc++6 zlib1g libexpat1 libssl3t64 libffi8 libbz2-1.0 liblzma5 libsqlite3-0 libuuid1
)

fail() {
    echo "setup: $*" >&2
    exit 1
}

[ ! -e "$target/made" ] || exit 0
command -v apt-get > /dev/null || fail "this is not Debian; install Python 3.13 with its module venv"
# The mirror that this machine is set up for.
mirror=$(apt-get indextargets --format '$(SITE) $(ORIGIN) $(CREATED_BY)' | awk '$2 == "Debian" && $3 == "Packages" { print $1; exit }')
[ -n "$mirror" ] || fail "this machine has no Debian mirror, or never asked it: apt-get update"
echo "setup: making .python313"
rm -rf "$target"
apt=$target/apt
mkdir -p "$apt"/lists/partial "$apt"/cache/archives/partial "$apt"/packages
: > "$apt/status"
keys=/usr/share/keyrings/debian-archive-keyring.gpg
signed=
[ ! -e "$keys" ] || signed="[signed-by=$keys] "
echo "deb $signed$mirror $suite main" > "$apt/sources.list"
# Names and keys of the machine's own apt count, its sources and what is installed do not.
cat > "$apt/apt.conf" << CONF
Dir::Etc::sourcelist "$apt/sources.list";
Dir::Etc::sourceparts "/dev/null";
Dir::Etc::preferences "/dev/null";
Dir::Etc::preferencesparts "/dev/null";
Dir::State "$apt";
Dir::State::lists "$apt/lists";
Dir::State::status "$apt/status";
Dir::Cache "$apt/cache";
Acquire::Languages "none";
Acquire::IndexTargets::deb::DEP-11::DefaultEnabled "false";
APT::Sandbox::User "$(id -un)";
APT::Default-Release "";
CONF
(
    cd "$apt/packages"
    apt-get --config-file "$apt/apt.conf" -qq update
    apt-get --config-file "$apt/apt.conf" -qq download "${packages[@]}"
) > "$target/log" 2>&1 || fail "Debian's Python 3.13 could not be fetched; see .python313/log"
for package in "$apt"/packages/*.deb; do
    dpkg-deb -x "$package" "$target"
done
rm -rf "$apt"

loaders=("$target"/usr/lib*/ld-linux-*.so.*)
libraries=("$target"/usr/lib/*-linux-gnu)
[ -e "${loaders[0]}" ] && [ -d "${libraries[0]}" ] || fail "Debian's Python 3.13 is not where it was expected in .python313"
# An environment in the sense of venv: a copy of these two files is another. The interpreter is told its own name, which says where its
# environment is. No folder of the machine is in the path of libraries: an older one of the same name would be taken.
mkdir "$target/bin"
cat > "$target/bin/python" << RUN
#!/bin/sh
exec "${loaders[0]}" --argv0 "\$0" --library-path "${libraries[0]}" "$target/usr/bin/python3.13" "\$@"
RUN
chmod +x "$target/bin/python"
printf 'home = %s\ninclude-system-site-packages = false\n' "$target/usr/bin" > "$target/pyvenv.cfg"
"$target/bin/python" -c 'import bz2, ctypes, lzma, sqlite3, ssl, uuid' || fail "the Python 3.13 of .python313 does not run"
touch "$target/made"
