#!/usr/bin/env bash
# ci/nightly with stand-ins for set-up, CMake and the program: what it plays, against which baselines, which exit code it hands on.
set -uo pipefail
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tree=$(mktemp --directory)
trap 'rm -rf "$tree"' EXIT
failures=0

mkdir -p "$tree"/{ci,bin,build/release}
cp "$source_tree/ci/nightly" "$tree/ci/"
printf '#!/bin/sh\n' | tee "$tree/ci/setup" >"$tree/bin/cmake"
# Stands for `fernlicht study FILE --baselines FOLDER --quiet --out DIR --across-devices --backend NAME --known LIST [FLAG...]`.
cat >"$tree/build/release/fernlicht" <<'END'
#!/bin/sh
[ "$1 $3 $5 $6 $8 $9" = "study --baselines --quiet --out --across-devices --backend" ] && [ ! -e "$7" ] || exit 2
study=$2 baselines=$4 out=$7
shift 9
[ "$2" = --known ] || exit 2
[ "$CODE" -lt 2 ] || exit "$CODE"
backend=$1
shift 3
mkdir -p "$out" && echo "$study $baselines $backend $*" | tee "$out/report.html" >"$out/junit.xml"
exit "$CODE"
END
chmod +x "$tree/ci/setup" "$tree/bin/cmake" "$tree/build/release/fernlicht"

# expect EXIT-CODE TEXT [ARGUMENT...]: runs it from another folder; the program's exit code is in CODE.
expect() {
    local got=0 said
    said=$(cd / && PATH=$tree/bin:$PATH "$tree/ci/nightly" "${@:3}" 2>&1 </dev/null) || got=$?
    if ((got != $1)); then
        echo "exit code $got, expected $1"
        ((++failures))
    fi
    if [[ $said != *"$2"* ]]; then
        echo "said '$said', expected '$2'"
        ((++failures))
    fi
}

export CODE=0
expect 0 "nightly: JUnit  out/nightly-1/junit.xml"
[[ $(<"$tree/out/nightly-1/report.html") == "scenarios/library/studies/standard.yaml baselines software " ]] || { echo "played something else"; ((++failures)); }
FERNLICHT_BACKEND=egl FERNLICHT_BASELINES=/elsewhere expect 0 "out/mine/report.html" other.yaml out/mine --only "straight*"
[[ $(<"$tree/out/mine/report.html") == "other.yaml /elsewhere egl --only straight*" ]] || { echo "took other files"; ((++failures)); }
CODE=1 expect 1 "accept"
CODE=3 expect 3 "left no report"

# ci/accept-nightly: both parts into a copy that takes the place of the old; nothing where the study is not green.
cp "$source_tree/ci/accept-nightly" "$tree/ci/"
cat >"$tree/build/release/fernlicht" <<'END'
#!/bin/sh
echo "$*" | sed 's/\.accept-nightly\.[^/]*/WORK/g' >>calls
if [ "$1" = study ]; then exit "$CODE"; fi
mkdir -p "$4" && echo "$7" >>"$4/index.json"
END
accept() { (cd / && PATH=$tree/bin:$PATH "$tree/ci/accept-nightly" "$@" >"$tree/said" 2>&1 </dev/null); }
mkdir "$tree/baselines" && echo old >"$tree/baselines/index.json"
if accept; then echo "accepted without a reason"; ((++failures)); fi
if CODE=1 accept why; then echo "accepted what is not green"; ((++failures)); fi
[[ $(<"$tree/baselines/index.json") == old ]] || { echo "touched what was accepted"; ((++failures)); }
rm "$tree/calls"
CODE=0 accept "a reason" || { echo "did not accept"; cat "$tree/said"; ((++failures)); }
[[ $(<"$tree/baselines/index.json") == $'old\na reason\na reason' ]] || { echo "lost what was there, or a part"; ((++failures)); }
diff - "$tree/calls" <<'END' || ((++failures))
study scenarios/library/studies/standard.yaml --backend software --no-accuracy --quiet --store WORK/store --out WORK/whole
study scenarios/library/studies/standard.yaml --backend software --no-accuracy --quiet --store WORK/store --out WORK/two --only straight* --frames 0:4
accept WORK/whole --baselines WORK/baselines --readings-only --note a reason --replace-class
accept WORK/two --baselines WORK/baselines --readings-only --note a reason
END
[[ -z $(compgen -G "$tree/.accept-nightly.*") ]] || { echo "left its scratch folder"; ((++failures)); }
printf '#!/bin/sh\necho "$*" >>calls\n' >"$tree/ci/fresh"
chmod +x "$tree/ci/fresh"
rm "$tree/calls"
accept --both "a reason" || { echo "did not accept for both"; cat "$tree/said"; ((++failures)); }
diff - "$tree/calls" <<'END' || ((++failures))
--suite bookworm ci/accept-nightly a reason
--suite trixie ci/accept-nightly a reason
END
((failures == 0))
