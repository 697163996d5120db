#include "runner/experiments/installation/installation_run.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

constexpr double deg_per_rad = 57.29577951308232;

std::string capacity_text(const CarCapacity& c) {
    return fmt::format("assumed: persons of {:g} kg; front seats {:.2f} m, {} rear seats {:.2f} m and the boot {:.2f} m behind the front "
                       "axle; permissible {:.0f} kg, on the rear axle {:.0f} kg; `--load` gives others",
                       c.person_kg, c.front_seats_m, c.rear_seats, c.rear_seats_m, c.boot_m, c.permissible_kg, c.permissible_rear_axle_kg);
}

std::vector<std::string> notes_of(const InstallationFound& found) {
    std::vector<std::string> notes{"loads: " + (found.capacity ? std::string(r48_loads_source) : "as given")};
    if (found.capacity)
        notes.push_back(capacity_text(*found.capacity));
    if (!found.own_vehicle)
        notes.push_back("assumed: the drive has no `vehicle`; our middle-class car stands in");
    notes.push_back("the aim is that of the car with its driver alone, R48's state of the initial inclination; loads come on top");
    if (!found.levelled)
        notes.push_back("the lamps have no levelling: R48 asks for an automatic one where the band is not kept without");
    notes.push_back("the height is the lamp's, where R48 has its lens's lower edge");
    notes.push_back(
        "bends: the circle that the car's centre of gravity is on in each moment; the kink looks from the car's middle, because "
        "from a place beside it every kink crosses the path far ahead in a slight bend, turned or not");
    notes.push_back(
        "for adaptive systems R48 (6.22.7.4.5) leaves out bends to the right in right-hand traffic, and to the left in left-hand "
        "traffic, of passing beams");
    return notes;
}

/// As people read it: "not met".
std::string in_words(InstallationVerdict verdict) {
    std::string words = name_of(verdict);
    std::ranges::replace(words, '_', ' ');
    return words;
}

/// Why a rule on the kink does not apply; "" where it does.
std::string why_not_applicable(const InstallationFound& found, const InstalledLamp& lamp, const KinkFound& kink) {
    if (found.kink(lamp, kink) != InstallationVerdict::not_applicable)
        return {};
    return lamp.moves() ? "no such bend while the lamp is lit" : "the lamp does not turn sideways";
}

std::string kink_text(const InstallationFound& found, const InstalledLamp& lamp, const KinkFound& kink) {
    const std::string why = why_not_applicable(found, lamp, kink);
    return in_words(found.kink(lamp, kink)) + (why.empty() ? "" : ": " + why);
}

std::string kink_text(const InstallationFound& found) {
    if (found.kink() != InstallationVerdict::not_applicable)
        return in_words(found.kink());
    const bool moves = std::ranges::any_of(found.lamps, &InstalledLamp::moves);
    return in_words(found.kink()) + (moves ? ": no bend while low beams are lit" : ": no low beam turns sideways");
}

Cell distance_cell(const std::optional<double>& distance_m) {
    return distance_m ? Cell(fmt::format("{:.1f}", *distance_m), *distance_m) : Cell("nowhere");
}

Table loads_table(const InstallationFound& found, const InstalledLamp& lamp) {
    Table table{
        "inclination-" + lamp.lamp, "", columns_of("load<|front [kg]|rear [kg]|body [deg]|levelling [deg]|cut-off [%]|verdict<"), {}};
    for (std::size_t i = 0; i < found.loads.size(); ++i) {
        const LoadState& load = found.loads[i];
        const LoadedBody& body = found.bodies[i];
        table.rows.push_back({load.name,
                              {fmt::format("{:.0f}", load.front_kg), load.front_kg},
                              {fmt::format("{:.0f}", load.rear_kg), load.rear_kg},
                              {fmt::format("{:+.2f}", deg_per_rad * body.pitch_rad), deg_per_rad * body.pitch_rad},
                              fmt::format("{:+.2f}{}", deg_per_rad * body.levelling_rad, body.at_stop ? " (its stop)" : ""),
                              lamp.percent.empty() ? Cell("") : Cell(fmt::format("{:+.2f}", lamp.percent[i]), lamp.percent[i]),
                              in_words(found.inclination(lamp, i))});
    }
    return table;
}

Table kinks_table(const InstallationFound& found) {
    Table table{
        "kink",
        "",
        columns_of("lamp<|bends<|moves by [deg]|crosses: farthest [m]|crosses: at [s]|crosses: median [m]|at most [m]|beyond [s]|of [s]|"
                   "from the lamp itself [m]|verdict<"),
        {}};
    for (const InstalledLamp& lamp : found.lamps)
        for (const auto& [bends, kink] : {std::pair("left", &lamp.left_bends), {"right", &lamp.right_bends}}) {
            std::vector<Cell> row{lamp.lamp, bends, {fmt::format("{:.2f}", kink->moved_deg), kink->moved_deg}};
            if (found.kink(lamp, *kink) == InstallationVerdict::not_applicable)
                row.insert(row.end(), 7, Cell(""));
            else
                row.insert(row.end(), {distance_cell(kink->distance_m),
                                       kink->distance_m ? Cell(fmt::format("{:.2f}", kink->at_s), kink->at_s) : Cell(""),
                                       distance_cell(kink->median_m), Cell(fmt::format("{:.0f}", lamp.kink_limit_m()), lamp.kink_limit_m()),
                                       Cell(fmt::format("{:.1f}", kink->beyond_s), kink->beyond_s),
                                       Cell(fmt::format("{:.1f}", kink->bends_s), kink->bends_s), distance_cell(kink->from_lamp_m)});
            row.emplace_back(kink_text(found, lamp, *kink));
            table.rows.push_back(std::move(row));
        }
    return table;
}

std::string band_text(const InstalledLamp& lamp) {
    std::string text = lamp.band ? fmt::format("{:+.2f} to {:+.2f} % for a height of {:.2f} m", lamp.band->lowest_percent,
                                               lamp.band->highest_percent, lamp.height_m)
                                 : "no band";
    text += ", by the " + lamp.by;
    return lamp.why_not.empty() ? text : text + "; " + lamp.why_not;
}

/// What leaves the band most, or comes nearest to its edge: ", left, all seats and the boot: -0.56 %"; or why nothing says so.
std::string worst_text(const InstallationFound& found) {
    if (found.inclination() == InstallationVerdict::not_measured)
        for (const InstalledLamp& lamp : found.lamps)
            if (found.inclination(lamp, 0) == InstallationVerdict::not_measured)
                return fmt::format(": {}: {}", lamp.lamp, lamp.why_not);
    double least = 1e9;
    std::string text;
    for (const InstalledLamp& lamp : found.lamps)
        for (std::size_t i = 0; lamp.band && i < lamp.percent.size(); ++i) {
            const double room = std::min(lamp.percent[i] - lamp.band->lowest_percent, lamp.band->highest_percent - lamp.percent[i]);
            if (room >= least)
                continue;
            least = room;
            text = fmt::format(", {}, {}: {:+.2f} %, {:.2f} {} its band", lamp.lamp, found.loads[i].name, lamp.percent[i], std::abs(room),
                               room < 0.0 ? "beyond" : "inside");
        }
    return text;
}

Json kink_json(const InstallationFound& found, const InstalledLamp& lamp, const KinkFound& kink) {
    Json j{{"verdict", name_of(found.kink(lamp, kink))}, {"beyond_s", kink.beyond_s}, {"of_s", kink.bends_s}};
    if (const std::string why = why_not_applicable(found, lamp, kink); !why.empty())
        j["why_not"] = why;
    if (kink.distance_m) {
        j["crosses_at_m"] = *kink.distance_m;
        j["at_s"] = kink.at_s;
        j["median_m"] = *kink.median_m;
    }
    if (kink.from_lamp_m)
        j["from_lamp_m"] = *kink.from_lamp_m;
    return j;
}

} // namespace

Document document(const InstallationFound& found) {
    Table facts{"facts", "", {{.head = "", .words = true}, {.head = "", .words = true}}, {}};
    facts.rows = {{"drive", found.drive + ", lamp set " + found.lamp_set},
                  {"by", "UN R48, 09 series, 6.2.6.1.2 and 6.2.6.4, by one published transcription"}};
    for (const std::string& warning : found.warnings)
        facts.rows.push_back({"warning", warning});
    for (const std::string& note : notes_of(found))
        facts.rows.push_back({"note", note});
    Document document{"Low beams on the car, modelled on UN R48", {{"", {facts}}}};
    for (const InstalledLamp& lamp : found.lamps)
        document.sections.push_back({"Inclination of " + lamp.lamp, {band_text(lamp), loads_table(found, lamp)}});
    if (found.kink() == InstallationVerdict::not_applicable)
        document.sections.push_back({"Bend light's kink", {kink_text(found)}});
    else
        document.sections.push_back({"Bend light's kink", {kinks_table(found)}});
    Table verdict{"verdict", "", {{.head = "", .words = true}, {.head = "", .words = true}}, {}};
    verdict.rows = {{"inclination", in_words(found.inclination()) + worst_text(found)}, {"kink", kink_text(found)}};
    document.sections.push_back({"Verdict; no approval", {verdict}});
    return document;
}

std::string installation_json(const InstallationFound& found) {
    Json loads = Json::array(), lamps = Json::array();
    for (std::size_t i = 0; i < found.loads.size(); ++i)
        loads.push_back({{"name", found.loads[i].name},
                         {"front_kg", found.loads[i].front_kg},
                         {"rear_kg", found.loads[i].rear_kg},
                         {"body_pitch_deg", deg_per_rad * found.bodies[i].pitch_rad},
                         {"levelling_deg", deg_per_rad * found.bodies[i].levelling_rad},
                         {"at_stop", found.bodies[i].at_stop}});
    for (const InstalledLamp& lamp : found.lamps) {
        Json one{{"lamp", lamp.lamp}, {"file", lamp.file}, {"height_m", lamp.height_m}, {"by", lamp.by}};
        if (!lamp.why_not.empty())
            one["why_not"] = lamp.why_not;
        if (lamp.band)
            one["band_percent"] = {lamp.band->lowest_percent, lamp.band->highest_percent};
        Json inclination = Json::array();
        for (std::size_t i = 0; i < found.loads.size(); ++i) {
            Json row{{"load", found.loads[i].name}, {"verdict", name_of(found.inclination(lamp, i))}};
            if (!lamp.percent.empty())
                row["percent"] = lamp.percent[i];
            inclination.push_back(row);
        }
        one["inclination"] = inclination;
        one["kink"] = {{"moved_deg", lamp.moved_deg},
                       {"at_most_m", lamp.kink_limit_m()},
                       {"left_bends", kink_json(found, lamp, lamp.left_bends)},
                       {"right_bends", kink_json(found, lamp, lamp.right_bends)}};
        lamps.push_back(one);
    }
    return Json{{"drive", found.drive},
                {"lamp_set", found.lamp_set},
                {"by", "UN R48, 09 series, 6.2.6.1.2 and 6.2.6.4"},
                {"warnings", found.warnings},
                {"notes", notes_of(found)},
                {"loads", loads},
                {"lamps", lamps},
                {"inclination", name_of(found.inclination())},
                {"kink", name_of(found.kink())}}
               .dump(2, ' ', false, Json::error_handler_t::replace) +
           "\n";
}

} // namespace fernlicht
