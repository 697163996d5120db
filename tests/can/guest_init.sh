#!/bin/busybox sh
# shellcheck shell=dash
# First process of the machine that ci/test-can emulates: loads modules, goes over to the host's files (read-only), runs the cases, stops.
bb=/bin/busybox
$bb mount -t proc proc /proc
while read -r module; do $bb insmod "/modules/$module" || echo "guest: no module $module"; done </modules/order
for word in $($bb cat /proc/cmdline); do
    case $word in fernlicht.results=*) results=${word#*=} ;; esac
done
$bb mount -t 9p -o trans=virtio,version=9p2000.L,ro,cache=loose,msize=524288 host /host || $bb poweroff -f
$bb mount -t 9p -o trans=virtio,version=9p2000.L,msize=131072 results "/host$results" || $bb poweroff -f
$bb mount -t proc proc /host/proc
$bb mount -t sysfs sys /host/sys
$bb mount -t devtmpfs dev /host/dev
$bb ln -s /proc/self/fd /host/dev/fd
$bb mkdir -p /host/dev/shm
$bb mount -t tmpfs tmpfs /host/dev/shm
# shellcheck disable=SC2016 # the inner shell's
$bb chroot /host /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 HOME=/dev/shm TMPDIR=/dev/shm /bin/bash -c '
    echo "guest: booted after $(cut -d " " -f 1 /proc/uptime) s"
    mapfile -t arguments <"$1/arguments"
    cd "${arguments[0]}" && bash tests/can/cases.sh "${arguments[@]:1}"
    echo "$?" >"$1/code"' guest "$results"
$bb poweroff -f
