#!/usr/bin/env bash
# tests/benchmarks/scaling: what it fits to times of a known exponent, that the program ($1) plays all that it generates, and that a play that
# fails is no figure.
set -uo pipefail
script=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/tests/benchmarks/scaling
out=$(mktemp --directory)
trap 'rm -rf "$out"' EXIT
failures=0
wrong() { echo "$1"; ((++failures)); }

PYTHONDONTWRITEBYTECODE=1 python3 - "$script" <<'END' || wrong "does not fit what was put in"
import importlib.machinery, importlib.util, sys
loader = importlib.machinery.SourceFileLoader("scaling", sys.argv[1])
scaling = importlib.util.module_from_spec(importlib.util.spec_from_loader("scaling", loader))
sys.modules["scaling"] = scaling
loader.exec_module(scaling)
cars = scaling.Axis("cars", "", [], [], None)
counts = [0, 1, 10, 100]
# 2 s, and 0.3 n^1.5 s more; the first size of the second round is lost in noise, the third round is twice as slow.
rounds = [[2 + 0.3 * n ** 1.5 for n in counts], [2, 2.01, 2 + 0.3 * 10 ** 1.5, 2 + 0.3 * 100 ** 1.5], [4 + 0.6 * n ** 1.5 for n in counts]]
found = scaling.row(cars, counts, rounds)
assert found == ["cars", "0 to 100", "2.00", "302.00", "1.50 (1.50 to 1.50)", "1.50", "3e+03 ms"], found
assert scaling.row(cars, counts, [[1, 1.01, 0.99, 1.02]])[4:6] == ["-", "-"]
cores = scaling.Axis("cores", "", [], [], None, wall=True)
assert scaling.row(cores, [1, 2, 4], [[8, 4, 2]])[4:6] == ["-1.00 (-1.00 to -1.00)", "-1.00"]
END

GALLIVM_PERF=nopt "$script" --quick "$1" >"$out/table" 2>"$out/said" || { wrong "did not play:"; cat "$out/said"; }
for axis in pixels lamps street-lamps cars triangles road frames cells cores; do
    grep -q "^| $axis | .* to .* | [0-9.]* | [0-9.]* |" "$out/table" || wrong "no row of $axis"
done

printf '#!/bin/sh\nexit 2\n' >"$out/refuses" && chmod +x "$out/refuses"
if "$script" --quick --only frames "$out/refuses" >"$out/table" 2>"$out/said"; then wrong "took a refusal for a figure"; fi
grep -q "exit code 2" "$out/said" || wrong "did not say what failed"
if "$script" --only furlongs "$1" >/dev/null 2>&1; then wrong "knows an axis that is none"; fi
exit $((failures > 0))
