// Slurm's programs are scripts here: what sbatch is given "runs" at once, by copying entries into the store, and fails where a file says
// so.
#include "runner/experiments/study/slurm_playing.h"

#include "runner/play/progress.h"
#include "tests/runner/program.h"
#include "tests/trial.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

// calls: a line for each. refuse-N: the Nth array is refused, and is there all the same where it says "there". fails-CELL: "STATE N", a
// task with it plays none of its cells and ends so, in the first N arrays.
constexpr const char* sbatch = R"sh(#!/bin/bash
cd "$FAKE_SLURM"; echo sbatch >>calls
n=$(grep -c sbatch calls)
for word; do [[ $word == --job-name=* ]] && name=${word#*=}; done
if [[ -e refuse-$n ]]; then
    [[ $(<refuse-$n) == there ]] && echo "$n" >"id-$name"
    echo "sbatch: error: Socket timed out on send/recv operation" >&2
    [[ -e id-$name ]] || exit 1
fi
task=0
while read -r line; do
    cells=$(grep -o 'expect [^ ]*' <<<"$line" | cut -d' ' -f2)
    state=COMPLETED
    for cell in $cells; do
        if [[ -e fails-${cell%=*} ]]; then read -r ending last <"fails-${cell%=*}"; ((n > last)) || state=$ending; fi
    done
    for cell in $cells; do
        key=${cell#*=}
        [[ $state != COMPLETED ]] || { mkdir -p "store/cells/${key:0:2}"; cp "played/${key:0:2}/${key:2}.json" "store/cells/${key:0:2}/"; }
    done
    echo "JobId=$n JobState=$state Reason=None" >"job-${n}_$((task++))"
done <"${!#}"
[[ ! -e refuse-$n ]] || exit 1
echo "$n"
)sh";
// By name alone: its id, where it is known. silent: the controller does not answer, and someone presses Ctrl-C. requeued: the task of the
// first array is gone, is pending again for thirty looks, is gone, and its results show two looks later.
constexpr const char* squeue = R"sh(#!/bin/bash
cd "$FAKE_SLURM"
[[ ! -e silent ]] || { kill -INT "$PPID"; exit 1; }
if [[ -e requeued ]]; then
    echo >>requeued; looks=$(wc -l <requeued)
    ((looks == 1 || looks > 31)) || echo "1 0 PENDING BeginTime"
    ((looks < 34)) || { mkdir -p store/cells; cp -r played/. store/cells; }
fi
for word; do [[ $word != --name=* || ! -e id-${word#*=} ]] || cat "id-${word#*=}"; done
)sh";
constexpr const char* scontrol = R"sh(#!/bin/bash
cd "$FAKE_SLURM"
[[ $2 != config ]] || { echo "MaxArraySize            = 1001"; exit; }
cat "job-$3" 2>/dev/null
)sh";
constexpr const char* scancel = R"sh(#!/bin/bash
cd "$FAKE_SLURM"; echo "scancel $*" >>calls
[[ ! -e silent ]] || { echo "scancel: error: Unable to contact slurm controller" >&2; exit 1; }
)sh";

struct SlurmPlaying : testing::Test {
    const Interruption listening; // and nothing of an earlier test
    TemporaryFolder folder;
    CellStore store{folder / "store"};
    Study study;
    StudyPlan plan;
    StudyOptions options;
    SlurmPatience patience{0.01, 0.05, 3, 0.05, 4};
    std::string path = std::getenv("PATH");

    SlurmPlaying() {
        fs::create_directory(folder / "bin");
        for (const auto& [name, text] : {std::pair("sbatch", sbatch), {"squeue", squeue}, {"scontrol", scontrol}, {"scancel", scancel}}) {
            tests::written(name, text, folder / "bin");
            fs::permissions(folder / ("bin/" + std::string(name)), fs::perms::owner_all);
        }
        ::setenv("PATH", ((folder / "bin") + ":" + path).c_str(), 1);
        ::setenv("FAKE_SLURM", (folder / "").c_str(), 1);
        for (int i = 0; i < 4; ++i) {
            PlannedCell& one = plan.cells.emplace_back();
            one.cell.name = fmt::format("c{}", i);
            one.key = std::string(31, 'a') + static_cast<char>('0' + i);
            store.keep({one.key, "s", one.cell.name, "2027-01-15T10:00:00Z", {}, {}, 0, {}}, {{"number", one.cell.name}}, {});
        }
        fs::rename(folder / "store/cells", folder / "played");
        study.file = folder / "study.yaml";
        options.folder = folder / "out";
        options.store = folder / "store";
        options.per = 4;
        options.run.quiet = true;
        fs::create_directory(options.folder);
    }
    ~SlurmPlaying() override { ::setenv("PATH", path.c_str(), 1); }

    void is(const std::string& file, const std::string& text) const { tests::written(file, text, folder / ""); }
    auto play() { return play_on_slurm(store, study, plan, {0, 1, 2, 3}, options, patience); }
    std::vector<std::string> failed() {
        std::vector<std::string> why;
        for (const auto& [place, played] : play())
            why.push_back(played.failed);
        return why;
    }
    /// Cells to a task, array by array.
    std::vector<std::vector<std::size_t>> submitted() const {
        std::vector<std::vector<std::size_t>> sizes;
        const json record = json::parse(content_of(options.folder / "slurm.json"));
        for (const json& array : record.at("arrays"))
            for (sizes.emplace_back(); const json& task : array.at("cells"))
                sizes.back().push_back(task.size());
        return sizes;
    }
};

TEST_F(SlurmPlaying, OneThatCrashesTakesNoOtherOfItsTaskWithIt) {
    is("fails-c1", "FAILED 99");
    const std::vector<std::string> why = failed();
    ASSERT_EQ(why.size(), 4U);
    EXPECT_THAT(why[1],
                AllOf(StartsWith("its task was lost 3 times, the last one as FAILED (log: slurm/fernlicht-"), EndsWith("-3-0.log)")));
    for (const int other : {0, 2, 3})
        EXPECT_EQ(why[static_cast<std::size_t>(other)], "");
    EXPECT_THAT(submitted(), ElementsAre(ElementsAre(4), ElementsAre(1, 1, 1, 1), ElementsAre(1)));
}

TEST_F(SlurmPlaying, OnlyATaskOfOneCellTellsWhichTakesTooMuch) {
    is("fails-c2", "TIMEOUT 99");
    const std::vector<std::string> why = failed();
    ASSERT_EQ(why.size(), 4U);
    EXPECT_THAT(why[2], StartsWith("its task ended as TIMEOUT (log: "));
    for (const int other : {0, 1, 3})
        EXPECT_EQ(why[static_cast<std::size_t>(other)], "");
    EXPECT_THAT(submitted(), ElementsAre(ElementsAre(4), ElementsAre(1, 1, 1, 1)));
}

TEST_F(SlurmPlaying, ATaskThatWasRequeuedHasAllTheTimeForLateFilesAnew) {
    is("fails-c1", "NODE_FAIL 1");
    is("requeued", "");
    patience.late_files_s = 1.2; // less than thirty looks take
    EXPECT_THAT(failed(), ElementsAre("", "", "", ""));
    EXPECT_EQ(content_of(folder / "calls"), "sbatch\n");
}

TEST_F(SlurmPlaying, InterruptedWhileItAsksForArraysItSubmitsNoneAndForgetsNone) {
    constexpr const char* record =
        R"({"schema": "fernlicht slurm jobs", "schema_version": 1, "arrays": [{"name": "fernlicht-x-1", "id": "", "cells": [["c0"], ["c1"]]},)"
        R"( {"name": "fernlicht-x-2", "id": "7", "cells": [["c2", "c3"]]}]})";
    is("out/slurm.json", record);
    is("silent", "");
    testing::internal::CaptureStderr();
    EXPECT_THAT(play(), IsEmpty());
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(content_of(folder / "calls"), "scancel --name=fernlicht-x-1\nscancel --name=fernlicht-x-2\n");
    EXPECT_EQ(content_of(folder / "out/slurm.json"), record);
    EXPECT_THAT(said, AllOf(HasSubstr("interrupted: job array fernlicht-x-1 may still run: scancel: error: Unable to contact slurm "
                                      "controller; cancel it by scancel --name=fernlicht-x-1\n"),
                            HasSubstr("job array 7 may still run"), Not(HasSubstr("all jobs are cancelled"))));
}

TEST_F(SlurmPlaying, TheFirstArrayThatIsRefusedEndsTheStudy) {
    is("refuse-1", "");
    EXPECT_EQ(tests::refusal_of<DeviceError>([&] { play(); }),
              "sbatch refused the job array: sbatch: error: Socket timed out on send/recv operation");
    EXPECT_THAT(submitted(), IsEmpty());
}

TEST_F(SlurmPlaying, ALaterOneIsTriedAgainAndDoesNotCount) {
    is("fails-c1", "FAILED 4");
    for (const char* refused : {"refuse-2", "refuse-3"})
        is(refused, "");
    testing::internal::CaptureStderr();
    const std::vector<std::string> why = failed();
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_THAT(why, ElementsAre("", "", "", "")) << "lost in the first and the fourth array, played in the fifth";
    EXPECT_THAT(submitted(), ElementsAre(ElementsAre(4), ElementsAre(1, 1, 1, 1), ElementsAre(1)));
    EXPECT_EQ(said, "fernlicht: sbatch refused the job array: sbatch: error: Socket timed out on send/recv operation; it is asked again "
                    "every 0.05 s\n");
}

TEST_F(SlurmPlaying, ALaterOneThatIsAlwaysRefusedFailsItsCells) {
    is("fails-c1", "FAILED 1");
    for (int n = 2; n < 20; ++n)
        is(fmt::format("refuse-{}", n), "");
    testing::internal::CaptureStderr();
    for (const std::string& why : failed())
        EXPECT_EQ(why, "sbatch refused the job array: sbatch: error: Socket timed out on send/recv operation, 4 times");
    testing::internal::GetCapturedStderr();
    EXPECT_THAT(submitted(), ElementsAre(ElementsAre(4)));
}

TEST_F(SlurmPlaying, AnArrayThatIsThereThoughSbatchFailedIsNotSubmittedTwice) {
    is("fails-c1", "FAILED 1");
    for (const char* refused : {"refuse-1", "refuse-2"})
        is(refused, "there");
    EXPECT_THAT(failed(), ElementsAre("", "", "", ""));
    EXPECT_EQ(content_of(folder / "calls"), "sbatch\nsbatch\n");
    EXPECT_THAT(submitted(), ElementsAre(ElementsAre(4), ElementsAre(1, 1, 1, 1)));
}

} // namespace
} // namespace fernlicht
