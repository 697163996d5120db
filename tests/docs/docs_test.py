#!/usr/bin/python3
"""Runs the commands of pages as a reader would who has just built fernlicht, and reads their whole YAML files and Python scripts.

Blocks of a page marked ```sh run in order in a folder that looks like a clone, with the program on PATH. Words behind the mark:
  slow      minutes: left out by --quick
  exit=1    commands may exit by 1, too: a limit is exceeded, or something not measured
  needs=X   skipped where there is no program X
```python run blocks run after those above them, where the modules that they import are installed. ```yaml blocks that begin with fernlicht or
fernlicht_...: are files, checked by the schema of their kind. What has another mark, or none, is not run. Each command is a line of LOG: page:line, exit code, seconds, command."""
import argparse, concurrent.futures, importlib.util, json, os, pathlib, re, selectors, shutil, signal, subprocess, sys, tempfile, time

KINDS = {"fernlicht": "drive", "fernlicht_study": "study", "fernlicht_rating": "rating", "fernlicht_recipe": "recipe", "fernlicht_pixel_lamp": "pixel-lamp"}


def blocks(text):
    """(line of the first line within, mark, words behind it, lines) of each fenced block; of one in a list without its indentation."""
    lines, at = text.split("\n"), 0
    while at < len(lines):
        fence = re.fullmatch(r"( *)```(\w*) *(.*)", lines[at])
        at += 1
        if not fence:
            continue
        first, inside, indent = at + 1, [], len(fence[1])
        while at < len(lines) and lines[at].strip() != "```":
            inside.append(lines[at][min(indent, len(lines[at]) - len(lines[at].lstrip())):])
            at += 1
        at += 1
        yield first, fence[2], fence[3].split(), inside


def commands(first, lines):
    """(line, text) of each command: lines are added until bash takes them for a whole."""
    held, began = [], first
    for line, text in enumerate(lines, first):
        if not held and (not text.strip() or text.lstrip().startswith("#")):
            continue
        began = began if held else line
        held.append(text)
        whole = subprocess.run(["bash", "-n"], input="\n".join(held) + "\n", text=True, capture_output=True)
        if text.endswith("\\") or whole.returncode or "here-document" in whole.stderr:
            continue
        yield began, "\n".join(held)
        held = []
    if held:
        yield began, "\n".join(held)


def clone(root, build, folder):
    """A folder that looks like a clone after a build, without out/; what is written elsewhere would be seen in the tree itself."""
    for one in root.iterdir():
        if one.name not in ("build", "out", ".git"):
            (folder / one.name).symlink_to(one)
    (folder / "build").mkdir()
    (folder / "build/release").symlink_to(build)
    (folder / "home").mkdir()


def run_block(folder, environment, cases, limit_s, log_of):
    """Runs the commands of a block in one shell; yields line, command, exit code or what happened instead, seconds."""
    read, write = os.pipe()
    script = "".join(f"echo begin {i} >&{write}\n{text}\necho end {i} $? >&{write}\n" for i, (_, text) in enumerate(cases))
    with open(log_of, "wb") as output:
        shell = subprocess.Popen(["bash", "-c", script], cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=output,
                                 stderr=subprocess.STDOUT, pass_fds=[write], start_new_session=True)
        os.close(write)
        selector, said, done, began, at = selectors.DefaultSelector(), b"", {}, time.monotonic(), 0
        selector.register(read, selectors.EVENT_READ)
        while len(done) < len(cases):
            if not selector.select(max(0.0, began + limit_s - time.monotonic())):
                done[at] = (f"over {limit_s} s", time.monotonic() - began)
                break
            piece = os.read(read, 4096)
            if not piece:
                done.setdefault(at, ("the shell ended", time.monotonic() - began))
                break
            said += piece
            while b"\n" in said:
                event, said = said.split(b"\n", 1)
                what, *numbers = event.decode().split()
                at = int(numbers[0])
                if what == "begin":
                    began = time.monotonic()
                else:
                    done[at] = (int(numbers[1]), time.monotonic() - began)
                    began, at = time.monotonic(), at + 1
        try:
            os.killpg(shell.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        shell.wait()
        os.close(read)
    for i, (line, text) in enumerate(cases):
        result, seconds = done.get(i, ("not reached", 0.0))
        yield line, text, result, seconds


def checked_yaml(root, lines):
    """"" or what is wrong with a whole file; None where there is nothing to check it by."""
    key = lines[0].split(":")[0] if lines else ""
    if key not in KINDS:
        return None
    if not importlib.util.find_spec("yaml") or not importlib.util.find_spec("jsonschema"):
        return None
    import jsonschema, yaml
    schema = json.loads((root / f"scenarios/{KINDS[key]}.schema.json").read_text())
    try:
        wrong = list(jsonschema.Draft7Validator(schema).iter_errors(yaml.safe_load("\n".join(lines))))
    except yaml.YAMLError as error:
        return str(error).replace("\n", " ")
    return "; ".join(f"{'.'.join(map(str, one.absolute_path))}: {one.message}"[:300] for one in wrong)


def missing_module(lines):
    names = [name for line in lines for name in re.findall(r"^\s*(?:import|from) +(\w+(?: as \w+)?(?:, *\w+(?: as \w+)?)*)", line)]
    return next((name for list_of in names for name in re.findall(r"(?:^|, *)(\w+)", list_of) if not importlib.util.find_spec(name)), None)


def test_page(root, build, page, quick, limit_s, logs):
    """(verdict, line of the log) for each command of the page."""
    told, name = [], str(page.relative_to(root))

    def tell(verdict, line, what, result="-", seconds=0.0):
        told.append((verdict, f"{verdict:<8} {name}:{line}  {result}  {seconds:.1f} s  {what}"))

    found = [block for block in blocks(page.read_text()) if block[1] in ("sh", "yaml") or (block[1] == "python" and "run" in block[2])]
    if not found:
        return told
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        clone(root, build, folder)
        environment = {**os.environ, "PATH": f"{build}:{os.environ['PATH']}", "HOME": f"{folder}/home", "XDG_CACHE_HOME": f"{folder}/home/.cache",
                       "XDG_DATA_HOME": f"{folder}/home/.local/share", "TMPDIR": f"{folder}/home", "GALLIVM_PERF": os.environ.get("GALLIVM_PERF", "nopt")}
        for line, mark, words, lines in found:
            if mark == "yaml":
                wrong = checked_yaml(root, lines)
                if wrong is not None:
                    tell("FAILED" if wrong else "passed", line, wrong or lines[0])
                continue
            unknown = [word for word in words if word != "run" and not re.fullmatch(r"slow|exit=\d+|needs=\S+", word)]
            needed = [word[6:] for word in words if word.startswith("needs=") and not shutil.which(word[6:])]
            module = missing_module(lines) if mark == "python" else None
            if unknown:
                tell("FAILED", line - 1, f"unknown word '{unknown[0]}' behind the mark")
                continue
            if needed or module or ("slow" in words and quick):
                tell("skipped", line, f"no {needed[0]}" if needed else f"no module {module} of Python" if module else "slow")
                continue
            if mark == "python":
                (folder / "block.py").write_text("\n".join(lines))
                cases = [(line, f"{sys.executable} block.py")]
            else:
                cases = list(commands(line, lines))
            may_exit = [0] + [int(word[5:]) for word in words if word.startswith("exit=")]
            output = logs / f"{name.replace('/', '-')}-{line}.txt"
            for at, text, result, seconds in run_block(folder, environment, cases, 900 if "slow" in words else limit_s, output):
                tell("passed" if result in may_exit else "FAILED", at, text.split("\n")[0], f"exit {result}" if isinstance(result, int) else result, seconds)
            if any(verdict == "FAILED" for verdict, _ in told[-len(cases):]):
                told.append(("", "         " + "\n         ".join(output.read_text(errors="replace").splitlines()[-12:])))
    return told


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("root", type=pathlib.Path)
    arguments.add_argument("build", type=pathlib.Path)
    arguments.add_argument("log", type=pathlib.Path)
    arguments.add_argument("--quick", action="store_true", help="without blocks marked slow")
    arguments.add_argument("--limit", type=float, default=60, help="seconds for a command of a block that is not slow")
    arguments.add_argument("pages", nargs="*", type=pathlib.Path)
    given = arguments.parse_intermixed_args()
    root, build = given.root.resolve(), given.build.resolve()
    pages = [page.resolve() for page in given.pages] or sorted(root.glob("*.md")) + sorted((root / "docs").rglob("*.md"))
    logs = given.log.resolve().parent / "output"
    shutil.rmtree(logs, ignore_errors=True)
    logs.mkdir(parents=True)
    began, counts = time.monotonic(), {"passed": 0, "FAILED": 0, "skipped": 0}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool, open(given.log, "w") as log:
        # Pages with most to run first.
        order = sorted(pages, key=lambda page: -sum(len(lines) for _, mark, _, lines in blocks(page.read_text()) if mark == "sh"))
        for told in pool.map(lambda page: test_page(root, build, page, given.quick, given.limit, logs), order):
            for verdict, line in told:
                log.write(line + "\n")
                log.flush()
                counts[verdict] = counts.get(verdict, 0) + 1
                if verdict != "passed":
                    print(line, flush=True)
    print(f"{counts['passed']} passed, {counts['FAILED']} failed, {counts['skipped']} skipped in {time.monotonic() - began:.0f} s; {given.log}")
    return counts


if __name__ == "__main__":
    result = main()
    sys.exit(1 if result["FAILED"] or not result["passed"] else 0)
