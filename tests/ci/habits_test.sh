#!/usr/bin/env bash
# What people read who join: links lead somewhere, CONTRIBUTING.md names tests that there are, CITATION.cff and editors' settings say what the
# build says. Then mistakes planted in a copy are found.
set -uo pipefail
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tree=$(mktemp --directory)
whole=$(mktemp)
trap 'rm -rf "$tree" "$whole"' EXIT
failures=0

# holds TREE: the first thing that does not, on standard error.
holds() {
    /usr/bin/python3 - "$1" <<'END'
import configparser, json, pathlib, re, sys, yaml
root = pathlib.Path(sys.argv[1])
def need(holds, what):
    if not holds: sys.exit(what)
def text(name): return (root / name).read_text()

# As GitHub makes a heading's anchor: small letters, no signs but - and _, a number behind one that was there before.
def anchors(page):
    found = set()
    for heading in re.findall(r"^#{1,6} +(.+?) *$", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S), re.M):
        name = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()).replace(" ", "-")
        found.add(next(n for n in [name] + [f"{name}-{i}" for i in range(1, 99)] if n not in found))
    return found
folders = [root / name for name in ("docs", ".github", "ci", "scenarios", "metrics", "renderer", "runner", "tests")]
pages = sorted(root.glob("*.md")) + sorted(page for folder in folders for page in folder.rglob("*.md") if "fuzz/seeds" not in str(page))
links = 0
for page in pages:
    prose = re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S))
    for target in re.findall(r"\]\(([^)\s]+)[^)]*\)|^ *\[[^]]+\]: +(\S+)|\b(?:src|href)=\"([^\"]+)\"", prose, re.M):
        target = "".join(target)
        if re.match(r"[a-z]+:", target): continue
        links += 1
        path, _, anchor = target.partition("#")
        there = page.parent / path if path else page
        need(there.exists(), f"{page.relative_to(root)}: {target} leads nowhere")
        need(not anchor or anchor in anchors(there), f"{page.relative_to(root)}: {target}: the page has no such heading")
need(links > 0, "no page has a link")

# Pages that sources, scripts, schemas and help name by their paths.
kinds = {".c", ".cff", ".cmake", ".cpp", ".css", ".glsl", ".h", ".html", ".js", ".json", ".md", ".mustache", ".py", ".sh", ".toml", ".txt", ".yaml", ""}
named, out = 0, re.compile(r"/(build|out|\.git|\.cache|fuzz/(seeds|corpus)|baselines)/|tests/ci/\w+_test\.sh$")
for file in sorted(root.rglob("*")):
    if file.suffix not in kinds or not file.is_file() or out.search(f"/{file.relative_to(root)}"): continue
    for path, anchor, decision in re.findall(r"\bdocs/(?:([\w/-]+\.md)(?:#([\w-]+))?|decisions/(\d{4})\b)", file.read_text(errors="replace")):
        named += 1
        there = root / "docs" / path if path else next(iter((root / "docs/decisions").glob(f"{decision}-*.md")), root / "none")
        need(there.exists(), f"{file.relative_to(root)}: docs/{path or 'decisions/' + decision} is nowhere")
        need(not anchor or anchor in anchors(there), f"{file.relative_to(root)}: docs/{path}#{anchor}: the page has no such heading")
need(named > 0, "no source names a page")

tests = "\n".join(test.read_text() for test in (root / "tests").rglob("*_test.cpp"))
named = re.findall(r"`([A-Z]\w+)\.([A-Z]\w+|\*)`", text("CONTRIBUTING.md"))
need(named, "CONTRIBUTING.md: names no test")
for suite, test in named:
    name = r"\w+" if test == "*" else test
    need(re.search(rf"\bTEST(_F|_P)?\({suite}, {name}\b", tests), f"CONTRIBUTING.md: there is no test {suite}.{test}")

citation = yaml.safe_load(text("CITATION.cff"))
need({"cff-version", "message", "title", "authors", "license"} <= set(citation), "CITATION.cff: a part is missing")
need(all({"type", "title", "authors"} <= set(one) for one in citation["references"]), "CITATION.cff: a part of a reference is missing")
need(str(citation["version"]) == re.search(r"project\(fernlicht VERSION ([\d.]+)", text("CMakeLists.txt"))[1], "CITATION.cff: another version than CMakeLists.txt")
need(f"LICENSES/{citation['license']}.txt" in [str(f.relative_to(root)) for f in (root / "LICENSES").iterdir()], "CITATION.cff: a licence without its text")
need(text("LICENSE") == text("LICENSES/Apache-2.0.txt"), "LICENSE and LICENSES differ")

editor = configparser.ConfigParser()
editor.read_string("[top]\n" + text(".editorconfig"))
layout = yaml.safe_load(text(".clang-format"))
need(editor["*"]["indent_size"] == str(layout["IndentWidth"]), ".editorconfig: another indentation than .clang-format")
need(editor["*.{cpp,h}"]["max_line_length"] == str(layout["ColumnLimit"]), ".editorconfig: another length of lines than .clang-format")

for repository in yaml.safe_load(text(".pre-commit-config.yaml"))["repos"]:
    for hook in repository["hooks"]:
        script = hook["entry"].split()[0]
        need(not script.startswith("ci/") or (root / script).stat().st_mode & 0o100, f".pre-commit-config.yaml: {script} cannot be run")
presets = json.loads(text("CMakePresets.json"))
for workflow in presets["workflowPresets"]:
    for step in workflow["steps"]:
        need(step["name"] in [one["name"] for one in presets[step["type"] + "Presets"]], f"CMakePresets.json: {workflow['name']}: no {step['type']} preset {step['name']}")
for form in (root / ".github/ISSUE_TEMPLATE").glob("*.md"):
    need({"name", "about"} <= set(yaml.safe_load(form.read_text().split("---")[1])), f"{form.name}: has no name or does not say what it is about")
END
}

holds "$source_tree" || ((++failures))

tar --create --directory "$source_tree" --exclude=./build --exclude=./out --exclude=./.git --exclude=./baselines . | tar --extract --directory "$tree"

# planted FILE EXPRESSION WORDS: what sed makes of the file is found, in these words.
planted() {
    local said
    cp --preserve "$tree/$1" "$whole"
    sed -i "$2" "$tree/$1"
    if cmp --quiet "$tree/$1" "$whole"; then echo "nothing to plant $2 in $1"; ((++failures)); fi
    said=$(holds "$tree" 2>&1) && { echo "not noticed: $2 in $1"; ((++failures)); }
    if [[ $said != *"$3"* ]]; then echo "wrong words for $2 in $1: $said"; ((++failures)); fi
    cp --preserve "$whole" "$tree/$1"
}
planted CONTRIBUTING.md 's#(docs/glossary.md)#(docs/glossaries.md)#' 'docs/glossaries.md leads nowhere'
planted CONTRIBUTING.md 's/#adding-things/#adding/' 'no such heading'
planted README.md 's#src="docs/images/film-country#src="docs/images/film-coast#' 'film-coast.webp leads nowhere'
planted runner/findings/summary.h 's#docs/readings.md#docs/reading.md#' 'docs/reading.md is nowhere'
planted CONTRIBUTING.md 's/EvennessOfOneLampAlone/EvennessOfLamps/' 'there is no test Seeing.EvennessOfLamps'
planted CITATION.cff '/^title/d' 'a part is missing'
planted CITATION.cff 's/^version: .*/version: 0.0.9/' 'another version'
planted .editorconfig '0,/indent_size = 4/s//indent_size = 8/' 'another indentation'
planted .clang-format 's/ColumnLimit: .*/ColumnLimit: 120/' 'another length of lines'
planted .pre-commit-config.yaml 's#entry: ci/check-licences#entry: ci/tests/../test#' 'ci/tests/../test'
planted CMakePresets.json 's/{"type": "test", "name": "asan"}/{"type": "test", "name": "sanitize"}/' 'no test preset sanitize'
planted .github/ISSUE_TEMPLATE/feature-request.md '/^about/d' 'does not say what it is about'
((failures == 0))
