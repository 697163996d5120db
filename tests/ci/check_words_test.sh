#!/usr/bin/env bash
# ci/check-words on files of one sentence: what is spelt right passes, what is not is named with file, line and the better word.
set -uo pipefail
command -v codespell >/dev/null || { echo "skipped: needs codespell"; exit 0; }
check=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/ci/check-words
folder=$(mktemp --directory)
trap 'rm -rf "$folder"' EXIT
failures=0

# judged FILE TEXT [WORDS]: passes, or is refused with these words. _ keeps a misspelt word from being found here.
judged() {
    local said code=0
    printf '%s\n' "${2//_/}" >"$folder/$1"
    said=$("$check" "$folder/$1" 2>&1) || code=$?
    if [[ -z ${3-} ]] && ((code != 0)); then echo "$1 was refused: $said"; ((++failures)); fi
    if [[ -n ${3-} ]] && { ((code != 1)) || [[ $said != *"$folder/$1:1: ${3//_/}"* ]]; }; then echo "'$2' in $1: $said"; ((++failures)); fi
}
judged page.md 'The beam of a headlamp reaches 60 m; vor and lod are names, and the colour is grey.'
judged page.md 'The beem reci_eves light.' 'reci_eves ==> receives'
judged source.cpp '// The len_ght of a lane.' 'len_ght ==> length'
judged page.md 'The center of the beam.' 'center ==> centre'
judged page.md 'Cutoff of the low beam.' 'Cutoff ==> Cut-off'
judged source.cpp '<<<<_<<< HEAD' 'left by a merge'
judged page.css 'text { color: grey; }'
((failures == 0))
