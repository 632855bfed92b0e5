#!/bin/sh
# in_window_root.sh ROOT CHECKOUT COMMAND...: runs COMMAND with the folder ROOT (made by setup_window.sh) for a root, in which CHECKOUT, /tmp,
# /dev and /proc are those of this machine, under the same paths. To be called by `unshare --mount`: the mounts end with the process.
set -eu
root=$1
checkout=$2
shift 2
mkdir -p "$root/$checkout"
mount --bind "$checkout" "$root/$checkout"
mount --bind /tmp "$root/tmp"
mount --rbind /dev "$root/dev"
mount -t proc proc "$root/proc"
exec chroot "$root" "$@"
