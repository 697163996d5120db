#include "runner/experiments/compare/runs/run_pairs.h"

#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/files/output_folder.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace fernlicht {
namespace {

const YamlValue* lamp_set_of(const RunDrive& drive) { return member_of(member_of(drive.resolved, "lamp_sets"), drive.lamp_set); }

bool is_same(const RunDrive& a, const RunDrive& b, const char* key) {
    std::vector<YamlChange> changes;
    add_changes(member_of(a.resolved, key), member_of(b.resolved, key), key, changes);
    return changes.empty();
}

/// What makes two moments of one time two places; "" where they are the same.
std::string why_another_route(const RunDrive& a, const RunDrive& b) {
    if (a.road_hash.empty() || b.road_hash.empty() ? !is_same(a, b, "road") : a.road_hash != b.road_hash)
        return "another road";
    for (const char* key : {"route", "speed", "step_s"})
        if (!is_same(a, b, key))
            return fmt::format("another {}", key == std::string("step_s") ? "step of time" : key);
    return "";
}

std::string shown_name(const RunDrive& drive) { return fmt::format("{} ({}, {})", drive.drive, drive.lamp_set, drive.technique); }

std::vector<YamlChange> settings_of(const RunDrive& before, const RunDrive& now) {
    std::vector<YamlChange> changes;
    YamlValue a = before.resolved, b = now.resolved;
    for (YamlValue* document : {&a, &b})
        std::erase_if(document->members, [](const YamlMember& m) { return m.key == "lamp_sets" || m.key == "name" || m.key == "title"; });
    if (!before.road_hash.empty() && before.road_hash == now.road_hash) // the same bytes under another path
        for (YamlValue* document : {&a, &b})
            std::erase_if(document->members, [](const YamlMember& m) { return m.key == "road"; });
    add_changes(lamp_set_of(before), lamp_set_of(now), "", changes);
    add_changes(&a, &b, "", changes);
    std::erase_if(changes, [&](const YamlChange& change) { // lamp files of the same bytes elsewhere
        const auto old_hash = before.hashes.find(change.old_value), new_hash = now.hashes.find(change.new_value);
        return old_hash != before.hashes.end() && new_hash != now.hashes.end() && old_hash->second == new_hash->second;
    });
    return changes;
}

class Pairing {
  public:
    explicit Pairing(RunComparison& runs) : runs_(runs) {
        for (const RunDrive& drive : runs.before.drives)
            old_.push_back(&drive);
        for (const RunDrive& drive : runs.now.drives)
            new_.push_back(&drive);
    }

    void run() {
        match([](const RunDrive& a, const RunDrive& b) {
            return a.drive == b.drive && a.lamp_set == b.lamp_set && a.technique == b.technique;
        });
        match([](const RunDrive& a, const RunDrive& b) { return a.drive == b.drive && a.lamp_set == b.lamp_set; });
        match([&](const RunDrive& a, const RunDrive& b) { return a.drive == b.drive && is_last(old_, a.drive) && is_last(new_, b.drive); });
        for (const auto& [left, others, run] : {std::tuple(&old_, &new_, 'A'), std::tuple(&new_, &old_, 'B')})
            for (const RunDrive* drive : *left) {
                const std::string told = std::ranges::find(*others, drive->drive, &RunDrive::drive) == others->end()
                                             ? fmt::format("{} is in {} alone", shown_name(*drive), run)
                                             : fmt::format("{} has the lamp sets {} in A and {} in B", drive->drive,
                                                           lamp_sets_of(runs_.before, drive->drive), lamp_sets_of(runs_.now, drive->drive));
                if (std::ranges::find(runs_.left_out, told) == runs_.left_out.end())
                    runs_.left_out.push_back(told);
            }
    }

  private:
    static std::string lamp_sets_of(const RunFolder& run, const std::string& drive) {
        std::vector<std::string> names;
        for (const RunDrive& played : run.drives)
            if (played.drive == drive && std::ranges::find(names, played.lamp_set) == names.end())
                names.push_back(printable(played.lamp_set));
        return fmt::format("{}", fmt::join(names, ", "));
    }
    static bool is_last(const std::vector<const RunDrive*>& left, const std::string& name) {
        return std::ranges::count(left, name, [](const RunDrive* drive) { return drive->drive; }) == 1;
    }

    void match(const auto& belongs) {
        for (std::size_t i = 0; i < old_.size();) {
            const auto found = std::ranges::find_if(new_, [&](const RunDrive* drive) { return belongs(*old_[i], *drive); });
            if (found == new_.end()) {
                ++i;
                continue;
            }
            add(*old_[i], **found);
            new_.erase(found);
            old_.erase(old_.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }

    void add(const RunDrive& before, const RunDrive& now) {
        if (const std::string why = why_another_route(before, now); !why.empty()) {
            runs_.left_out.push_back(fmt::format("{} has {} in B: its moments are other places", shown_name(before), why));
            return;
        }
        DriveComparison drive;
        drive.before = before;
        drive.now = now;
        drive.name = file_name_of(before.drive) + "_" + file_name_of(now.lamp_set);
        if (before.lamp_set != now.lamp_set)
            drive.name += "-against-" + file_name_of(before.lamp_set);
        drive.settings = settings_of(before, now);
        for (const auto& [path, hash] : now.hashes)
            if (const auto old = before.hashes.find(path); old != before.hashes.end() && old->second != hash)
                drive.new_bytes.push_back(path);
        runs_.drives.push_back(std::move(drive));
    }

    RunComparison& runs_;
    std::vector<const RunDrive*> old_, new_;
};

void add_key(std::string& text, const std::vector<YamlChange>& changes) {
    for (const YamlChange& change : changes)
        if (text.size() < 200)
            text += (text.empty() ? "" : ", ") + printable(change.key);
}

std::string text_in(const YamlValue& map, const char* key) {
    const YamlValue* value = member_of(map, key);
    return value ? value->text : "";
}

std::string hash_of(const RunDrive& drive, const std::string& path) {
    const auto found = drive.hashes.find(path);
    return found == drive.hashes.end() ? "" : found->second;
}

/// The file as the run read it. Throws InputError where it is gone, is another one by now, or needs more than the file to be read.
LampFile read_as_played(const RunDrive& drive, const YamlValue& lamp) {
    const std::filesystem::path path = text_in(lamp, "file");
    LampFile file = read_lamp(path, {.recipe = text_in(lamp, "recipe")});
    for (const FileRead& opened : file.opened)
        if (opened.xxh128 != hash_of(drive, opened.path.string()))
            throw InputError({opened.path, 0, 0, {}}, "is not the file any more that the run read");
    if (const std::string axis = text_in(lamp, "type_c_axis"); !axis.empty() && axis != "automatic")
        throw InputError({path, 0, 0, {}}, "was read with an axis of its own");
    return file;
}

} // namespace

void pair_drives(RunComparison& runs) { Pairing(runs).run(); }

MeasureChange measure_change(const YamlValue& before, const YamlValue& now) {
    MeasureChange out;
    const YamlValue *a = member_of(before, "measure"), *b = member_of(now, "measure");
    std::vector<YamlChange> changes;
    add_changes(a, b, "measure", changes);
    std::vector<YamlChange> extents, others;
    for (const YamlChange& change : changes) {
        if (change.key == "measure.extent.thresholds_lx" || change.key == "measure.extent.width_at_m")
            continue; // the readings' names say which
        (change.key.starts_with("measure.extent.") ? extents : others).push_back(change);
    }
    std::erase_if(others, [](const YamlChange& change) { // what one alone measures has no partner anyway
        return change.old_value.empty() || change.new_value.empty();
    });
    add_key(out.extent, extents);
    add_key(out.others, others);
    return out;
}

void compare_lamp_files(DriveComparison& drive) {
    const YamlValue *before = member_of(lamp_set_of(drive.before), "lamps"), *now = member_of(lamp_set_of(drive.now), "lamps");
    if (!before || !now)
        return;
    for (const YamlMember& lamp : now->members) {
        const YamlValue* other = member_of(*before, lamp.key);
        if (!other)
            continue;
        const std::string file = text_in(lamp.value, "file"), old_file = text_in(*other, "file");
        if (file.empty() || old_file.empty() || hash_of(drive.now, file) == hash_of(drive.before, old_file))
            continue;
        const auto same =
            std::ranges::find_if(drive.lamp_files, [&](const LampFilesDifference& d) { return d.now == file && d.before == old_file; });
        if (same != drive.lamp_files.end()) {
            same->lamps += ", " + lamp.key;
            continue;
        }
        try {
            const LampFile tested = read_as_played(drive.now, lamp.value), against = read_as_played(drive.before, *other);
            drive.lamp_files.push_back({lamp.key, old_file, file, difference_of(tested, against, 0.0)});
            plots::Figure figure = difference_figure(tested, against, drive.lamp_files.back().difference);
            drive.figures.push_back({fmt::format("lamps_{}_{}", drive.name, drive.lamp_files.size()), figure.title, figure});
        } catch (const InputError& error) {
            drive.left_out.push_back(fmt::format("the tables of the lamp {}, and their noise: {}", printable(lamp.key), error.what()));
        }
    }
}

} // namespace fernlicht
