#!/usr/bin/env bash
# The templates for other people's CI: what they say holds together, their shell passes shellcheck, mistakes planted in them are found; and
# study-job, with stand-ins for apt, git, CMake, curl and the program.
# shellcheck disable=SC2016 # scripts and patterns for others
set -uo pipefail
source_tree=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
tree=$(mktemp --directory)
trap 'rm -rf "$tree"' EXIT
failures=0

# snippets FOLDER OUT: the shell of each template as a file in OUT; fails where a template is not what its server takes.
snippets() {
    /usr/bin/python3 - "$1" "$2" <<'END'
import pathlib, re, sys, yaml
templates, out = map(pathlib.Path, sys.argv[1:])
def need(holds, what):
    if not holds: sys.exit(what)
def write(name, number, shell, text): (out / f"{name}-{number}.{shell}").write_text(f"#!/bin/{shell}\n{text}\n")
github = yaml.safe_load((templates / "github-actions.yml").read_text())
need({"name", "permissions", "jobs"} <= set(github) and github[True]["schedule"], "github: no schedule, or a part is missing") # YAML 1.1 reads on as true
for job in github["jobs"].values():
    need(job["defaults"]["run"]["shell"] == "bash", "github: not bash")
    for number, step in enumerate(job["steps"]):
        need(("uses" in step) != ("run" in step), f"github: step {number} neither uses nor runs anything")
        if "uses" in step: need(re.fullmatch(r"[\w-]+(/[\w-]+)+@v\d+", step["uses"]), f"github: {step['uses']}")
        else: write("github", number, "bash", step["run"])
    need([s for s in job["steps"] if "upload-artifact" in s.get("uses", "") and s["if"] == "always()" and s["with"]["path"] == "out"], "github: keeps no report")
gitlab = yaml.safe_load((templates / "gitlab-ci.yml").read_text())
for job in gitlab.values():
    for number, line in enumerate(job["script"]): write("gitlab", number, "bash", line)
    need(job["artifacts"]["when"] == job["cache"]["when"] == "always", "gitlab: keeps nothing of a red study")
    need(job["artifacts"]["reports"]["junit"] == "out/junit.xml" and "out" in job["artifacts"]["paths"], "gitlab: keeps no report")
jenkins = (templates / "Jenkinsfile").read_text()
code = re.sub(r"//[^\n]*|'[^'\n]*'|\"[^\"\n]*\"", "", jenkins)
need(all(code.count(a) == code.count(b) > 0 for a, b in ("{}", "()")), "jenkins: brackets")
need("junit testResults: 'out/junit.xml'" in jenkins and "archiveArtifacts artifacts: 'out/**'" in jenkins, "jenkins: keeps no report")
for number, line in enumerate(re.findall(r"\bsh '([^'\n]*)'|script: '([^'\n]*)'", jenkins)): write("jenkins", number, "sh", "".join(line))
END
}

# holds FOLDER: that its templates are right.
holds() {
    local out command commands
    out=$(mktemp --directory --tmpdir="$tree")
    snippets "$1" "$out" || return
    shellcheck "$out"/* "$1/study-job" || return
    mapfile -t commands < <(grep --no-filename --only-matching 'ci/study-job [a-z-]*' "$out"/* | sort --unique | cut --delimiter=' ' --fields=2)
    for command in "${commands[@]}"; do
        grep --quiet "^$command)" "$1/study-job" || { echo "study-job does not know '$command'"; return 1; }
    done
    (($(find "$out" -type f | wc --lines) > 7))
}

holds "$source_tree/ci/templates" || { echo "the templates do not hold"; ((++failures)); }
# planted FILE SED: the mistake must be found.
planted() {
    rm --recursive --force "$tree/planted"
    cp --recursive "$source_tree/ci/templates" "$tree/planted"
    sed --in-place "$2" "$tree/planted/$1"
    if cmp --quiet "$tree/planted/$1" "$source_tree/ci/templates/$1"; then
        echo "planted nothing in $1: $2"
        ((++failures))
    elif holds "$tree/planted" >"$tree/said" 2>&1; then
        echo "found nothing in $1: $2"
        ((++failures))
    fi
}
planted github-actions.yml 's/^jobs:/jobs: [/'
planted github-actions.yml 's/run: ci.study-job build/rn: ci\/study-job build/'
planted github-actions.yml 's/"$STUDY"/$STUDY/'
planted github-actions.yml 's/checkout@v7/checkout/'
planted github-actions.yml 's/study-job build/study-job bild/'
planted gitlab-ci.yml 's/"$STUDY"/"$STUDY/'
planted gitlab-ci.yml 's/out.junit.xml/junit.xml/'
planted gitlab-ci.yml 's/    when: always//'
planted Jenkinsfile '0,/}/s///'
planted Jenkinsfile 's/play "$STUDY"/play $STUDY/'
planted study-job 's/"${annotate\[@\]}"/$annotate/'

# study-job. The program writes what a study leaves, and ends with CODE.
mkdir --parents "$tree/bin" "$tree/job/ci"
cp "$source_tree/ci/templates/study-job" "$tree/job/ci/"
stand_in() {
    cat >"$tree/bin/$1"
    chmod +x "$tree/bin/$1"
}
stand_in apt-get <<<'#!/bin/sh
echo "apt-get $*" >>"$CALLS"
grep -q apt "$APT_CONFIG"'
stand_in git <<<'#!/bin/sh
echo "git $*" >>"$CALLS"
case "$1" in init) mkdir -p "$3/ci" && printf "#!/bin/sh\necho setup \$* >>\$CALLS\n" >"$3/ci/setup" && chmod +x "$3/ci/setup" ;; esac'
stand_in cmake <<<'#!/bin/sh
echo "cmake $*" >>"$CALLS"'
stand_in curl <<<'#!/bin/sh
echo "curl $*" >>"$CALLS"'
mkdir --parents "$tree/fernlicht"
cat >"$tree/fernlicht/fernlicht" <<'END'
#!/bin/sh
echo "fernlicht $* $XDG_CACHE_HOME" >>"$CALLS"
[ "$1" = study ] || exit 4 # whatever becomes of pruning, the exit code is the study's
[ "$CODE" -lt 2 ] || exit "$CODE"
mkdir -p out
if [ -n "${SLOW:-}" ]; then
    trap 'echo ended >>"$CALLS"; touch out/INCOMPLETE out/study.md; exit 1' TERM
    touch "$SLOW"
    sleep 30 &
    wait
fi
printf '# A study\n\n## Limits exceeded\n\nFAIL it: %s: it\n' "${RED:-baseline}" >out/study.md
exit "$CODE"
END
chmod +x "$tree/fernlicht/fernlicht"
export CALLS=$tree/calls CODE=0
unset GITHUB_ACTIONS GITHUB_STEP_SUMMARY CI_JOB_URL CI_API_V4_URL FERNLICHT_TOKEN FERNLICHT_CACHE FERNLICHT_BACKEND FERNLICHT_REVISION FERNLICHT_REPOSITORY

# job EXIT-CODE ARGUMENT...: runs study-job as a job does; `said` is what it said.
job() {
    local got=0
    : >"$CALLS"
    said=$(cd "$tree/job" && PATH=$tree/bin:$PATH ci/study-job "${@:2}" 2>&1 </dev/null) || got=$?
    ((got == $1)) || { echo "study-job ${*:2}: exit code $got, expected $1: $said"; ((++failures)); }
}
# called TEXT: in what was called.
called() { grep --quiet --fixed-strings -- "$1" "$CALLS" || { echo "expected '$1' among: $(<"$CALLS")"; ((++failures)); }; }

job 1 build # nobody says from where
export FERNLICHT_REPOSITORY=https://git.example.org/fernlicht.git
job 0 build
called "fetch --quiet --depth 1 https://git.example.org/fernlicht.git main"
called "setup build run"
called "cmake --build --preset release --target fernlicht"
mkdir --parents "$tree/job/.fernlicht/build/release"
cp "$tree/fernlicht/fernlicht" "$tree/job/.fernlicht/build/release/"
job 2 verdict
job 2 play
job 0 play my.yaml --strict
grep --quiet prune "$CALLS" && { echo "a store that is not there is pruned: $(<"$CALLS")"; ((++failures)); }
mkdir --parents "$tree/job/.fernlicht-cache/fernlicht/store"
job 0 play my.yaml --strict
called "fernlicht study my.yaml --strict --out out --backend software $tree/job/.fernlicht-cache"
called "fernlicht store prune --at-most 2GiB $tree/job/.fernlicht-cache"
job 0 verdict
[[ $said == "Limits exceeded" ]] || { echo "the verdict is '$said'"; ((++failures)); }
FERNLICHT_STORE_SIZE=5GiB CODE=1 job 1 play my.yaml
called "prune --at-most 5GiB"
[[ $said == *"accept an intended change"*"fernlicht accept out --readings-only"* ]] || { echo "a red study does not say how a change is accepted: $said"; ((++failures)); }
RED=history CODE=1 job 1 play my.yaml
[[ $said == *"study-job accept-night WHY"* && $said != *"fernlicht accept"* ]] || { echo "a night that the history finds red: $said"; ((++failures)); }
RED=straight_old CODE=1 job 1 play my.yaml # a limit
[[ $said != *accept* ]] || { echo "a limit that is exceeded is to be accepted: $said"; ((++failures)); }
job 2 accept-night
job 4 accept-night "new optics" # the stand-in's
called "fernlicht history accept last --note new optics --history $tree/job/.fernlicht-cache/nights.db"
job 0 play my.yaml
[[ $said == *"no baselines"* ]] || { echo "a green study without baselines does not say so: $said"; ((++failures)); }
(cd "$tree/job" && SLOW=$tree/begun CODE=0 exec ci/study-job play my.yaml) >"$tree/said" 2>&1 &
for ((i = 0; i < 100; ++i)); do [[ ! -e $tree/begun ]] || break; sleep 0.1; done
kill -TERM $!
code=0
wait $! || code=$?
((code == 1)) || { echo "a job that was told to end: exit code $code"; ((++failures)); }
called ended
grep --quiet accept "$tree/said" && { echo "an incomplete study is to be accepted: $(<"$tree/said")"; ((++failures)); }
mkdir "$tree/job/baselines"
job 0 play my.yaml
[[ $said != *"no baselines"* ]] || { echo "a study with baselines has none: $said"; ((++failures)); }
called "--backend software --baselines baselines $tree/job"
job 0 play my.yaml --baselines others
grep --quiet -- "--baselines baselines" "$CALLS" && { echo "judged by two: $(<"$CALLS")"; ((++failures)); }
rmdir "$tree/job/baselines"
mv "$tree/job/.fernlicht" "$tree/built" # an installed one will do
cp "$tree/fernlicht/fernlicht" "$tree/bin/"
job 0 play my.yaml
called "fernlicht study my.yaml --out out"
rm "$tree/bin/fernlicht"
mv "$tree/built" "$tree/job/.fernlicht"
CODE=2 job 2 play my.yaml # the program says why; nothing else does
if [[ -n $said ]] || grep --quiet prune "$CALLS"; then echo "a refused study: $said"; ((++failures)); fi
export GITHUB_ACTIONS=true GITHUB_STEP_SUMMARY=$tree/summary
CODE=1 job 1 play my.yaml
called "--annotate github"
diff "$tree/summary" "$tree/job/out/study.md" || ((++failures))
rm "$tree/summary"
CODE=3 job 3 play my.yaml # the report of the night before is still there
grep --quiet "exit code 3" "$tree/summary" || { echo "GitHub's page does not say that nothing was played"; ((++failures)); }
grep --quiet "A study" "$tree/summary" && { echo "GitHub's page shows the night before"; ((++failures)); }
job 2 verdict
unset GITHUB_ACTIONS GITHUB_STEP_SUMMARY
export CI_JOB_URL=https://git.example.org/us/lamps/-/jobs/7 CI_API_V4_URL=https://git.example.org/api/v4 CI_PROJECT_ID=3 CI_COMMIT_SHA=abc
job 0 play my.yaml
/usr/bin/python3 -c 'import json, sys; links = json.load(open(sys.argv[1]))["fernlicht"]; sys.exit(links[0]["external_link"]["url"] != "https://git.example.org/us/lamps/-/jobs/7/artifacts/file/out/report.html")' \
    "$tree/job/links.json" || { echo "GitLab gets no links"; ((++failures)); }
FERNLICHT_TOKEN=secret job 0 play my.yaml
called "https://git.example.org/api/v4/projects/3/repository/commits/abc/comments"
((failures == 0))
