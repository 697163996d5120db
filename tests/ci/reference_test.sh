#!/usr/bin/env bash
# docs/reference is what `fernlicht docs` writes. The program is the argument.
set -uo pipefail
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${1-}
[[ -f $program && -x $program ]] || program=$source_tree/build/release/fernlicht
folder=$(mktemp --directory)
trap 'rm -rf "$folder"' EXIT
failures=0
fail() { echo "$*"; ((++failures)); }

"$program" docs "$folder/new" || fail "exit code $?"
mv "$folder/new/commands.md" "$folder" || fail "no commands.md"
diff --recursive --unified=0 "$source_tree/docs/reference" "$folder/new" || fail "docs/reference is not what the program says: ci/write-reference writes it"
grep --quiet '^## fernlicht run$' "$folder/commands.md" || fail "commands.md: no fernlicht run"
"$program" docs "$folder/commands.md" 2>/dev/null
(($? == 3)) || fail "a file in place of the folder is not refused"
((failures == 0))
