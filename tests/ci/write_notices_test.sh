#!/usr/bin/env bash
# ci/write-notices on a tree of two packages: writes their list, and refuses what is not listed, not used, out of date, or licensed otherwise by
# what Debian says of it (bash and coreutils are installed wherever this runs).
set -uo pipefail
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tree=$(mktemp --directory)
trap 'rm -rf "$tree"' EXIT
failures=0

lawful() {
    rm -rf "${tree:?}"/*
    mkdir "$tree/ci" "$tree/docs"
    cp "$source_tree/ci/write-notices" "$tree/ci"
    printf '# a word\nbash  build  the shell\ncoreutils run? small | tools\nothers test no notice\n' >"$tree/ci/packages"
    printf '# a word\nbash | linked | GPL-3.0-or-later | GPL-9|GPL-3\ncoreutils | tool\n' >"$tree/ci/licences"
    printf 'before\n<!-- list: begin -->\nold\n<!-- list: end -->\nafter\n' >"$tree/docs/third-party.md"
}
# refused WORDS [OPTION]
refused() {
    local said
    said=$("$tree/ci/write-notices" ${2+"$2"} 2>&1) && { echo "not refused: $1"; ((++failures)); }
    [[ $said == *"$1"* ]] || { echo "wrong words for '$1': $said"; ((++failures)); }
}

lawful
refused 'is not up to date' --check
if ! "$tree/ci/write-notices" || ! "$tree/ci/write-notices" --check; then ((++failures)); fi
diff "$tree/docs/third-party.md" - <<'END' || ((++failures))
before
<!-- list: begin -->
- bash (linked; GPL-3.0-or-later): the shell
<!-- list: end -->
after
END
lawful; echo 'dash build another shell' >>"$tree/ci/packages"; refused 'in one of ci/licences and ci/packages alone:  dash'
lawful; echo 'dash | tool' >>"$tree/ci/licences"; refused 'alone: dash'
lawful; sed -i 's/GPL-9|GPL-3/Eclipse/' "$tree/ci/licences"; refused "has nothing of 'Eclipse'; is GPL-3.0-or-later still right?"
lawful; sed -i 's/linked/glued/' "$tree/ci/licences"; refused "found 'glued'"
lawful; sed -i 's/ | GPL-3.0.*//' "$tree/ci/licences"; refused 'bash has no licence'
((failures == 0))
