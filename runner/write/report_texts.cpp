#include "runner/write/report_texts.h"

#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"
#include "runner/findings/moment_columns.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {

std::string report_csv(const Report& report) {
    std::string out = "drive,lamp_set,technique,frame,quantity,aspect,threshold,threshold_unit,surface,lane,place,distance_m,to_m,"
                      "statistic,subject,bound,value,unit,reason,where,name";
    for (const SensitivityRow& row : sensitivity_rows)
        out += fmt::format(",{}", row.name);
    out += ",between_moments\r\n";
    for (const PlayedCell& played : report.played)
        for (const Reading& reading : played.readings) {
            const ReadingKey& key = reading.key;
            const bool has_threshold = key.threshold.unit != ThresholdUnit::none;
            const Sensitivity& s = reading.sensitivity;
            out += csv_line(csv_text(played.drive), csv_text(played.lamp_set), csv_text(played.technique),
                            reading.tick < 0 ? "" : fmt::format("{}", reading.tick), row_of(key.quantity).id, name_of(key.aspect),
                            has_threshold ? csv_number(key.threshold.value) : "", name_of(key.threshold.unit), name_of(key.surface),
                            key.lane, name_of(key.place), csv_number(key.distance_m), csv_number(key.to_m), name_of(key.statistic),
                            csv_text(key.subject), bound_name(reading.value), csv_number(reading.value.figure()), csv_text(reading.unit()),
                            csv_text(reading.value.reason()), csv_text(reading.where), csv_text(reading.name()), csv_number(s.aim_up),
                            csv_number(s.aim_down), csv_number(s.brighter), csv_number(s.dimmer), csv_number(s.higher), csv_number(s.lower),
                            csv_number(s.loaded), csv_number(reading.between_moments));
        }
    return out;
}

std::string moments_csv(const PlayedCell& played) {
    const std::vector<MomentColumn> columns = moment_columns(played);
    if (columns.empty())
        return {};
    std::string out;
    for (const MomentColumn& column : columns)
        out += (out.empty() ? "" : ",") + csv_text(column.name);
    for (std::size_t moment = 0; moment < columns.front().cells.size(); ++moment)
        for (const MomentColumn& column : columns)
            out += (&column == columns.data() ? "\r\n" : ",") +
                   (column.cells[moment].starts_with('-') ? column.cells[moment] : csv_text(column.cells[moment]));
    return out + "\r\n";
}

std::string times_csv(const Report& report) {
    std::string out = "drive,lamp_set,name,value,unit\r\n";
    for (const PlayedCell& played : report.played) {
        const auto add = [&](const std::string& name, std::optional<double> value, const char* unit) {
            out += csv_line(csv_text(played.drive), csv_text(played.lamp_set), csv_text(name), csv_number(value), unit);
        };
        for (const PassTime& pass : played.passes)
            if (const std::optional<Spread> spread = spread_of(pass.seconds)) {
                add(pass.name + ", median", 1e3 * spread->median, "ms");
                add(pass.name + ", 5th percentile", 1e3 * spread->p05, "ms");
                add(pass.name + ", 95th percentile", 1e3 * spread->p95, "ms");
            }
        const Throughput& t = played.throughput;
        const auto per_s = [](const std::optional<double>& seconds) { return seconds ? std::optional(1.0 / *seconds) : std::nullopt; };
        add("moments per second", t.moments_per_s(), "1/s");
        add("driver's view alone per second", per_s(t.view_s), "1/s");
        add("all drawing alone per second", per_s(t.drawing_s), "1/s");
        add("share of driver's view alone", t.share_of(t.view_s), "1");
        add("share of all drawing alone", t.share_of(t.drawing_s), "1");
        add("peak memory", t.peak_memory_mib, "MiB");
        if (const std::optional<PairedRatio> ratio = played.savings.ratio()) {
            add("frame back to back, median", 1e3 * spread_of(played.savings.pruned_s).value().median, "ms");
            add("frame back to back with nothing left out, median", 1e3 * spread_of(played.savings.unpruned_s).value().median, "ms");
            add("ratio to nothing left out, median", ratio->median, "1");
            add("ratio to nothing left out, 5th percentile", ratio->p05, "1");
            add("ratio to nothing left out, 95th percentile", ratio->p95, "1");
        }
    }
    return out;
}

namespace {

struct Counts {
    std::size_t tests = 0, failures = 0, errors = 0, skipped = 0;
};

/// What was asked for and could not be measured is an error, not skipped: a build that reads this file must not stay green on it.
/// Skipped are known failures alone.
const char* element_of(const Verdict& verdict) {
    if (!is_red(verdict))
        return verdict.kind == VerdictKind::pass ? "" : "skipped";
    return verdict.kind == VerdictKind::not_measured ? "error" : "failure";
}

const char* type_of(const Verdict& verdict) {
    switch (verdict.kind) {
    case VerdictKind::pass:
        return "unexpected pass";
    case VerdictKind::flaky:
        return "flaky";
    case VerdictKind::fail:
        return verdict.name.starts_with("baseline") ? "baseline" : "failed";
    case VerdictKind::not_measured:
        break;
    }
    return "not measured";
}

Counts count(const std::vector<Verdict>& verdicts) {
    const auto of = [&](std::string_view element) {
        return static_cast<std::size_t>(
            std::ranges::count_if(verdicts, [&](const Verdict& verdict) { return element_of(verdict) == element; }));
    };
    return {verdicts.size(), of("failure"), of("error"), of("skipped")};
}

std::string open_suite(const std::string& name, const Counts& counts) {
    return fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n", xml_text(name),
                       counts.tests, counts.failures, counts.errors, counts.skipped);
}

std::string test_case(const std::string& suite, const Verdict& verdict) {
    std::string class_name = suite;
    std::ranges::replace(class_name, '.', '_'); // at its last dot Jenkins takes a package off
    const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\"", xml_text(class_name), xml_text(verdict.name));
    const std::string text = xml_text(verdict.known.empty() ? verdict.text : verdict.text + "; " + verdict.known);
    const std::string_view element = element_of(verdict);
    if (element.empty())
        return head + fmt::format(">\n      <system-out>{}</system-out>\n    </testcase>\n", text);
    if (element == "skipped")
        return head + fmt::format(">\n      <skipped message=\"{}\"/>\n    </testcase>\n", text);
    std::string detail = text;
    if (!verdict.rerun.empty())
        detail += "\nrepeat with: " + xml_text(verdict.rerun);
    return head +
           fmt::format(">\n      <{0} message=\"{1}\" type=\"{2}\">{3}</{0}>\n    </testcase>\n", element, text, type_of(verdict), detail);
}

} // namespace

std::string report_junit(const Report& report) {
    Counts all;
    std::string suites;
    const auto add = [&](const std::string& name, const std::vector<Verdict>& verdicts) {
        const Counts counts = count(verdicts);
        all = {all.tests + counts.tests, all.failures + counts.failures, all.errors + counts.errors, 0};
        suites += open_suite(name, counts);
        for (const Verdict& verdict : verdicts)
            suites += test_case(name, verdict);
        suites += "  </testsuite>\n";
    };
    for (const PlayedCell& played : report.played)
        add(played.drive + ", " + played.lamp_set + (played.technique == "photometric" ? "" : ", technique " + played.technique),
            played.verdicts);
    if (!report.listed.empty())
        add("known failures", report.listed);
    if (!report.complete)
        add("run", {{VerdictKind::not_measured, "complete", "interrupted: " + report.interrupted, report.context.command}});
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" +
           fmt::format("<testsuites name=\"fernlicht\" tests=\"{}\" failures=\"{}\" errors=\"{}\">\n", all.tests, all.failures,
                       all.errors) +
           suites + "</testsuites>\n";
}

} // namespace fernlicht
