#include "runner/findings/run_context.h"

#include "runner/findings/library_versions.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/utsname.h>

namespace fernlicht {
namespace {

/// The value of the first line `key : value` of a text file; "" if there is none.
std::string value_of(const char* file, const std::string& key, const char* separator) {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with(key))
            if (const std::size_t at = line.find(separator); at != std::string::npos) {
                const std::size_t from = line.find_first_not_of(" \t\"", at + 1);
                const std::string value = from == std::string::npos ? "" : line.substr(from);
                return value.ends_with('"') ? value.substr(0, value.size() - 1) : value;
            }
    return {};
}

} // namespace

std::string shell_quoted(const std::vector<std::string>& words) {
    static constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
    std::string line;
    for (const std::string& word : words) {
        line += line.empty() ? "" : " ";
        if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
            line += word;
            continue;
        }
        line += '\'';
        for (const char c : word)
            line += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += '\'';
    }
    return line;
}

std::string cpu_name() {
    const std::string name = value_of("/proc/cpuinfo", "model name", ":");
    return name.empty() ? "unknown" : name;
}

std::string simd_class() {
    const std::string flags = " " + value_of("/proc/cpuinfo", "flags", ":") + " ";
    for (const auto& [flag, name] :
         {std::pair(" avx512f ", "avx512"), std::pair(" avx2 ", "avx2"), std::pair(" avx ", "avx"), std::pair(" sse4_1 ", "sse4.1")})
        if (flags.find(flag) != std::string::npos)
            return name;
    return "other";
}

std::string repeat_command(const std::vector<std::string>& call, const std::vector<std::string>& choice,
                           const std::vector<std::string>& others) {
    if (call.empty())
        return "";
    std::vector<std::string> words;
    const auto is = [](const std::string& word, const std::string& flag) { return word == flag || word.starts_with(flag + "="); };
    for (std::size_t i = 0; i < call.size(); ++i)
        if (std::ranges::any_of(std::array{"--out", "--trace", "--annotate", "--history"},
                                [&](const char* of_this_call) { return is(call[i], of_this_call); }) ||
            (!choice.empty() && is(call[i], "--only")))
            i += call[i].find('=') == std::string::npos ? 1U : 0U;
        else if (call[i] != "--resume" && call[i] != "--collect" && call[i] != "--log-json" && call[i] != "--fail-on-change" &&
                 std::ranges::find(others, call[i]) == others.end())
            words.push_back(call[i]);
    words.insert(words.end(), choice.begin(), choice.end());
    return shell_quoted(words);
}

std::string os_name() {
    std::string pretty = value_of("/etc/os-release", "PRETTY_NAME", "=");
    utsname names{};
    if (::uname(&names) != 0)
        return pretty;
    return fmt::format("{}, {} {} {}", pretty, names.sysname, names.release, names.machine);
}

std::string utc_now() {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
}

RunContext make_context(const DeviceInfo& device, const std::vector<std::string>& command, std::uint64_t seed) {
    RunContext context;
    context.versions = library_versions();
    context.backend = device.backend;
    context.gl_renderer = device.gl_renderer;
    context.gl_version = device.gl_version;
    context.cpu = fmt::format("{} ({})", cpu_name(), simd_class());
    context.os = os_name();
    context.command = shell_quoted(command);
    context.started_utc = utc_now();
    context.seed = seed;
    return context;
}

} // namespace fernlicht
