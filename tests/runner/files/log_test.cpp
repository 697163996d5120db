// What is said on standard error, for people, programs and pages of CI servers.
#include "runner/files/log.h"

#include <cmath>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::MatchesRegex;

struct Log : testing::Test {
    ~Log() override { log_settings() = {}; }

    template <class Say> static std::string said(const Say& say) {
        testing::internal::CaptureStderr();
        say();
        return testing::internal::GetCapturedStderr();
    }
    template <class Say> static std::string printed(const Say& say) {
        testing::internal::CaptureStdout();
        said(say);
        return testing::internal::GetCapturedStdout();
    }
};

void say_all() {
    tell(LogLevel::error, "e");
    tell(LogLevel::warning, "w");
    tell(LogLevel::info, "i", {{"done", std::int64_t{3}}});
    tell(LogLevel::debug, "d");
}

TEST_F(Log, LevelsKeepBackWhatWeighsLess) {
    EXPECT_EQ(said(say_all), "fernlicht: e\nfernlicht: w\ni\n");
    log_settings().level = LogLevel::error;
    EXPECT_EQ(said(say_all), "fernlicht: e\n");
    log_settings().level = LogLevel::debug;
    EXPECT_EQ(said(say_all), "fernlicht: e\nfernlicht: w\ni\nd\n");
}

TEST_F(Log, JsonIsAnObjectALineWhateverATextHolds) {
    log_settings().json = true;
    const std::string line = said([] {
        tell(LogLevel::warning, "a \"b\"\nc \xff", {{"done", std::int64_t{3}}, {"per_s", 0.5}, {"left_s", std::nan("")}, {"file", "x\\y"}});
    });
    EXPECT_EQ(line.find('\n'), line.size() - 1);
    const json object = json::parse(line);
    EXPECT_THAT(object.at("time").get<std::string>(), MatchesRegex("2[0-9]+-[0-9]+-[0-9]+T[0-9]+:[0-9]+:[0-9]+\\.[0-9]+Z"));
    EXPECT_EQ(object.at("time").get<std::string>().size(), 24U);
    EXPECT_EQ(object.at("level"), "warning");
    EXPECT_EQ(object.at("message"), "a \"b\"\nc \ufffd");
    EXPECT_EQ(object.at("done"), 3);
    EXPECT_EQ(object.at("per_s"), 0.5);
    EXPECT_TRUE(object.at("left_s").is_null());
    EXPECT_EQ(object.at("file"), "x\\y");
}

TEST_F(Log, AnErrorOfInputHasItsPlace) {
    log_settings().json = true;
    const InputError error({"drive.yaml", 12, 3, "views"}, "found none", "one");
    const json object = json::parse(said([&] { tell_end(error, 2); }));
    EXPECT_EQ(object.at("level"), "error");
    EXPECT_EQ(object.at("message"), error.what());
    EXPECT_EQ(object.at("exit_code"), 2);
    EXPECT_EQ(object.at("file"), "drive.yaml");
    EXPECT_EQ(object.at("line"), 12);
    EXPECT_EQ(object.at("column"), 3);
    EXPECT_EQ(object.at("key"), "views");
    EXPECT_FALSE(json::parse(said([] { tell_end(std::runtime_error("x"), 4); })).contains("file"));
}

/// As GitHub documents its workflow commands: % \r \n escaped in the message, : and , too in properties.
TEST_F(Log, AnnotationsAreGitHubsWorkflowCommands) {
    const InputError::Where where{"a,b/./drive.yaml", 12, 0, ""};
    EXPECT_EQ(said([&] { annotate(where, "title", "text"); }), "") << "unless they are asked for";
    log_settings().github = true;
    EXPECT_EQ(said([&] { annotate(where, "FAIL x: 5%", "50 %, limit: 60\nrepeat with: y\r"); }),
              "::error file=a%2Cb/drive.yaml,line=12,title=FAIL x%3A 5%25::50 %25, limit: 60%0Arepeat with: y%0D\n");
    EXPECT_EQ(said([] { annotate({}, "t", "m"); }), "::error title=t::m\n");
    EXPECT_EQ(said([] {
                  annotate({std::filesystem::current_path() / "d/e.yaml", 0, 0, ""}, "t", "m");
              }),
              "::error file=d/e.yaml,title=t::m\n");
    EXPECT_EQ(said([] {
                  tell_end(InputError({"d.yaml", 3, 7, "k"}, "found 1"), 2);
              }),
              "fernlicht: d.yaml:3:7: k: found 1\n"
              "::error file=d.yaml,line=3,col=7,title=fernlicht::" +
                  std::string(InputError({"d.yaml", 3, 7, "k"}, "found 1").what()) + "\n");
}

} // namespace
} // namespace fernlicht
