// What `lamp --against` finds: false alarms between two measurements of one lamp, and the changes it does not miss. Prints the tables of
// docs/lamps.md; fails where there are more false alarms, or more misses, than they promise. An argument: pairs of each kind (200).
#include "metrics/regulation/named_places.h"
#include "scenarios/lamps/lamp_model.h"
#include "tests/metrics/measured_lamps.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace {

using namespace fernlicht;
using measured::Kind;

constexpr double noises[]{0.005, 0.01, 0.02};
constexpr unsigned first_seed = 20040101;

/// A low beam in closed form: level cut-off at 0.57 D, rising by 15 degrees to the right, two hot spots.
double beam_cd(double h, double v) {
    const double edge = -0.57 + 0.268 * std::clamp(h, 0.0, 5.0);
    const double spread = 26000.0 * std::exp(-0.5 * (std::pow((h - 1.0) / 3.5, 2) + std::pow((v + 1.0) / 1.4, 2)));
    const double flood = 9000.0 * std::exp(-0.5 * (std::pow(h / 9.0, 2) + std::pow((v + 2.0) / 2.4, 2)));
    return 60.0 + (spread + flood) / (1.0 + std::exp((v - edge) / 0.12));
}

struct Change {
    double level = 0.0, aim_deg = 0.0, zone = 0.0;
};

constexpr double zone_h_deg = -4.0, zone_v_deg = -2.0;

/// How far from the zone's middle the 25th of the kind's samples lies.
double zone_radius(Kind kind, double step_deg) {
    const LampFile lamp = measured::lamp(kind, step_deg, beam_cd, {});
    const CandelaTable& own = SampledBeam(lamp).samples();
    std::vector<double> distances;
    for (const double v : own.v_deg)
        for (const double h : own.h_deg) {
            const TwoAngles d = lamp.measured ? lamp.measured->system.to_un(h, v) : TwoAngles{h, v};
            distances.push_back(std::hypot(d.h_deg - zone_h_deg, d.v_deg - zone_v_deg));
        }
    std::ranges::sort(distances);
    return distances[24] + 1e-6;
}

LampDifference compared(Kind kind, double step_deg, double noise, const Change& change, unsigned pair) {
    const double radius = change.zone != 0.0 ? zone_radius(kind, step_deg) : 0.0;
    const auto changed = [&](double h, double v) {
        const bool inside = std::hypot(h - zone_h_deg, v - zone_v_deg) <= radius;
        return beam_cd(h, v - change.aim_deg) * (1.0 + change.level) * (inside ? 1.0 - change.zone : 1.0);
    };
    const unsigned seed = first_seed + 1000000 * static_cast<unsigned>(kind) + static_cast<unsigned>(1e7 * noise) + 2 * pair;
    const LampFile a = measured::lamp(kind, step_deg, changed, {noise, seed}),
                   b = measured::lamp(kind, step_deg, beam_cd, {noise, seed + 1});
    return compare_by_name(a, b);
}

bool tells(const LampDifference& found, const Change& change) {
    if (change.level != 0.0)
        return found.level.has_value();
    if (change.aim_deg != 0.0)
        return found.aim_up_deg.has_value();
    return std::ranges::any_of(found.zones, [](const BeamZone& zone) {
        return zone.share < 0.0 && std::abs(zone.h_deg - zone_h_deg) < 2.0 && std::abs(zone.v_deg - zone_v_deg) < 2.0;
    });
}

/// Steps of a quarter, a half and a whole degree in turns. Named places that differ are among what is claimed.
bool false_alarms(unsigned pairs) {
    unsigned all = 0, most = 0;
    std::atomic<unsigned> places = 0, beyond_noise = 0, beyond_two = 0;
    fmt::print("| file | 0.5 % noise | 1 % | 2 % |\n|---|---|---|---|\n");
    for (const Kind kind : measured::kinds) {
        std::string row = fmt::format("| {} |", measured::name_of(kind));
        for (const double noise : noises) {
            std::atomic<unsigned> alarms = 0;
            tbb::parallel_for(0U, pairs, [&](unsigned pair) {
                static constexpr double steps[]{0.25, 0.5, 1.0};
                const LampDifference found = compared(kind, steps[pair % 3], noise, {}, pair);
                for (const PlaceChange& change : found.places)
                    if (change.change()) {
                        ++places;
                        beyond_noise += change.is_beyond_noise ? 1 : 0;
                        beyond_two += std::abs(*change.change()) > 2.0 * *change.uncertainty ? 1 : 0;
                    }
                if (found.any()) {
                    ++alarms;
                    fmt::print(stderr, "false alarm: {}, noise {}, pair {}, step {}: {}\n", measured::name_of(kind), noise, pair,
                               steps[pair % 3], sentences_of(found).front());
                }
            });
            row += fmt::format(" {} of {} |", alarms.load(), pairs);
            all += alarms;
            most = std::max(most, alarms.load());
        }
        fmt::print("{}\n", row);
        std::fflush(stdout);
    }
    fmt::print("\n{} false alarms in {} pairs; at most 4 in a cell and 24 in all are allowed\n\n", all, 12 * pairs);
    const double share = static_cast<double>(beyond_two) / static_cast<double>(std::max(places.load(), 1U));
    fmt::print("named places: {} of {} differ, none is allowed; {:.1f} % lie beyond two standard errors, at most 6 % are allowed\n\n",
               beyond_noise.load(), places.load(), 100.0 * share);
    return most <= 4 && all <= 24 && beyond_noise == 0 && share <= 0.06;
}

/// The smallest of these that 99 of 100 pairs tell; 0: none.
double smallest_told(Kind kind, double step_deg, double noise, double Change::*what, std::initializer_list<double> sizes) {
    for (const double size : sizes) {
        std::atomic<int> missed = 0;
        tbb::parallel_for(0U, 100U, [&](unsigned pair) {
            Change change;
            change.*what = size;
            if (missed <= 1 && !tells(compared(kind, step_deg, noise, change, 1000 + pair), change))
                ++missed;
        });
        if (missed <= 1)
            return size;
    }
    return 0.0;
}

bool power() {
    bool held = true;
    fmt::print("| file | step | noise | level | aim | 25 samples dimmer |\n|---|---|---|---|---|---|\n");
    for (const Kind kind : measured::kinds)
        for (const double step : {0.25, 0.5, 1.0})
            for (const double noise : noises) {
                const double level = smallest_told(kind, step, noise, &Change::level, {0.003, 0.01, 0.03, 0.1}),
                             aim = smallest_told(kind, step, noise, &Change::aim_deg, {0.02, 0.05, 0.1, 0.2, 0.5}),
                             zone = smallest_told(kind, step, noise, &Change::zone, {0.03, 0.05, 0.08, 0.12, 0.2, 0.4});
                const auto text = [](double value, double times, const char* unit) {
                    return value > 0.0 ? fmt::format("{:g} {}", value * times, unit) : std::string("more");
                };
                fmt::print("| {} | {:g} | {:g} % | {} | {} | {} |\n", measured::name_of(kind), step, 100.0 * noise, text(level, 100.0, "%"),
                           text(aim, 1.0, "deg"), text(zone, 100.0, "%"));
                std::fflush(stdout);
                const auto within = [](double value, double asked) { return value > 0.0 && value <= asked; };
                held = held && (step > 0.25 || (within(level, 0.03) && within(aim, 0.1) && within(zone, 0.05)));
            }
    return held;
}

} // namespace

int main(int argc, char** argv) {
    const int pairs = argc > 1 ? std::atoi(argv[1]) : 200;
    const bool few_alarms = false_alarms(static_cast<unsigned>(std::max(pairs, 3))), few_misses = argc > 1 || power();
    return few_alarms && few_misses ? 0 : 1;
}
