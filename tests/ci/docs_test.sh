#!/usr/bin/env bash
# What runs the commands of pages (tests/docs/docs_test.py) runs all that is marked and nothing else, and says what fails, where.
set -uo pipefail
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tree=$(mktemp --directory)
trap 'rm -rf "$tree"' EXIT
failures=0
mkdir -p "$tree"/{docs,bin,scenarios}
cp "$source_tree"/scenarios/study.schema.json "$tree/scenarios"
printf '#!/bin/sh\nexit 1\n' >"$tree/bin/fernlicht"
chmod +x "$tree/bin/fernlicht"
cat >"$tree/docs/page.md" <<'END'
```
not marked
```

```sh
# a comment
mkdir out && cd out
echo one \
    >two
for i in 1 2; do
    echo "$i" >>two
done
cat >three <<'HERE'
not a command
HERE
[ "$(cat two three | wc -l)" = 4 ]
```

```text
not to run
```

- In a list:

  ```sh exit=1
  build/release/fernlicht run
  fernlicht run
  ```

```sh slow
test -s out/two
```

```sh needs=no-such-program
no-such-program
```

```yaml
fernlicht_study: 1
lamps: {a: {low: a.ies}}
drives: [b.yaml]
```

```yaml
key: of something
```

```python
not to run
```

```python run
import os
assert os.path.exists("out/two")
```

```python run
import no_such_module
```
END

# run EXIT [OPTION...]: the program says so much, and ends so.
run() {
    local expected=$1 code=0
    shift
    /usr/bin/python3 "$source_tree/tests/docs/docs_test.py" "$tree" "$tree/bin" "$tree/log.txt" "$@" >"$tree/said" 2>&1 || code=$?
    ((code == expected)) || { echo "found exit code $code, expected $expected:"; cat "$tree/said"; ((++failures)); }
}
says() { grep --quiet --extended-regexp -e "$1" "$tree/log.txt" || { echo "not in the log: $1"; cat "$tree/log.txt"; ((++failures)); }; }
run 0
says '^passed   docs/page\.md:7  exit 0  [0-9.]+ s  mkdir out && cd out$'
says '^passed   docs/page\.md:8  '
says '^passed   docs/page\.md:10  .*for i in 1 2; do$'
says '^passed   docs/page\.md:16  '
says '^passed   docs/page\.md:26  exit 1'
says '^passed   docs/page\.md:31  '
says '^skipped  docs/page\.md:35  .*no no-such-program$'
if /usr/bin/python3 -c 'import jsonschema, yaml' 2>/dev/null; then says '^passed   docs/page\.md:39  '; fi
[[ ! -s $tree/out ]] || { echo "written into the tree"; ((++failures)); }
says '^passed   docs/page\.md:53  '
says '^skipped  docs/page\.md:58  .*no_such_module'
run 0 --quick
says '^skipped  docs/page\.md:31  .*slow$'

# planted EXPRESSION WORDS: what sed makes of the page fails in these words.
planted() {
    cp "$tree/docs/page.md" "$tree/whole"
    sed -i "$1" "$tree/docs/page.md"
    run 1 --limit 2
    says "$2"
    cp "$tree/whole" "$tree/docs/page.md"
}
planted 's/ cd out/ cd outside/' '^FAILED   docs/page\.md:7  exit 1 '
planted 's/ exit=1//' '^FAILED   docs/page\.md:26  exit 1  .*fernlicht run$'
planted 's/ cd out/ cd out; sleep 30/' '^FAILED   docs/page\.md:7  over 2\.0 s '
planted 's/ cd out/ exit 0/' '^FAILED   docs/page\.md:8  (not reached|the shell ended)'
planted 's/assert os/assert not os/' '^FAILED   docs/page\.md:53  exit 1 '
planted 's/sh slow/sh fast/' "^FAILED   docs/page\.md:30  .*unknown word 'fast'"
if /usr/bin/python3 -c 'import jsonschema, yaml' 2>/dev/null; then planted 's/low: a.ies/lower: a.ies/' '^FAILED   docs/page\.md:39  .*lower'; fi
((failures == 0))
