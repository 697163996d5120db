// Spans of threads, and the file that Perfetto opens.
#include "runner/files/trace_file.h"
#include "tests/runner/program.h"
#include "tests/trial.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> names_of(const Trace& trace) {
    std::vector<std::string> names;
    for (const TracedSpan& span : trace.spans)
        names.emplace_back(span.name);
    return names;
}

void work_as(const char* role, const char* what) {
    std::thread([=] {
        name_traced_thread(role);
        const TraceSpan span(what, "test");
    }).join();
}

TEST(Trace, RecordsNothingUntilItIsStarted) {
    {
        TraceSpan span("before", "test");
        EXPECT_FALSE(span);
        start_tracing();
        const TraceSpan now("now", "test");
        EXPECT_TRUE(static_cast<bool>(now));
    }
    EXPECT_THAT(names_of(stop_tracing()), ElementsAre("now"));
    { const TraceSpan span("after", "test"); }
    start_tracing();
    EXPECT_THAT(names_of(stop_tracing()), IsEmpty()) << "what ended before is gone";
}

TEST(Trace, SpansLieWithinOneAnotherAndThreadsOneAfterTheOtherShareALane) {
    start_tracing();
    {
        const TraceSpan outer("outer", "test");
        const TraceSpan inner("inner", "test");
        work_as("writer", "first");
        work_as("writer", "second");
        work_as("measuring", "third");
        std::thread waiting([] { // lives while another of its kind works
            name_traced_thread("writer");
            work_as("writer", "fourth");
        });
        waiting.join();
    }
    const Trace trace = stop_tracing();
    ASSERT_THAT(names_of(trace), ElementsAre("first", "second", "third", "fourth", "inner", "outer"));
    const auto lane = [&](std::size_t i) { return trace.spans[i].lane; };
    EXPECT_EQ(lane(0), lane(1));
    EXPECT_NE(lane(1), lane(2));
    EXPECT_NE(lane(0), lane(3));
    EXPECT_EQ(lane(4), lane(5));
    EXPECT_EQ(trace.lanes[lane(0)] + trace.lanes[lane(2)] + trace.lanes[lane(3)] + trace.lanes[lane(5)], "writermeasuringwritermain");
    const TracedSpan &inner = trace.spans[4], &outer = trace.spans[5];
    EXPECT_LE(outer.begin_ns, inner.begin_ns);
    EXPECT_LT(inner.begin_ns, trace.spans[0].begin_ns);
    EXPECT_LE(trace.spans[3].end_ns, inner.end_ns);
    EXPECT_LE(inner.end_ns, outer.end_ns);
}

/// By hand: 1.5 us after 2 us, on the second lane.
Trace one_span() {
    return {{{.name = "read back",
              .category = "pass",
              .begin_ns = 2'000,
              .end_ns = 3'501,
              .lane = 1,
              .details = {{"view", "a \"b\"\n"}, {"tick", std::int64_t{7}}}}},
            {"main", "writer"},
            0};
}

TEST(TraceFile, IsChromesFormat) {
    const std::string text = trace_json(one_span(), "fernlicht run \"x\"", 42);
    const json trace = json::parse(text);
    EXPECT_EQ(trace.at("displayTimeUnit"), "ms");
    const json& events = trace.at("traceEvents");
    ASSERT_EQ(events.size(), 3U) << "a lane without spans has no name";
    EXPECT_EQ(events[0], json::parse(R"({"ph":"M","pid":42,"tid":0,"name":"process_name","args":{"name":"fernlicht run \"x\""}})"));
    EXPECT_EQ(events[1], json::parse(R"({"ph":"M","pid":42,"tid":2,"name":"thread_name","args":{"name":"writer"}})"));
    EXPECT_EQ(events[2], json::parse(R"({"ph":"X","pid":42,"tid":2,"ts":2.0,"dur":1.501,"name":"read back","cat":"pass",
                                         "args":{"view":"a \"b\"\n","tick":7}})"));
    EXPECT_THAT(text, HasSubstr("\"ts\":2.000,\"dur\":1.501,")) << "microseconds with all nanoseconds, also where a double has not so many";
}

TEST(TraceFile, OfSeveralProcessesMergesIntoOne) {
    const std::filesystem::path folder = tests::new_folder();
    const std::string text = trace_json(one_span(), "one", 1);
    tests::written("a.json", text, folder);
    tests::written("b.json", trace_json(one_span(), "two", 2), folder);
    tests::written("killed.json", text.substr(0, text.size() - 4), folder);
    tests::written("other.json", "{\"traceEvents\":[]}\n", folder);
    const std::vector<std::string> left_out = merge_traces(
        {folder / "a.json", folder / "b.json", folder / "killed.json", folder / "none.json", folder / "other.json"}, folder / "a.json");
    EXPECT_THAT(left_out, ElementsAre(HasSubstr("killed.json:5: found the end of the file"), HasSubstr("none.json"),
                                      HasSubstr("no trace of fernlicht")));
    const json events = json::parse(content_of(folder / "a.json")).at("traceEvents");
    ASSERT_EQ(events.size(), 6U);
    EXPECT_EQ(events[2].at("pid"), 1);
    EXPECT_EQ(events[5].at("pid"), 2);
    EXPECT_THAT(merge_traces({folder / "a.json"}, folder / "again.json"), IsEmpty());
    EXPECT_EQ(json::parse(content_of(folder / "again.json")).at("traceEvents"), events);
}

TEST(TraceFile, TakesWhatProcessesOfItsOwnLeft) {
    const std::filesystem::path folder = tests::new_folder(), logs = folder / "logs";
    std::filesystem::create_directory(logs);
    {
        TraceFile trace(folder / "t.json", "parent", folder);
        const TraceSpan span("late", "test"); // open when the trace ends: lost
        { const TraceSpan work("work", "test"); }
        tests::written("a.json", trace_json(one_span(), "child", 77), logs);
        join_trace_of_process(logs / "a.json");
        join_trace_of_process(logs / "a.json"); // started once more
        join_trace_of_process(logs / "killed.json");
        testing::internal::CaptureStderr();
        trace.finish();
        EXPECT_THAT(testing::internal::GetCapturedStderr(),
                    AllOf(HasSubstr("fernlicht: left out of the trace: "), HasSubstr("killed.json")));
    }
    const json events = json::parse(content_of(folder / "t.json")).at("traceEvents");
    ASSERT_EQ(events.size(), 6U);
    EXPECT_EQ(events[2].at("name"), "work");
    EXPECT_EQ(events[2].at("pid"), ::getpid());
    EXPECT_EQ(events[5].at("pid"), 77);
    EXPECT_FALSE(std::filesystem::exists(logs));
}

TEST(TraceFile, IsANewFileInAFolderThatIsThereOrWillBe) {
    const std::filesystem::path folder = tests::new_folder();
    tests::written("a.json", "mine", folder);
    EXPECT_THAT(tests::refusal_of([&] { TraceFile(folder / "a.json", "x", folder / "out"); }), HasSubstr("--trace"));
    EXPECT_THAT(tests::refusal_of([&] { TraceFile(folder / "none/a.json", "x", folder / "out"); }), HasSubstr("there is no folder"));
    EXPECT_EQ(content_of(folder / "a.json"), "mine");
    { const TraceFile unmade(folder / "out/t.json", "x", folder / "out"); }
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << "a run that was refused leaves no folder";
    EXPECT_FALSE(is_tracing());
    try {
        const TraceFile trace(folder / "t.json", "x", folder / "out");
        const TraceSpan span("work", "test");
        throw std::runtime_error("interrupted");
    } catch (const std::runtime_error&) {
    }
    EXPECT_THAT(content_of(folder / "t.json"), HasSubstr("\"name\":\"work\""));
    { const TraceFile none("", "x", folder); }
    { const TraceFile of_worker(folder / "worker.json", "x", ""); }
    EXPECT_TRUE(std::filesystem::exists(folder / "worker.json"));
    EXPECT_THAT(tests::refusal_of([&] { TraceFile(folder / "none/a.json", "x", ""); }), HasSubstr("there is no folder"));
}

} // namespace
} // namespace fernlicht
