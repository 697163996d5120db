#!/usr/bin/env bash
# What ci/test-can runs on virtual CAN interfaces of the kernel, as root: here or in the machine that it emulates.
#   tests/can/cases.sh RESULTS PROGRAM [CASE...]     RESULTS: a folder; gets results.txt, reports and logs
# A case is a function case_NAME; it fails with the first check that does not hold. Figures stand in lines "figure: ...".
set -uo pipefail
here=$PWD/tests/can
results=$1
program=$2
shift 2
scratch=$(mktemp --directory)
if=flcan0
drive=$here/live.yaml
started=()
: >"$results/results.txt"

say() { echo "  $*"; }
figure() { echo "  figure: $*" | tee -a "$results/figures.txt"; }
# hold TEXT TEST...: the case ends where it does not.
hold() {
    local text=$1
    shift
    "$@" && return
    say "does not hold: $text ($*)"
    exit 1
}
more() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b) }'; }
between() { awk -v a="$1" -v b="$2" -v c="$3" 'BEGIN { exit !(a >= b && a <= c) }'; }

interface_up() {
    hold "interface $if" ip link add dev "$if" type vcan
    ip link set "$if" up
}
interface_away() { ip link delete "$if" 2>/dev/null; }

# live NAME [FLAG...]: starts it with its report in $scratch/NAME and waits until it listens. It ends by itself (--duration; `finish NAME 0`
# waits for that) or when all is said (`stop NAME`), so that nothing here depends on how fast the machine is.
live() {
    local name=$1
    shift
    "$program" live "$drive" --can "$if" --no-draw --out "$scratch/$name" "$@" >"$scratch/$name.out" 2>&1 &
    live_pid=$!
    started+=("$live_pid")
    for ((i = 0; i < 600; i++)); do
        [[ -e $scratch/$name/can-live-bend-light.log ]] && return
        kill -0 "$live_pid" 2>/dev/null || break
        sleep 0.1
    done
    cat "$scratch/$name.out"
    say "live did not start"
    exit 1
}
# finish NAME CODE
finish() {
    local code=0
    wait "$live_pid" || code=$?
    sed 's/^/  | /' "$scratch/$1.out"
    hold "exit code of live" test "$code" = "$2"
}
# stop NAME: Ctrl-C after it had time to read what is left.
stop() {
    sleep 0.5
    kill -INT "$live_pid"
    finish "$1" 130
}
# flat NAME: its live.json in one line.
flat() { tr '\n' ' ' <"$scratch/$1/live.json" | sed 's/: */: /g; s/, */, /g; s/  */ /g'; }
# json NAME KEY: a number of its live.json; of a key that is there several times the first.
json() { flat "$1" | grep -o "\"$2\": [^,}]*" | head -n 1 | sed 's/.*: //; s/ *$//'; }
# ticks_ms NAME lateness_s|work_s p50|p99|max: in ms
ticks_ms() { flat "$1" | grep -o "\"$2\": {[^}]*}" | grep -o "\"$3\": [^,}]*" | awk '{ printf "%.3f", 1000 * $2 }'; }
late() { ticks_ms "$1" lateness_s "$2"; }
# over NAME KIND: an outage of this kind that has an end.
over() { flat "$1" | grep -q "\"kind\": \"$2\", \"from_s\": [^,]*, \"until_s\": [0-9]"; }
lateness() { echo "ticks late by $(late "$1" p50) ms (p50), $(late "$1" p99) ms (p99), $(late "$1" max) ms (max)"; }
transmitted() { cat "/sys/class/net/$if/statistics/tx_packets"; }
keep() { cp -r "$scratch/$1" "$results/"; }

# What everyone else on the bus says: speed and yaw rate every 20 ms, as a log for canplayer. SECONDS
bus_log() {
    awk -v seconds="$1" -v name="$if" 'BEGIN {
        for (k = 0; k < seconds * 50; k++) {
            t = k * 0.02
            speed = int((50 + 10 * sin(t)) * 100); yaw = int(800 * sin(t * 0.9))
            if (yaw < 0) yaw += 65536
            printf "(%.6f) %s 101#%02X%02X%02X%02X00000000\n", 1000 + t, name, speed % 256, int(speed / 256), yaw % 256, int(yaw / 256)
        }
    }'
}

# --- Cases ---

case_refusals() {
    local said code
    refused() { # CODE TEXT COMMAND...
        local wanted=$1 text=$2
        shift 2
        code=0
        said=$("$@" 2>&1) || code=$?
        say "$said"
        hold "exit code" test "$code" = "$wanted"
        hold "text '$text'" grep -qF -- "$text" <<<"$said"
        hold "one line" test "$(wc -l <<<"$said")" = 1
    }
    ip link add dev "$if" type vcan
    refused 2 "found no interface 'nocan7', expected a CAN interface; there: $if" "$program" live "$drive" --can nocan7 --no-draw --out "$scratch/r1"
    refused 2 "network interface of another kind" "$program" live "$drive" --can lo --no-draw --out "$scratch/r1"
    refused 3 "interface $if is down" "$program" live "$drive" --can "$if" --no-draw --out "$scratch/r1"
    ip link set "$if" up
    sed 's/SG_ Speed : 0|16/SG_ Speed : 0|160/' "$here/live.dbc" >"$scratch/live.dbc"
    sed "s|\.\./\.\./|$PWD/|" "$drive" >"$scratch/live.yaml"
    refused 2 "live.dbc:14" "$program" live "$scratch/live.yaml" --can "$if" --no-draw --out "$scratch/r1"
    printf 'VERSION ""\nBO_ 1 A: 8 X\n SG_ ' >"$scratch/live.dbc"
    refused 2 "live.dbc:3" "$program" live "$scratch/live.yaml" --can "$if" --no-draw --out "$scratch/r1"
    hold "no folder left behind" test ! -e "$scratch/r1"
}

# Outputs as others on the bus see them: content, order and cycle; inputs played by canplayer.
case_outputs() {
    interface_up
    bus_log 6 >"$scratch/bus.log"
    candump -L "$if" >"$scratch/candump.log" &
    started+=("$!")
    live outputs --duration 5 --lossless
    canplayer -I "$scratch/bus.log" &
    started+=("$!")
    finish outputs 0
    sleep 0.2
    hold "frames of canplayer used" between "$(json outputs frames_used)" 150 300
    # What we say that we sent is what candump saw, byte by byte.
    # Since 6.1 the kernel marks CAN FD frames in a flag that candump prints (4).
    awk '$3 ~ /^201#|^202#/ { sub("##4", "##0", $3); print $3 }' "$scratch/candump.log" >"$scratch/seen"
    awk '{ print $3 }' "$scratch/outputs/can-live-bend-light.log" >"$scratch/sent"
    diff "$scratch/seen" "$scratch/sent" | head -n 6
    hold "candump saw what was sent" cmp "$scratch/seen" "$scratch/sent"
    hold "250 + 100 frames" test "$(wc -l <"$scratch/sent")" = 350
    hold "swivel moved" test "$(grep -c '^201#0000' "$scratch/sent")" -lt 200
    hold "CAN FD" test "$(grep -c '^202##' "$scratch/sent")" = 100
    # Cycle times by candump's stamps: exact but for how late the first and the last frame were: at most as a tick's begin and
    # work, and 10 ms.
    awk '$3 ~ /^201#/ { t = substr($1, 2) + 0; if (n++) { d = t - last; s += d; if (d > most) most = d } last = t } END { printf "%.6f %.6f %d\n", s / (n - 1), most, n }' \
        "$scratch/candump.log" >"$scratch/cycle"
    read -r mean most count <"$scratch/cycle"
    figure "outputs: 201# every 20 ms: $count frames, mean $(awk -v x="$mean" 'BEGIN { printf "%.3f", 1000 * x }') ms, longest $(awk -v x="$most" 'BEGIN { printf "%.1f", 1000 * x }') ms; $(lateness outputs)"
    hold "mean cycle" awk -v mean="$mean" -v late="$(late outputs max)" -v work="$(ticks_ms outputs work_s max)" 'BEGIN { off = 1000 * mean - 20; exit !(249 * (off < 0 ? -off : off) <= late + work + 10) }'
    keep outputs
}

# A recording of a live run, played again: the same lamp commands and the same frames.
case_replay() {
    interface_up
    bus_log 4 >"$scratch/bus.log"
    live replay --duration 3
    canplayer -I "$scratch/bus.log" &
    started+=("$!")
    cangen "$if" -I 100 -L 8 -g 2 -c 4 -n 6000 &
    started+=("$!")
    cangen "$if" -e -I 200 -f -L 12 -g 30 -n 200 &
    started+=("$!")
    finish replay 0
    say "$(json replay frames_used) frames used, $(json replay frames_late) late"
    local recording=$scratch/replay/can-in-live-bend-light.log
    hold "all is recorded" test "$(wc -l <"$recording")" = "$(json replay frames_used)"
    hold "many frames" more "$(json replay frames_used)" 1000
    "$program" live "$drive" --can-log "$recording" --can-start "$(json replay start_s | tr -d '"')" --duration 3 --no-wait --out "$scratch/again" >"$scratch/again.out" 2>&1 ||
        { cat "$scratch/again.out"; exit 1; }
    for file in signals-live-bend-light.csv can-in-live-bend-light.log; do
        hold "$file is the same" cmp "$scratch/replay/$file" "$scratch/again/$file"
    done
    awk '{ print $1, $3 }' "$scratch/replay/can-live-bend-light.log" >"$scratch/a"
    awk '{ print $1, $3 }' "$scratch/again/can-live-bend-light.log" >"$scratch/b"
    hold "sent frames are the same" cmp "$scratch/a" "$scratch/b"
    keep replay
}

case_fd() {
    interface_up
    live fd --duration 600
    cangen "$if" -e -I 200 -f -b -L 12 -g 5 -n 300
    stop fd
    hold "all CAN FD frames" test "$(json fd received)" = 300
    hold "their bit-rate switch is recorded" test "$(grep -c '00000200##1' "$scratch/fd/can-in-live-bend-light.log")" = 300
}

case_filter() {
    interface_up
    live filter --duration 600
    cangen "$if" -I 123 -L 8 -g 1 -n 500
    cangen "$if" -I 100 -L 8 -g 1 -n 200
    cangen "$if" -R -I 100 -g 1 -n 50
    stop filter
    hold "the kernel lets through what the mapping reads, and no remote frames" test "$(json filter received)" = 200
    hold "three identifiers" test "$(json filter kernel_filters)" = 3
}

# The interface goes down, comes back, is deleted, comes back.
case_outage() {
    interface_up
    live outage --duration 600
    cangen "$if" -I 100 -L 8 -g 5 -n 100
    ip link set "$if" down
    sleep 0.5
    ip link set "$if" up
    sleep 0.3
    cangen "$if" -I 100 -L 8 -g 5 -n 100
    ip link delete "$if"
    sleep 0.5
    interface_up
    sleep 0.3
    candump -L -n 20 "$if" >"$scratch/after.log" &
    started+=("$!")
    cangen "$if" -I 100 -L 8 -g 5 -n 100
    stop outage
    figure "outage: $(grep '^outages' "$scratch/outage.out")"
    hold "all frames between" test "$(json outage received)" = 300
    hold "down, seen and over" over outage down
    hold "removed, seen and over" over outage removed
    hold "sends afterwards" grep -q ' 201#' "$scratch/after.log"
    hold "unsent frames are counted" test "$(($(json outage sent) + $(json outage not_sent) + $(json outage superseded)))" = "$(json outage outputs_due)"
}

# A virtual interface has no bus to be off; its error frames can be said by anyone.
case_errors() {
    interface_up
    live errors --duration 600
    sleep 0.2
    cansend "$if" 20000004#000C000000000000
    cansend "$if" 20000040#0000000000000000
    sleep 0.5
    cansend "$if" 20000100#0000000000000000
    stop errors
    hold "three error frames" test "$(json errors error_frames)" = 3
    hold "one bus-off" test "$(json errors bus_off)" = 1
    hold "one of the controller" test "$(json errors controller_problems)" = 1
    hold "bus-off, seen and over" over errors bus_off
    hold "none is taken for a frame" test "$(json errors received)" = 0
}

case_interruption() {
    interface_up
    live interruption --duration 60
    sleep 2
    stop interruption
    hold "report" grep -q 'interrupted by the user' "$scratch/interruption/report.json"
    hold "some ticks" more "$(json interruption ticks)" 50
    hold "and not all" more 3000 "$(json interruption ticks)"
}

# More than the socket may hold: what is lost is known to the frame.
case_overload() {
    interface_up
    live overload --duration 600 --receive-buffer 4096
    cangen "$if" -I 100 -L 8 -g 0 -n 20000
    stop overload
    figure "overload: 20000 sent by cangen = $(json overload received) received + $(json overload dropped) dropped"
    hold "some were dropped" more "$(json overload dropped)" 0
    hold "sent = received + dropped" test "$(($(json overload received) + $(json overload dropped)))" = 20000
}

# at_rate NAME SECONDS BURST MS: live beside cangen, which sends BURST frames every MS ms; sets sent and per_s.
at_rate() {
    local name=$1 seconds=$2 burst=$3 gap=$4 before generator
    before=$(transmitted)
    live "$name" --duration 600
    cangen "$if" -I 100 -L 8 -g "$gap" -c "$burst" &
    generator=$!
    started+=("$generator")
    local began=$EPOCHREALTIME
    sleep "$seconds"
    kill "$generator"
    wait "$generator" 2>/dev/null
    local took
    took=$(awk -v a="$began" -v b="$EPOCHREALTIME" 'BEGIN { print b - a }')
    stop "$name"
    sent=$(($(transmitted) - before - $(json "$name" sent)))
    per_s=$(awk -v n="$sent" -v t="$took" 'BEGIN { printf "%d", n / t }')
    figure "$name: $per_s frames/s for $seconds s: $sent sent by cangen = $(json "$name" received) received + $(json "$name" dropped) dropped; $(lateness "$name")"
    hold "every frame is received or counted as dropped" test "$(($(json "$name" received) + $(json "$name" dropped)))" = "$sent"
}

# The highest of a few rates at which nothing is lost within 3 s; then that for a minute.
case_endurance() {
    interface_up
    local burst best=() rates=() seconds=${FERNLICHT_TEST_CAN_SECONDS:-60}
    for burst in 20 60 200; do
        at_rate "rate-$burst" 3 "$burst" 2
        (($(json "rate-$burst" dropped) == 0)) || break
        # A generator that cannot follow says nothing of us; more of it only takes from us.
        ((${#rates[@]} == 0 || per_s * 100 > rates[-1] * 120)) || break
        best+=("$burst") rates+=("$per_s")
    done
    hold "nothing lost at the lowest rate" test "${#best[@]}" -gt 0
    while ((${#best[@]})); do
        burst=${best[-1]}
        unset 'best[-1]'
        at_rate "endurance-$burst" "$seconds" "$burst" 2
        (($(json "endurance-$burst" dropped) == 0)) && break
    done
    hold "no frame lost" test "$(json "endurance-$burst" dropped)" = 0
    hold "all used" test "$(json "endurance-$burst" frames_used)" = "$(json "endurance-$burst" received)"
    hold "at least 2000 frames/s" test "$per_s" -ge 2000
    rm -f "$scratch/endurance-$burst"/can*.log
    keep "endurance-$burst"
}

cases=("$@")
((${#cases[@]})) || mapfile -t cases < <(declare -F | awk '$3 ~ /^case_/ { sub("case_", "", $3); print $3 }')
clean_up() {
    ((${#started[@]})) && kill "${started[@]}" 2>/dev/null
    interface_away
}
failed=0
for name in "${cases[@]}"; do
    began=$SECONDS result=passed
    echo "case $name"
    (
        trap clean_up EXIT
        "case_$name"
    ) || result=FAILED
    [[ $result == passed ]] || ((++failed))
    echo "$result $name $((SECONDS - began))" | tee -a "$results/results.txt"
done
rm -rf "$scratch"
((failed == 0))
