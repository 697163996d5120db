#!/usr/bin/env bash
# Man pages and completions say what --help says: held by man and mandoc, and asked in bash, zsh and fish, each where it is installed.
# The program is the argument.
set -uo pipefail
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
program=${1-}
[[ -f $program && -x $program ]] || program=$source_tree/build/release/fernlicht
program=$(realpath "$program")
folder=$(mktemp --directory)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit
failures=0
fail() { echo "$*"; ((++failures)); }

# below COMMAND...: the commands that --help lists.
below() { "$program" "$@" --help | awk '/^Subcommands:/ { list = 1; next } list && /^  [a-z]/ { print $1 }'; }
# flags COMMAND...: the long flags that --help lists.
flags() { "$program" "$@" --help | grep --only-matching --extended-regexp '^  (-[a-z],)?--[a-z0-9-]+' | sed 's/.*--/--/' | sort; }

mkdir man
"$program" man --out man || fail "no pages"
"$program" man run | cmp --quiet - man/fernlicht-run.1 || fail "man run: not the page that --out writes"
for command in $(below); do
    page=man/fernlicht-$command.1
    [[ -s $page ]] || { fail "no page for $command"; continue; }
    said=$(sed 's/\\-/-/g' "$page")
    for one in $(below "$command") ""; do
        for flag in $(flags "$command" ${one:+"$one"}); do
            [[ $said == *"fB$flag"'\fR'* ]] || fail "$page: no $flag"
        done
    done
    grep --quiet "fernlicht\\\\-$command (1)" man/fernlicht.1 || fail "fernlicht.1 does not list $command"
done
grep --quiet '^\\fB\\-\\-quiet\\fR$' man/fernlicht-run.1 || fail "fernlicht-run.1: --quiet takes no value"
for page in man/*.1; do
    if command -v man >/dev/null; then
        said=$(LC_ALL=C.UTF-8 MANROFFSEQ='' MANWIDTH=80 man --warnings -E UTF-8 -l -Tutf8 -Z "$page" 2>&1 >/dev/null)
        [[ -z $said ]] || fail "$page: $said"
    fi
    if command -v mandoc >/dev/null; then
        said=$(mandoc -T lint -W warning "$page" | grep --invert-match 'missing date')
        [[ -z $said ]] || fail "$page: $said"
    fi
done

# expect SHELL LINE WORDS: what the shell completes for the line, sorted, is just these words.
expect() {
    local got
    got=$("$1"_completes "$2" | sort | tr '\n' ' ')
    [[ ${got% } == "$3" ]] || fail "$1: '$2': found '${got% }', expected '$3'"
}
everywhere() {
    expect "$1" 'fernlicht sto' 'store storyboard'
    expect "$1" 'fernlicht run --aim ' 'as-is auto'
    expect "$1" 'fernlicht run --aim=a' "${2}as-is ${2}auto"
    expect "$1" 'fernlicht can ' 'convert cut decode merge record'
    expect "$1" 'fernlicht can record --forc' '--force'
    expect "$1" 'fernlicht run --log-level e' 'error'
    expect "$1" 'fernlicht completio' '' # hidden
}
touch ownfile

# shellcheck disable=SC1090 # what the program prints
source <("$program" completions bash)
[[ $(complete -p fernlicht) == *'-o default -F _fernlicht fernlicht' ]] || fail "bash: $(complete -p fernlicht)"
bash_completes() {
    local words=${1//=/ = } # as readline splits a line
    read -r -a COMP_WORDS <<<"$words"
    [[ $1 != *' ' ]] || COMP_WORDS+=('')
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    COMPREPLY=()
    _fernlicht
    printf '%s\n' "${COMPREPLY[@]}"
}
everywhere bash ''
expect bash 'fernlicht run --out ' ''
expect bash 'fernlicht run --' "$(flags run | tr '\n' ' ' | sed 's/ $//')"

if command -v fish >/dev/null; then
    "$program" completions fish >fernlicht.fish
    mkdir home
    fish_completes() { HOME=$folder/home fish --no-config --command "source fernlicht.fish; complete --do-complete '$1'" | cut --fields=1; }
    everywhere fish '--aim='
    expect fish 'fernlicht run own' 'ownfile'
fi

if command -v zsh >/dev/null; then
    mkdir zsh
    "$program" completions zsh >zsh/_fernlicht
    # A shell on a terminal of its own, with compadd telling what it is given: the words that match.
    cat >ask.zsh <<'END'
zmodload zsh/zpty
zpty shell zsh -f -i
ask() { zpty -w shell "$1"; }
ask 'PS1=; unsetopt zle_bracketed_paste 2>/dev/null; fpath=($PWD/zsh $fpath); autoload -U compinit; compinit -u -D'
ask 'compadd() { if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then builtin compadd "$@"; return; fi
    local -a __found; builtin compadd -A __found "$@"; (( $#__found )) && print -rl -- "found:"${^__found} >>$PWD/found; builtin compadd "$@" }'
ask 'finish() { zle complete-word; print done >>$PWD/found; exit }; zle -N finish; bindkey "^I" finish'
ask 'print ready >$PWD/ready'
while [[ ! -e ready ]]; do sleep 0.05; done
zpty -n -w shell "$1"$'\t'
repeat 200; do [[ -e found ]] && grep -q '^done' found && break; sleep 0.05; done
zpty -d shell
END
    zsh_completes() {
        rm -f found ready
        timeout 30 zsh -f ask.zsh "$1" >/dev/null 2>&1
        sed --quiet 's/^found://p' found
    }
    everywhere zsh ''
    expect zsh 'fernlicht run own' 'ownfile'
fi
((failures == 0))
