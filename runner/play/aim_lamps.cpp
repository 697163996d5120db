#include "runner/play/aim_lamps.h"

#include "metrics/regulation/installed_aim.h"
#include "scenarios/traffic/road_user.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <utility>

namespace fernlicht {
namespace {

bool is_high(const MountedLamp& lamp) { return function_of(lamp.name) == LampFunction::high; }

/// Each table is looked through once.
class Marks {
  public:
    const AimMark& of(const LampFile& file, bool high_beam) {
        const std::pair key(&file, high_beam);
        auto known = marks_.find(key);
        if (known == marks_.end())
            known = marks_.emplace(key, aim_mark(file.table, high_beam)).first;
        return known->second;
    }

  private:
    std::map<std::pair<const LampFile*, bool>, AimMark> marks_;
};

std::string told(const LampFile& file) { return printable(file.opened.empty() ? file.name : file.opened.front().path.string(), 400); }

void align(std::vector<MountedLamp>& lamps, std::vector<LampChange>& changes, Marks& marks, const std::filesystem::path& file,
           const std::string& key) {
    for (MountedLamp& lamp : lamps) {
        if (lamp.aim_rule != BeamAim::automatic)
            continue;
        const auto alignment = [&](const AimMark& mark) { return turn_within(lamp.mount, turn_to(mark, lamp.cut_off_percent)); };
        const AimMark& mark = marks.of(*lamp.file, is_high(lamp));
        if (!mark.v_deg)
            throw InputError({file, 0, 0, fmt::format("{}.{}.aim", key, lamp.name)},
                             fmt::format("found auto, and nothing to aim by in {}: {}", told(*lamp.file), mark.why_not),
                             "as-is, or the file of a beam with a cut-off");
        lamp.aligned = alignment(mark);
        for (LampChange& change : changes)
            if (change.lamp == lamp.name && change.file)
                if (const AimMark& other = marks.of(*change.file, is_high(lamp)); other.v_deg)
                    change.aligned = alignment(other);
    }
}

LampAim aim_as_it_is(const MountedLamp& lamp, double from_s, Marks& marks) {
    LampAim aim;
    aim.lamp = lamp.name;
    aim.file = lamp.file->name;
    aim.from_s = from_s;
    const AimMark& mark = marks.of(*lamp.file, is_high(lamp));
    aim.automatic = lamp.aim_rule == BeamAim::automatic;
    if (aim.automatic)
        aim.cut_off_percent = lamp.cut_off_percent;
    aim.high_beam = mark.high_beam;
    aim.height_m = lamp.position_m.z;
    aim.by = mark.by;
    aim.why_not = mark.why_not;
    const Turn turned = turn_of(axes_from_angles(-lamp.mount.yaw_rad, 0.0, 0.0) * lamp.pose().axes);
    aim.turned_up_deg = degrees(turned.pitch_rad);
    aim.turned_right_deg = 0.0 - degrees(turned.yaw_rad);
    if (is_low_beam(lamp))
        if (const auto band = r48_band(aim.height_m)) {
            aim.band_lowest_percent = band->lowest_percent;
            aim.band_highest_percent = band->highest_percent;
        }
    if (!mark.v_deg)
        return aim;
    aim.file_up_deg = mark.v_deg;
    aim.file_right_deg = mark.h_deg;
    aim.up_bound_deg = mark.bound.v_deg;
    aim.right_bound_deg = mark.bound.h_deg;
    const MarkOnCar on_car = mark_on_car(lamp, mark.place());
    aim.percent = on_car.percent;
    if (mark.h_deg)
        aim.right_deg = on_car.right_deg;
    const InclinationBand band{aim.band_lowest_percent.value_or(0.0), aim.band_highest_percent.value_or(0.0)};
    if (aim.band_lowest_percent && !band.holds(*aim.percent))
        aim.warning = fmt::format(
            "the cut-off lies at {:+.2f} %, and {} has it between {:.2f} and {:.2f} % for lamps {:.2f} m over the road{}", *aim.percent,
            r48_band_source, band.highest_percent, band.lowest_percent, aim.height_m, aim.automatic ? "" : "; `aim: auto` would aim it");
    return aim;
}

} // namespace

bool is_low_beam(const MountedLamp& lamp) {
    return function_of(lamp.name) == LampFunction::low && lamp.name.find("corner") == std::string::npos;
}

void aim_lamps(Drive& drive) {
    Marks marks;
    for (LampSet& lamp_set : drive.lamp_sets)
        align(lamp_set.lamps, lamp_set.changes, marks, drive.file, fmt::format("lamp_sets.{}.lamps", lamp_set.name));
    for (TrafficRow& row : drive.traffic_rows)
        align(row.lamps, row.changes, marks, drive.file, fmt::format("traffic.{}.lamps", row.name));
}

std::vector<LampAim> lamp_aims(const LampSet& lamp_set) {
    Marks marks;
    std::vector<LampAim> aims;
    for (MountedLamp lamp : lamp_set.lamps) {
        std::vector<LampAim> of_lamp{aim_as_it_is(lamp, 0.0, marks)};
        for (const LampChange& change : lamp_set.changes) {
            if (change.lamp != lamp.name)
                continue;
            const auto before = lamp.file;
            apply(change, lamp);
            if (lamp.file == before)
                continue;
            LampAim later = aim_as_it_is(lamp, change.time_s, marks);
            const auto is_same = [&](LampAim known) {
                known.from_s = later.from_s;
                return known == later;
            };
            if (std::ranges::none_of(of_lamp, is_same))
                of_lamp.push_back(std::move(later));
        }
        std::ranges::move(of_lamp, std::back_inserter(aims));
    }
    return aims;
}

} // namespace fernlicht
