#include "runner/files/log.h"

#include "runner/files/json_text.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fmt/chrono.h>

namespace fernlicht {
namespace {

constexpr std::array<const char*, 4> level_names{"error", "warning", "info", "debug"};

std::string now_utc_ms() {
    const auto now = std::chrono::system_clock::now();
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(now)), ms);
}

std::string json_of(const std::int64_t value) { return fmt::format("{}", value); }
std::string json_of(const double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }
std::string json_of(const std::string& value) { return json_quoted(value); }

/// As GitHub's runner takes them apart again; in a property the signs that end one as well.
std::string escaped(const std::string& text, bool is_property) {
    std::string out;
    for (const char c : text)
        if (c == '%' || c == '\r' || c == '\n' || (is_property && (c == ':' || c == ',')))
            out += fmt::format("%{:02X}", static_cast<unsigned>(c));
        else
            out += c;
    return out;
}

/// The runner wants paths from the repository's root, where jobs begin.
std::string from_working_folder(const std::filesystem::path& file) {
    std::error_code ignored;
    const std::filesystem::path near = file.is_absolute() ? std::filesystem::proximate(file, ignored) : file;
    return (near.empty() ? file : near).lexically_normal().generic_string();
}

} // namespace

LogSettings& log_settings() {
    static LogSettings settings;
    return settings;
}

void tell(LogLevel level, const std::string& message, const LogFields& fields) {
    if (!is_told(level))
        return;
    std::string line;
    if (log_settings().json) {
        line = fmt::format(R"({{"time":"{}","level":"{}","message":{})", now_utc_ms(), level_names.at(static_cast<std::size_t>(level)),
                           json_quoted(message));
        for (const auto& [name, value] : fields)
            line += fmt::format(",\"{}\":{}", name, std::visit([](const auto& one) { return json_of(one); }, value));
        line += "}\n";
    } else
        line = (level <= LogLevel::warning ? "fernlicht: " : "") + message + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr); // in one piece: other processes may write there too
}

void tell_end(const std::exception& error, int exit_code) {
    LogFields fields{{"exit_code", std::int64_t{exit_code}}};
    InputError::Where where;
    if (const auto* const input = dynamic_cast<const InputError*>(&error)) {
        where = input->where();
        if (!where.file.empty())
            fields.emplace_back("file", where.file.string());
        if (where.line > 0)
            fields.emplace_back("line", static_cast<std::int64_t>(where.line));
        if (where.column > 0)
            fields.emplace_back("column", static_cast<std::int64_t>(where.column));
        if (!where.key.empty())
            fields.emplace_back("key", where.key);
    }
    tell(LogLevel::error, error.what(), fields);
    annotate(where, "fernlicht", error.what());
}

void annotate(const InputError::Where& where, const std::string& title, const std::string& message) {
    if (!log_settings().github)
        return;
    std::string place;
    if (!where.file.empty())
        place = "file=" + escaped(from_working_folder(where.file), true) + ",";
    if (!where.file.empty() && where.line > 0)
        place += fmt::format("line={},", where.line);
    if (!where.file.empty() && where.column > 0)
        place += fmt::format("col={},", where.column);
    fmt::print(stderr, "::error {}title={}::{}\n", place, escaped(title, true), escaped(message, false));
}

} // namespace fernlicht
