#!/usr/bin/env bash
# ci/setup with stand-ins for dpkg and apt that write down how they were called.
set -uo pipefail
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tree=$(mktemp --directory)
trap 'rm -rf "$tree"' EXIT
failures=0

mkdir "$tree/ci" "$tree/bin"
cp "$source_tree/ci/setup" "$tree/ci/"
printf '# comment\n\ncmake build configures\nlibegl1 run draws\nshellcheck test checks\n' >"$tree/ci/packages"

stand_in() {
    cat >"$tree/bin/$1"
    chmod +x "$tree/bin/$1"
}
# Which packages there are: one a line in the file `installed`, which an apt-get install grows.
stand_in dpkg-query <<'END'
#!/bin/sh
while read -r package; do echo "$package installed"; done <"$TREE/installed"
END
stand_in apt-get <<'END'
#!/bin/sh
echo "apt-get $*" >>"$TREE/calls"
case "$*" in
*install*) [ ! -e "$TREE/broken" ] && [ -e "$TREE/lists" ] ;;
*update*) touch "$TREE/lists" ;;
esac
END
stand_in apt-cache <<'END'
#!/bin/sh
[ "$2" != libosmesa6 ] || exit 1
[ -e "$TREE/known" ] || [ -e "$TREE/lists" ]
END
stand_in sudo <<'END'
#!/bin/sh
exec "$@"
END

# expect NAME EXIT-CODE APT-CALLS GROUP...: runs setup and counts how often apt-get was called.
expect() {
    local name=$1 code=$2 calls=$3 got=0
    shift 3
    : >"$tree/calls"
    said=$(cd / && TREE=$tree PATH=$tree/bin:$PATH "$tree/ci/setup" "$@" 2>&1 </dev/null) || got=$?
    if ((got != code)); then
        echo "$name: exit code $got, expected $code: $said"
        ((++failures))
    fi
    if (($(wc -l <"$tree/calls") != calls)); then
        echo "$name: expected $calls calls of apt-get, saw: $(<"$tree/calls")"
        ((++failures))
    fi
}
says() {
    if [[ $said != *"$1"* ]]; then
        echo "expected '$1' in: $said"
        ((++failures))
    fi
}

printf 'cmake\nlibegl1\nshellcheck\n' >"$tree/installed"
expect "all there" 0 0
says "all 3 packages are there"

printf 'cmake\nlibegl1\n' >"$tree/installed"
expect "only what the demo needs" 0 0 build run
says "all 2 packages are there"

expect "empty lists: update, install" 0 2
says "installing 1 of 3 packages: shellcheck"

expect "lists are there: install only" 0 1

rm "$tree/lists"
touch "$tree/known"
expect "old lists: install fails, update, install" 0 3

touch "$tree/broken"
expect "nothing helps: said and failed" 1 3
says "could not install"

rm "$tree/broken"
printf 'libosmesa6 run? draws\n' >>"$tree/ci/packages"
printf 'cmake\nlibegl1\nshellcheck\n' >"$tree/installed"
expect "what Debian has no more: not asked for again" 0 0
says "this Debian has no libosmesa6"
printf 'cmake\n' >"$tree/installed"
expect "nor in the way of the rest" 0 1
says "installing 2 of 4 packages: libegl1 shellcheck"

expect "unknown group" 1 0 tests
says "no group 'tests'"

((failures == 0))
