#!/usr/bin/env bash
# Makes .window at the root of the checkout: a small Debian trixie with its Blender 4.3, a newer window than bookworm's 3.4 offers.
# Optional: where it is, the tests that need a window use it too. Needs root and a Debian; three minutes, 1.7 GB. `rm -rf .window` undoes it.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
target=$root/.window
suite=trixie

fail() {
    echo "setup: $*" >&2
    exit 1
}

[ "$(id -u)" = 0 ] || fail "a folder becomes a root only for root"
if [ -e "$target/made" ]; then
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
chroot "$target" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends blender python3-numpy libgl1-mesa-dri \
    > "$root/target/window.log" 2>&1 || fail "Blender could not be installed; see target/window.log"
rm -rf "$target"/var/cache/apt/* "$target"/var/lib/apt/lists/* "$target"/usr/share/doc "$target"/usr/share/locale
chroot "$target" blender --version | head -1 | sed 's/^/setup: window of /'
touch "$target/made"
