#!/usr/bin/env bash
# Makes .window at the root of the checkout: a small Debian sid with its Blender, 5.2 LTS or later, a newer window than bookworm's 3.4 offers.
# Optional, as sid moves: where it is, the tests that need a window use it too. Needs root and a Debian; three minutes, 1.7 GB. `rm -rf .window`
# undoes it.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
target=$root/.window
suite=sid
# Without cattr the extensions of Blender fail as it starts, without libgl1 no window opens.
packages=(blender python3-numpy libgl1-mesa-dri libgl1 libegl1 python3-cattr python3-requests python3-zstandard)

fail() {
    echo "setup: $*" >&2
    exit 1
}

[ "$(id -u)" = 0 ] || fail "a folder becomes a root only for root"
if [ "$(cat "$target/made" 2> /dev/null || true)" = "$suite" ]; then
    echo "setup: .window is there"
    exit 0
fi
command -v debootstrap > /dev/null || { apt-get update -qq && apt-get install -y -qq --no-install-recommends debootstrap > /dev/null; }
# The mirror that this machine is set up for.
mirror=$(apt-get indextargets --format '$(SITE) $(ORIGIN) $(CREATED_BY)' | awk '$2 == "Debian" && $3 == "Packages" { print $1; exit }')
[ -n "$mirror" ] || fail "this machine has no Debian mirror"
rm -rf "$target"
echo "setup: making .window"
debootstrap --variant=minbase "$suite" "$target" "$mirror" > "$root/target/window.log" 2>&1 || fail "debootstrap failed; see target/window.log"
cp /etc/resolv.conf "$target/etc/resolv.conf"
# No services start in there.
printf '#!/bin/sh\nexit 101\n' > "$target/usr/sbin/policy-rc.d"
chmod +x "$target/usr/sbin/policy-rc.d"
chroot "$target" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}" \
    > "$root/target/window.log" 2>&1 || fail "Blender could not be installed; see target/window.log"
rm -rf "$target"/var/cache/apt/* "$target"/var/lib/apt/lists/* "$target"/usr/share/doc "$target"/usr/share/locale
chroot "$target" blender --version | head -1 | sed 's/^/setup: window of /'
echo "$suite" > "$target/made"
