#include "runner/store/cell_key.h"

#include "scenarios/studies/study.h"
#include "tests/runner/program.h"
#include "tests/trial.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

namespace fs = std::filesystem;

const FilesRead key_road{{"roads/a.xodr", 3, "aa"}}, key_others{{"models/tree.glb", 3, "bb"}};

RunContext key_context() {
    RunContext context;
    context.versions = {{"fernlicht", "0.2.0"}, {"fmt", "9.1.0"}};
    context.backend = "egl";
    context.gl_renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
    context.gl_version = "4.5 Mesa 22.3.6";
    context.cpu = "AMD EPYC (avx2)";
    return context;
}

struct CellKey : testing::Test {
    Drive drive = read_drive(library_file("drives/straight.yaml"), {});
    CellSettings settings{0, 9, true, 1};
    CellKey() { drive.lamp_sets.resize(1); }
    CellInputs inputs(const Drive& of) const {
        CellInputs all = cell_inputs(of, key_road, key_others, settings);
        std::ranges::copy(machine_inputs(key_context(), settings.accuracy), std::back_inserter(all));
        return all;
    }
    std::string key(const Drive& of) const { return cell_key(inputs(of)); }
};

TEST_F(CellKey, WhatDecidesNoFigureDoesNotCount) {
    const std::string before = key(drive);
    Drive other = drive;
    other.title = "another title";
    other.limits = {{"reach_1lx_road_own_m", 1000.0, {}, 0}};
    other.road_file = "/elsewhere/road.xodr";
    other.file = "/elsewhere/drive.yaml";
    for (LampSource& source : other.lamp_sources)
        source.path = "/elsewhere" / source.path.filename();
    EXPECT_EQ(key(other), before);
    // A file that the drive named before others took its place.
    auto unused = std::make_shared<LampFile>(*drive.lamp_sources.front().file);
    unused->opened = {{"/elsewhere/old.ies", 1, "cc"}};
    other.lamp_sources.push_back({"/elsewhere/old.ies", {}, unused});
    EXPECT_EQ(key(other), before);
}

TEST_F(CellKey, EveryInputCountsAndSaysWhatItIs) {
    const CellInputs before = inputs(drive);
    const auto told = [&](const Drive& changed) { return input_changes(before, inputs(changed)); };
    EXPECT_THAT(told(drive), IsEmpty());
    Drive other = drive;
    other.lamp_sets[0].lamps[0].pitch_rad += 1e-9;
    EXPECT_THAT(told(other), ElementsAre("drive changed: straight.yaml (lamp_sets), in its file or set by the study"));
    EXPECT_NE(key(other), cell_key(before));
    other.seed += 1;
    other.start.s_m += 1.0;
    EXPECT_THAT(told(other), ElementsAre("drive changed: straight.yaml (lamp_sets, route, seed), in its file or set by the study"));
    CellInputs without_keys = before; // as programs before this one kept them
    std::erase_if(without_keys, is_key);
    EXPECT_THAT(input_changes(without_keys, before), IsEmpty());
    EXPECT_THAT(input_changes(without_keys, inputs(other)), ElementsAre("drive changed: straight.yaml, in its file or set by the study"));
    other.file = "other.yaml";
    EXPECT_THAT(told(other), ElementsAre("drive other.yaml is new", "drive straight.yaml is gone"));
    other = drive;
    for (LampSource& source : other.lamp_sources)
        if (source.file == drive.lamp_sets[0].lamps[0].file) {
            auto changed = std::make_shared<LampFile>(*source.file);
            changed->opened.front().xxh128 = "other bytes";
            source.file = changed;
            for (MountedLamp& lamp : other.lamp_sets[0].lamps)
                lamp.file = changed;
        }
    EXPECT_THAT(told(other), ElementsAre("lamp halogen-low.ies changed (bytes of its file)"));
    EXPECT_NE(key(other), cell_key(before));
    CellSettings fewer = settings;
    fewer.last_tick = 8;
    CellInputs now = cell_inputs(drive, key_road, key_others, fewer);
    EXPECT_NE(cell_key(now), cell_key(cell_inputs(drive, key_road, key_others, settings)));
    EXPECT_THAT(input_changes(cell_inputs(drive, key_road, key_others, settings), now), ElementsAre("setting changed: moments 0:9 -> 0:8"));
    EXPECT_THAT(input_changes(cell_inputs(drive, key_road, key_others, settings),
                              cell_inputs(drive, {{"roads/a.xodr", 3, "ab"}}, {{"models/tree.glb", 3, "bc"}}, settings)),
                ElementsAre("road a.xodr changed (bytes of its file)", "model tree.glb changed (bytes of its file)"));
    RunContext context = key_context();
    context.versions[1].second = "10.1.1";
    context.gl_version = "4.5 Mesa 25.0.7";
    EXPECT_THAT(input_changes(machine_inputs(key_context(), true), machine_inputs(context, true)),
                ElementsAre("library changed: fmt 9.1.0 -> 10.1.1", "device changed: driver 4.5 Mesa 22.3.6 -> 4.5 Mesa 25.0.7"));
    context = key_context();
    context.versions[0].second = "0.3.0";
    EXPECT_THAT(input_changes(machine_inputs(key_context(), true), machine_inputs(context, true)), IsEmpty()) << "its sources tell";
}

/// The rule by which the build hashes our sources, over a small tree.
struct ProgramSources : testing::Test {
    TemporaryFolder folder;
    const std::vector<std::string> deciding{"scenarios/lamps/a.cpp",
                                            "scenarios/photometry.glsl",
                                            "metrics/road/a.h",
                                            "renderer/shaders/a.frag.glsl",
                                            "runner/play/play.cpp",
                                            "runner/findings/summary.cpp",
                                            "runner/files/json_text.cpp",
                                            "runner/experiments/run/run.cpp",
                                            "runner/experiments/accuracy/error.cpp",
                                            "runner/judge/repeats.cpp",
                                            "CMakeLists.txt",
                                            "scenarios/CMakeLists.txt",
                                            "metrics/CMakeLists.txt",
                                            "renderer/CMakeLists.txt",
                                            "runner/CMakeLists.txt"};
    const std::vector<std::string> others{"scenarios/library/a.cpp",
                                          "runner/write/svg.cpp",
                                          "runner/commands/run_command.cpp",
                                          "runner/judge/limits.cpp",
                                          "docs/a.h",
                                          "runner/experiments/run/run_document.cpp",
                                          "runner/experiments/run/run_plots.cpp",
                                          "runner/experiments/study/study.cpp",
                                          "renderer/README.md"};
    ProgramSources() {
        for (const auto* const list : {&deciding, &others})
            for (const std::string& file : *list)
                write(file, "first\n");
    }
    void write(const std::string& file, const std::string& text) const {
        fs::create_directories(fs::path(folder / file).parent_path());
        std::ofstream(folder / file) << text;
    }
    std::string hashed(const std::string& flags = "-O2") const {
        const Outcome run = run_shell("cmake -DROOT=" + folder.path().string() + " -DOUT=" + (folder / "out.cpp") + " -DFLAGS=" + flags +
                                      " -P " FERNLICHT_SOURCE_DIR "/runner/store/program_sources.cmake");
        EXPECT_EQ(run.exit_code, 0) << run.output;
        return content_of(folder / "out.cpp");
    }
};

TEST_F(ProgramSources, AChangeOfWhatComputesIsSeenAndNoOther) {
    const std::string first = hashed();
    for (const std::string& file : others) {
        write(file, "changed\n");
        EXPECT_EQ(hashed(), first) << file;
    }
    for (const std::string& file : deciding) {
        write(file, "changed\n");
        EXPECT_NE(hashed(), first) << file;
        write(file, "first\n");
        EXPECT_EQ(hashed(), first) << file;
    }
    EXPECT_NE(hashed("-O3"), first);
}

TEST(BuiltProgramSources, AreThoseOfTheTree) {
    std::vector<std::string> rooms;
    for (const auto& [room, hash] : program_sources()) {
        rooms.push_back(room);
        EXPECT_EQ(hash.size(), 32U) << room;
    }
    EXPECT_THAT(rooms, ElementsAre("scenarios", "metrics", "renderer", "runner/play", "runner/findings", "runner/files",
                                   "runner/experiments/run", "runner/experiments/accuracy", "runner/judge", "compiler flags"));
}

} // namespace
} // namespace fernlicht
