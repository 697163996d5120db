#!/usr/bin/env bash
# ci/demo with stand-ins for set-up, CMake and the program: where results go, what it ends with, which exit code it hands on.
set -uo pipefail
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tree=$(mktemp --directory)
trap 'rm -rf "$tree"' EXIT
failures=0

mkdir -p "$tree"/{ci,bin,build/release}
cp "$source_tree/ci/demo" "$tree/ci/"
printf '#!/bin/sh\n' | tee "$tree/ci/setup" >"$tree/bin/cmake"
# Stands for `fernlicht run DRIVE --out DIR`: like the program it refuses a folder that is there.
cat >"$tree/build/release/fernlicht" <<'END'
#!/bin/sh
[ "$1 $3" = "run --out" ] && [ ! -e "$4" ] || exit 2
[ "$CODE" -lt 2 ] || exit "$CODE"
mkdir -p "$4" && echo "$2" >"$4/report.html"
exit "$CODE"
END
chmod +x "$tree/ci/setup" "$tree/bin/cmake" "$tree/build/release/fernlicht"

# expect EXIT-CODE LAST-LINE: runs the demo from another folder; the program's exit code is in CODE.
expect() {
    local got=0 last
    last=$(cd / && PATH=$tree/bin:$PATH "$tree/ci/demo" 2>&1 </dev/null | tail -n 1) || got=$?
    if ((got != $1)); then
        echo "exit code $got, expected $1"
        ((++failures))
    fi
    if [[ $last != *"$2"* ]]; then
        echo "ended with '$last', expected '$2'"
        ((++failures))
    fi
}

export CODE=0
expect 0 "$tree/out/demo-1/report.html"
first=$(<"$tree/out/demo-1/report.html")
expect 0 "$tree/out/demo-2/report.html"
CODE=1 expect 1 "$tree/out/demo-3/report.html"
CODE=3 expect 3 "no report in $tree/out/demo-4"
if [[ $first != scenarios/library/drives/first-light.yaml || $(<"$tree/out/demo-1/report.html") != "$first" ]]; then
    echo "the first run's report was touched, or is of another drive: $first"
    ((++failures))
fi

((failures == 0))
