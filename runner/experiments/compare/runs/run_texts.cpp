#include "metrics/readings/reading_words.h"
#include "runner/experiments/compare/runs/run_writers.h"
#include "runner/experiments/compare/strictness_failures.h"
#include "runner/files/clean_text.h"
#include "runner/write/aligned_table.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

std::string number(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : std::string(); }

std::string short_value(const Value& value) {
    return value.measured() ? with_bound(value, fmt::format("{:.4g}", *value.figure())) : "not measured";
}
std::string short_number(const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "not measured"; }

void append_line(std::string& csv, const std::vector<std::string>& fields) { csv += fmt::format("{}\r\n", fmt::join(fields, ",")); }

std::vector<std::string> change_line(const std::string& id, const DriveComparison& drive, const ReadingChange& c, bool decides) {
    return {id,
            csv_text(drive.now->drive),
            csv_text(drive.before->variant),
            csv_text(drive.now->variant),
            csv_text(drive.before->technique),
            csv_text(drive.now->technique),
            csv_text(name_of(c.reading)),
            csv_text(c.unit()),
            number(c.old_value.figure()),
            number(c.new_value.figure()),
            number(c.change().figure()),
            number(c.relative()),
            number(c.uncertainty),
            number(c.by_aim),
            number(c.by_noise),
            change_name(c.kind),
            decides ? "yes" : "no",
            csv_text(c.why_not),
            bound_name(c.old_value),
            bound_name(c.new_value),
            bound_name(c.change())};
}

std::string change_text(const ReadingChange& c) {
    const Value change = c.change();
    std::string text = fmt::format("{}: {} -> {} {}, {}", reading_in_words(c.reading), short_value(c.old_value), short_value(c.new_value),
                                   unit_in_words(c.unit()), with_bound(change, fmt::format("{:+.4g}", change.figure().value_or(0.0))));
    if (c.relative())
        text += fmt::format(" ({:+.1f} %)", 100.0 * *c.relative());
    if (c.uncertainty)
        text += fmt::format(", ±{:.2g}", *c.uncertainty);
    return text;
}

/// By channel the frame that differs most.
void append_frames(std::string& text, const DriveComparison& drive) {
    std::vector<std::string> channels;
    std::vector<std::vector<std::string>> rows;
    for (const FramePair& frame : drive.frames)
        for (const LayerComparison& layer : frame.comparison.layers)
            if (const std::string key = frame.view->name + ", " + layer.name; std::ranges::find(channels, key) == channels.end())
                channels.push_back(key);
    for (const std::string& channel : channels) {
        std::size_t frames = 0, equal = 0;
        const LayerComparison* worst = nullptr;
        double worst_s = 0.0;
        for (const FramePair& frame : drive.frames)
            for (const LayerComparison& layer : frame.comparison.layers) {
                if (frame.view->name + ", " + layer.name != channel)
                    continue;
                ++frames;
                equal += layer.histogram.equal == layer.histogram.pixels() ? 1U : 0U;
                if (!worst || value_in(layer, "rmse").value_or(0.0) > value_in(*worst, "rmse").value_or(0.0)) {
                    worst = &layer;
                    worst_s = frame.new_frame.time_s;
                }
            }
        rows.push_back({"  " + clean_text(channel), std::to_string(frames), std::to_string(equal), short_number(value_in(*worst, "rmse")),
                        short_number(value_in(*worst, "max_error")), unit_in_words(worst->unit), short_number(value_in(*worst, "ssim")),
                        fmt::format("{:.2f} s", worst_s)});
    }
    if (!rows.empty())
        text += aligned_table("<>>>><>>", {"  pictures", "frames", "equal", "RMSE", "largest", "", "SSIM", "most at"}, rows);
}

void append_drive(std::string& text, const RunComparison& runs, const DriveComparison& drive) {
    text +=
        fmt::format("\n{}: {} against {}\n", clean_text(drive.now->drive), clean_text(drive.new_label()), clean_text(drive.old_label()));
    constexpr std::size_t most_told = 8;
    for (std::size_t i = 0; i < std::min(most_told, drive.settings.size()); ++i)
        text += fmt::format("  set otherwise  {}: {} -> {}\n", short_text(drive.settings[i].key, 60),
                            short_text(drive.settings[i].old_value, 60), short_text(drive.settings[i].new_value, 60));
    if (drive.settings.size() > most_told)
        text += fmt::format("  set otherwise  and {} more; compare.json has them all\n", drive.settings.size() - most_told);
    for (const LampFilesDifference& lamps : drive.lamp_files)
        text += fmt::format("  lamp {}: {}\n", clean_text(lamps.lamps), sentences_of(lamps.difference).front());
    for (const std::string& file : drive.new_bytes)
        text += fmt::format("  other content  {}\n", short_text(file, 120));
    for (const std::string& sentence : drive.left_out)
        text += fmt::format("  left out       {}\n", clean_text(sentence));
    for (const TimeChange& time : drive.times)
        text += time.kind == ChangeKind::unknown ? fmt::format("  {}: not known: {}\n", name_of(time.reading), time.why_not)
                                                 : fmt::format("  {}; {}\n", change_text(time), change_name(time.kind));
    append_frames(text, drive);
    if (runs.strictness_name.empty())
        return;
    for (const FramePair& frame : drive.frames)
        if (!frame.comparison.passed()) {
            text += fmt::format("  FAIL {}: {} does not keep {}\n", clean_text(frame.new_frame.view),
                                clean_text(frame.file(frame.new_frame)), runs.strictness_name);
            for (const std::string& failure : strictness_failures(frame.comparison))
                text += "    " + clean_text(failure) + "\n";
        }
}

} // namespace

std::string row_id(std::size_t drive, std::size_t change) { return fmt::format("c{}-{}", drive, change); }

std::optional<double> value_in(const LayerComparison& layer, const std::string& name) {
    const auto found = std::ranges::find(layer.values, name, &ComparedValue::name);
    return found == layer.values.end() ? std::nullopt : found->value;
}

std::string runs_sentence(const RunComparison& runs) {
    std::size_t all = 0;
    for (const DriveComparison& drive : runs.drives)
        all += drive.changes.size();
    return all == 0 ? "No reading could be compared."
                    : fmt::format(
                          "Of {} readings that both runs have, {} changed for real, {} by no more than 0.1 degrees of aim would do, {} by "
                          "no more than calculation and noise leave open; of {} it is not known.",
                          all, runs.count(ChangeKind::real), runs.count(ChangeKind::within_aim), runs.count(ChangeKind::none),
                          runs.count(ChangeKind::unknown));
}

std::string runs_text(const RunComparison& runs) {
    std::string text = fmt::format("old A  {}\nnew B  {}\ndifferences are B - A\n{}\n", printable(runs.before.folder.string(), 400),
                                   printable(runs.now.folder.string(), 400), runs_sentence(runs));
    for (const std::string& sentence : runs.left_out)
        text += "left out: " + clean_text(sentence) + "\n";
    for (const auto& [drive, change] : runs.largest)
        text += fmt::format("{}; {}\n", change_text(runs.drives[drive].changes[change]), clean_text(runs.drives[drive].now->drive));
    for (const DriveComparison& drive : runs.drives)
        append_drive(text, runs, drive);
    if (!runs.strictness_name.empty()) {
        for (const std::string& why : runs.not_judged)
            text += "not held to the strictness: " + clean_text(why) + "\n";
        text += fmt::format("\nstrictness {}: {}\n", runs.strictness_name, runs.passed() ? "pass" : "FAIL");
    }
    return text;
}

std::string runs_csv(const RunComparison& runs) {
    std::string csv =
        "id,drive,old_variant,new_variant,old_technique,new_technique,reading,unit,old_value,new_value,change,relative_change,"
        "uncertainty,by_tenth_degree,by_noise,kind,decides,why_not,old_bound,new_bound,change_bound\r\n";
    for (std::size_t d = 0; d < runs.drives.size(); ++d) {
        const DriveComparison& drive = runs.drives[d];
        for (std::size_t i = 0; i < drive.changes.size(); ++i)
            append_line(csv, change_line(row_id(d, i), drive, drive.changes[i], drive.decides(drive.changes[i].reading)));
    }
    for (const DriveComparison& drive : runs.drives) // last: they differ from run to run
        for (const TimeChange& time : drive.times)
            append_line(csv, change_line("", drive, time, false));
    return csv;
}

std::string frames_csv(const RunComparison& runs) {
    std::string csv = "drive,old_variant,new_variant,view,frame,time_s,file,channel,figure,unit,value,x,y,not_measured\r\n";
    for (const DriveComparison& drive : runs.drives)
        for (const FramePair& frame : drive.frames)
            for (const LayerComparison& layer : frame.comparison.layers)
                for (const ComparedValue& v : layer.values)
                    append_line(csv,
                                {csv_text(drive.now->drive), csv_text(drive.before->variant), csv_text(drive.now->variant),
                                 csv_text(frame.new_frame.view), std::to_string(frame.new_frame.tick),
                                 fmt::format("{}", frame.new_frame.time_s), csv_text(frame.file(frame.new_frame)), csv_text(layer.name),
                                 csv_text(v.name), csv_text(v.unit), number(v.value), v.place ? std::to_string(v.place->first) : "",
                                 v.place ? std::to_string(v.place->second) : "", csv_text(v.value ? "" : v.why_not)});
    return csv;
}

} // namespace fernlicht
