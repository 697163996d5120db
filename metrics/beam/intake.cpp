#include "metrics/beam/intake.h"

#include "metrics/beam/beam_outline.h"
#include "metrics/beam/cut_off.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Half of 0.23 D, the highest cut-off of any class (E and W of UN R123 and R149): nearer to the horizon none is meant to lie.
constexpr double highest_cut_off_deg = -0.115;
/// 2.5 % down: UN R48 (09 series, 6.2.6.1.2) has none lower than 2.1 % for lamps up to 0.9 m over the road.
constexpr double lowest_cut_off_deg = -1.43;
/// Of the elbow, which is aimed to V-V. It is found to 0.3 degrees.
constexpr double elbow_aside_deg = 2.0;
/// Least G of a cut-off (UN R112, R123, R149, and FMVSS 108 S10.18.9), found in files whose samples are close enough to show it.
constexpr double least_sharpness = 0.13, sharpness_step_deg = 0.1;
/// Of the two sides against each other; a rise of 15 degrees is 0.4 degrees high where the right side begins.
constexpr double clear_rise_deg = 0.3;
/// Luminous flux of the bare D1S and D2S, the strongest light sources of UN R99; of an LED headlamp's beam no more is known.
constexpr double most_flux_lm = 3200.0;
/// The maximum of a low beam lies below the cut-off and above 4 D, where UN R149 allows 0.8 of what 50R has at most; sideways not beyond
/// the lines at 9 degrees. That of a high beam is HV: 0.8 of it at least stand there.
constexpr double low_peak_aside_deg = 10.0, low_peak_down_deg = -4.5, low_peak_up_deg = 0.3;
constexpr double high_peak_aside_deg = 5.0, high_peak_up_deg = 3.0;
/// Beyond these angles a beam does not stand askew on its mount: the file counts its angles from elsewhere.
constexpr double other_axis_v_deg = 45.0, other_axis_h_deg = 60.0;
constexpr double concentrated = 0.5; ///< of the flux within 15 degrees of the peak: a beam; a lamp of 36 degrees between halves has 0.4
constexpr double on_its_side = 1.5;  ///< height over width; low beams have 0.2 to 0.5, high beams up to about 1
constexpr double dark_ahead = 0.15;  ///< of the peak: UN R149 allows 625 cd on HV, and asks for 5100 below
constexpr double bright_ahead = 0.5; ///< of the peak: UN R149 asks for 0.8 of it on HV
/// UN R149 asks for 5100 cd on 50R of its weakest car class; those of mopeds (UN R113) keep about a fifth of that.
constexpr double least_peak_cd = 1000.0;
/// What the weakest class of cars has: 50R of a low beam; of a high beam half the least maximum of UN R112's class A, as several may shine
/// together.
constexpr double weak_low_cd = 5100.0, weak_high_cd = 13500.0;
/// A quarter of the 1000 lm of H4's low beam, the weakest of such light sources: with more a weak maximum is a wide beam's.
constexpr double weak_lm = 250.0;
/// Of the flux of their light source, beams have 0.25 to 0.6. What is below this and comes into that range when multiplied by the thousands
/// of lumens of the source was listed per 1000 lm. Sources below 1200 lm are left alone: such factors do not show.
constexpr double least_share_of_source = 0.15, least_source_lm = 1200.0;
constexpr double plausible_share_from = 0.2, plausible_share_to = 0.9;
/// The directions that the tables of UN R149 ask for: lines to 20 degrees aside and 4 D, zones to 4 U; of high beams 12 degrees aside.
constexpr double low_asked_h_deg = 20.0, high_asked_h_deg = 12.0, asked_v_deg = 4.0;
constexpr double cut_share = 0.1, doubtful_cut_share = 0.03; ///< of the peak, where the table ends
/// Half a step is what a file leaves open of its cut-off's place: 0.1 degrees, by which studies tell what is real, and 0.25, all that UN
/// R149 lets a lamp be aimed anew.
constexpr double doubtful_step_deg = 0.2, coarse_step_deg = 0.5;

std::string place(double deg, const char* more, const char* less) {
    return fmt::format("{:.2f} {}", std::abs(deg), deg < 0.0 ? less : more);
}
std::string up_or_down(double deg) { return place(deg, "U", "D"); }
std::string direction_text(double h_deg, double v_deg) { return place(h_deg, "R", "L") + ", " + up_or_down(v_deg); }

/// The brightest within a degree to both sides of HV and a quarter of one up and down, over the peak.
double share_ahead(const CandelaTable& t, const Peak& peak) {
    double most = 0.0;
    for (double v = -0.25; v <= 0.25; v += 0.05)
        for (double h = -1.0; h <= 1.0; h += 0.1)
            most = std::max(most, intensity_cd(t, h, v));
    return peak.cd > 0.0 ? most / peak.cd : 0.0;
}

/// A lower edge above the horizon: what is below it would be a dark road.
bool is_upside_down(const BeamOutline& o) {
    const auto level = o.lower_level_deg();
    return level && *level > 0.0;
}

/// Less than a third of the maximum 15 degrees aside and 10 up and down: UN R149 asks a high beam for a twentieth 12 degrees aside.
bool is_narrow_ahead(const CandelaTable& t, const Peak& peak) {
    constexpr double third = 1.0 / 3.0;
    return std::max({intensity_cd(t, -15.0, 0.0), intensity_cd(t, 15.0, 0.0), intensity_cd(t, 0.0, -10.0), intensity_cd(t, 0.0, 10.0)}) <
           third * peak.cd;
}

BeamFunction recognised(const LampFile& lamp, const BeamOutline& o) {
    if (!(o.peak.cd > 0.0))
        return BeamFunction::other;
    if (!o.upper_edge.empty() || is_upside_down(o))
        return BeamFunction::low;
    const bool below = std::abs(o.peak.h_deg) <= low_peak_aside_deg && o.peak.v_deg >= low_peak_down_deg && o.peak.v_deg < -0.2;
    if (below && share_ahead(lamp.table, o.peak) <= dark_ahead)
        return BeamFunction::low;
    if (o.concentration >= concentrated || (share_ahead(lamp.table, o.peak) >= bright_ahead && is_narrow_ahead(lamp.table, o.peak)))
        return BeamFunction::high;
    return BeamFunction::other;
}

/// Low by a cut-off below the horizon, high by half the maximum straight ahead and no cut-off.
BeamFunction clear_function_of(const LampFile& lamp, const BeamOutline& o) {
    const BeamFunction by_light = recognised(lamp, o);
    const bool clear = by_light == BeamFunction::low    ? o.upper_level_deg().value_or(0.0) < 0.0
                       : by_light == BeamFunction::high ? share_ahead(lamp.table, o.peak) >= bright_ahead
                                                        : false;
    return clear ? by_light : BeamFunction::other;
}

struct IntakeCheck {
    const LampFile& lamp;
    const IntakeContext& context;
    const BeamOutline& outline;
    Intake& found;

    bool low() const { return found.function == BeamFunction::low; }
    const Peak& peak() const { return found.peak; }
    void claim(IntakeFault fault, bool meaningless, std::string text) { found.findings.push_back({fault, meaningless, std::move(text)}); }

    /// Of stated functions and of mounts, where the light is clearly that of the other beam.
    bool function() {
        const std::optional<BeamFunction> expected = context.function ? context.function : context.mount;
        const BeamFunction clear = clear_function_of(lamp, outline);
        if (!expected || *expected == BeamFunction::other || clear == BeamFunction::other || *expected == clear)
            return false;
        const bool is_low = clear == BeamFunction::low;
        claim(IntakeFault::function, true,
              fmt::format(
                  "it is {} by its light ({}), {} {}", is_low ? "a low beam" : "a high beam",
                  is_low ? "its cut-off lies below the horizon"
                         : fmt::format("no cut-off, and {:.0f} % of its maximum straight ahead", 100.0 * share_ahead(lamp.table, peak())),
                  context.function ? "and is stated to be" : "on the mount of", is_low ? "a high beam" : "a low beam"));
        return true;
    }

    bool axis() {
        const double h = peak().h_deg, v = peak().v_deg;
        const std::string type_c = " (type C and EULUMDAT: `--axis`, or `type_c_axis` in a drive)";
        if (std::abs(v) > other_axis_v_deg || std::abs(h) > other_axis_h_deg)
            claim(IntakeFault::axis, true,
                  fmt::format("its brightest direction is {}, and a headlamp points ahead: the file's angles count from elsewhere{}",
                              direction_text(h, v), type_c));
        else if (outline.height_to_width && *outline.height_to_width > on_its_side)
            claim(
                IntakeFault::axis, true,
                fmt::format("it is {:.1f} times as high as it is wide, and headlamps are wider than high: H and V are exchanged, or it is "
                            "turned about its axis by 90 degrees{}",
                            *outline.height_to_width, type_c));
        else if (is_upside_down(outline))
            claim(IntakeFault::axis, true,
                  fmt::format("it ends downwards at {} and has no upper edge: it stands upside down, V counts downwards in the file",
                              up_or_down(*outline.lower_level_deg())));
        return !found.findings.empty();
    }

    void cut_off() {
        if (!context.turned_up_deg)
            return;
        const std::string mounted = *context.turned_up_deg == 0.0 ? "" : ", as mounted";
        if (found.cut_off_v_deg) {
            const double step = found.step_deg.value_or(0.0), open = step >= coarse_step_deg ? step / 2.0 : 0.0;
            if (const double v = *found.cut_off_v_deg + *context.turned_up_deg; v - open > highest_cut_off_deg)
                claim(IntakeFault::cut_off_high, true,
                      fmt::format(
                          "the cut-off lies at {}{}, on the horizon or above, and 0.57 D is expected: `aim: auto` lowers it to there, "
                          "or `percent_down` by what you say",
                          up_or_down(v), mounted));
        } else if (const double ahead = share_ahead(lamp.table, peak()); found.function_stated && ahead >= bright_ahead)
            claim(IntakeFault::cut_off_high, true,
                  fmt::format("no cut-off is found below the horizon, and straight ahead lies {:.0f} % of the maximum: is it a high beam?",
                              100.0 * ahead));
    }

    /// Too low or aside, by what a mount makes better; where it makes it worse it is meant so.
    void aim() {
        if (!context.turned_up_deg || std::abs(peak().h_deg) > low_peak_aside_deg)
            return;
        std::string text;
        if (found.cut_off_v_deg && (found.elbow_h_deg || std::abs(found.rise_deg.value_or(0.0)) >= clear_rise_deg))
            if (const double v = *found.cut_off_v_deg + *context.turned_up_deg;
                std::max(v, *found.cut_off_v_deg) < lowest_cut_off_deg - found.step_deg.value_or(0.0) && peak().v_deg >= low_peak_down_deg)
                text = fmt::format("the cut-off lies at {}, and 0.57 D is expected", up_or_down(v));
        if (found.elbow_h_deg)
            if (const double h = *found.elbow_h_deg, mounted = h + context.turned_right_deg;
                std::min(std::abs(h), std::abs(mounted)) > elbow_aside_deg)
                text += fmt::format("{}the elbow lies at about {}, and it is aimed to V-V", text.empty() ? "" : "; ",
                                    fmt::format("{:.1f} {}", std::abs(mounted), mounted < 0.0 ? "L" : "R"));
        if (!text.empty())
            claim(IntakeFault::aim, false, text + ": `aim: auto` turns it to where it belongs");
    }

    void sharpness() {
        if (found.sharpness && *found.sharpness < least_sharpness)
            claim(IntakeFault::sharpness, false,
                  fmt::format("its cut-off is soft: G is {:.2f} where it is sharpest, and regulations ask for {:.2f} at least: averaged or "
                              "interpolated from coarser samples?",
                              *found.sharpness, least_sharpness));
    }

    void rise() {
        if (!found.rise_deg)
            return;
        const double expected = context.left_hand_traffic ? -*found.rise_deg : *found.rise_deg;
        if (expected < -std::max(clear_rise_deg, 0.6 * found.step_deg.value_or(0.0)))
            claim(IntakeFault::rise_side, true,
                  fmt::format("its cut-off rises to the {}, by {:.1f} degrees, and the road has {}-hand traffic: the lamp is for {}-hand "
                              "traffic, or the table is mirrored",
                              context.left_hand_traffic ? "right" : "left", std::abs(*found.rise_deg),
                              context.left_hand_traffic ? "left" : "right", context.left_hand_traffic ? "right" : "left"));
    }

    void flux() {
        if (found.flux_lm > most_flux_lm)
            claim(IntakeFault::flux, true,
                  fmt::format("it has {:.0f} lm, and a bare D2S has {:.0f}: no headlamp's beam has so much", found.flux_lm, most_flux_lm));
    }

    void peak_place() {
        if (!low() && share_ahead(lamp.table, peak()) >= bright_ahead)
            return;
        const double h = peak().h_deg, v = peak().v_deg + context.turned_up_deg.value_or(0.0);
        const bool aimed_by_cut_off = !context.turned_up_deg && found.cut_off_v_deg;
        const bool claimed_high =
            std::ranges::find(found.findings, IntakeFault::cut_off_high, &IntakeFinding::fault) != found.findings.end();
        const bool aside = std::abs(h) > (low() ? low_peak_aside_deg : high_peak_aside_deg);
        const bool too_high = !aimed_by_cut_off && v > (low() && !claimed_high ? low_peak_up_deg : high_peak_up_deg);
        const bool too_low = !aimed_by_cut_off && v < (low() ? low_peak_down_deg : -high_peak_up_deg);
        if (aside || too_high || too_low)
            claim(IntakeFault::peak, true,
                  fmt::format("its maximum lies at {}, where no {} beam has it: expected {}", direction_text(h, v), low() ? "low" : "high",
                              low()
                                  ? fmt::format("below the cut-off, not below 4 D, within {:.0f} degrees of V-V", low_peak_aside_deg)
                                  : fmt::format("within {:.0f} degrees of V-V and {:.0f} of H-H", high_peak_aside_deg, high_peak_up_deg)));
    }

    /// Where no other unit explains it.
    void weak() {
        const bool told = std::ranges::find(found.findings, IntakeFault::units, &IntakeFinding::fault) != found.findings.end();
        if (const double least = low() ? weak_low_cd : weak_high_cd;
            !told && peak().cd >= least_peak_cd && peak().cd < least && found.flux_lm < weak_lm) {
            claim(IntakeFault::units, false,
                  fmt::format(
                      "its maximum is {:.4g} cd and its flux {:.0f} lm, and car headlamps have {:.0f} cd and {:.0f} lm or more: wrong "
                      "by a factor, a moped's lamp, or one of several modules",
                      peak().cd, found.flux_lm, least, weak_lm));
        }
    }

    void units() {
        const std::optional<double> source = lamp.declared_flux_lm;
        const bool per_klm_format = lamp.format.starts_with("EULUMDAT"); // whose reader multiplies by the source's flux
        if (peak().cd < least_peak_cd) {
            claim(IntakeFault::units, true,
                  fmt::format("its maximum is {:.4g}, and headlamps have {:.0f} cd or more: the figures are no candela{}", peak().cd,
                              least_peak_cd, peak().cd >= 5.0 ? fmt::format(" (lux at 25 m? x 625 is {:.0f} cd)", 625.0 * peak().cd) : ""));
            return;
        }
        if (!source || per_klm_format)
            return;
        const double share = found.flux_lm / *source, per_klm_share = found.flux_lm / 1000.0;
        const bool plausible_per_klm = per_klm_share >= plausible_share_from && per_klm_share <= plausible_share_to;
        if (*source >= least_source_lm && share < least_share_of_source && plausible_per_klm)
            claim(IntakeFault::units, true,
                  fmt::format(
                      "it has {:.0f} lm, {:.0f} % of the {:.0f} lm that the file declares of its light source, and beams have 25 to 60: "
                      "the intensities are per 1000 lm of it, to be multiplied by {:.3g}",
                      found.flux_lm, 100.0 * share, *source, *source / 1000.0));
        else if (*source == 1000.0 && plausible_per_klm)
            claim(
                IntakeFault::units, false,
                "the file declares 1000 lm: its intensities are per 1000 lm of the light source, and are candela only of a source that has "
                "these, as the low beam of H4");
    }

    void coverage() {
        const CandelaTable& t = lamp.table;
        const double asked_h = low() ? low_asked_h_deg : high_asked_h_deg, aside = 0.01, inside = 1e-6;
        Peak cut;
        for (std::size_t y = 0; y < t.v_deg.size(); ++y)
            for (std::size_t x = 0; x < t.h_deg.size(); ++x) {
                const double h = t.h_deg[x], v = t.v_deg[y];
                if (t.at(y, x) <= cut.cd || std::abs(h) > asked_h - inside || std::abs(v) > asked_v_deg - inside)
                    continue;
                const std::array<Direction, 4> round{{{h - aside, v}, {h + aside, v}, {h, v - aside}, {h, v + aside}}};
                if (std::ranges::any_of(round, [&](Direction d) { return !has_data(t, d.h_deg, d.v_deg); }))
                    cut = {t.at(y, x), h, v};
            }
        if (const double share = cut.cd / peak().cd; share >= doubtful_cut_share)
            claim(
                IntakeFault::coverage, share >= cut_share,
                fmt::format("the table ends at {}, where it still has {:.0f} % of its maximum: the light beyond is missing, and tests look "
                            "{:.0f} degrees aside and {:.0f} up and down",
                            direction_text(cut.h_deg, cut.v_deg), 100.0 * share, asked_h, asked_v_deg));
    }

    void steps() {
        if (!low() || !found.step_deg)
            return;
        constexpr double rounding = 1e-6;
        if (*found.step_deg > doubtful_step_deg + rounding)
            claim(
                IntakeFault::steps, *found.step_deg >= coarse_step_deg - rounding,
                fmt::format("across the cut-off its samples lie {:.2g} degrees apart, which leaves the cut-off's place open by {:.2g}: at "
                            "most {:.1f} is expected",
                            *found.step_deg, *found.step_deg / 2.0, doubtful_step_deg));
    }
};

} // namespace

const char* name_of(IntakeFault fault) {
    static constexpr const char* names[]{"function",     "cut-off", "aim",      "rise",  "flux",      "peak",
                                         "type or axis", "units",   "coverage", "steps", "sharpness", "sides"};
    return names[static_cast<std::size_t>(fault)];
}

const char* name_of(BeamFunction function) {
    static constexpr const char* names[]{"low", "high", "other"};
    return names[static_cast<std::size_t>(function)];
}

BeamFunction clear_function(const LampFile& lamp) { return clear_function_of(lamp, outline_of(lamp)); }

Intake check_intake(const LampFile& lamp, const IntakeContext& context) {
    const BeamOutline outline = outline_of(lamp);
    Intake found;
    found.peak = outline.peak;
    found.flux_lm = outline.flux_lm;
    found.function_stated = context.function.has_value();
    found.function = context.function ? *context.function : recognised(lamp, outline);
    if (found.function == BeamFunction::other && !found.function_stated && context.mount)
        found.findings.push_back(
            {IntakeFault::function, false,
             fmt::format("its light is neither a low nor a high beam's, and it is on the mount of {}, so nothing else was checked",
                         *context.mount == BeamFunction::low ? "a low beam" : "a high beam")});
    if (found.function == BeamFunction::other || !(found.peak.cd > 0.0))
        return found;
    IntakeCheck check{lamp, context, outline, found};
    if (check.axis() || check.function())
        return found;
    if (check.low()) {
        found.cut_off_v_deg = outline.upper_level_deg();
        found.rise_deg = outline.rise_deg();
        found.elbow_h_deg = outline.elbow_h_deg();
        found.step_deg = step_in_v(lamp, {outline.middle_h_deg - 2.5, found.cut_off_v_deg.value_or(-0.57)});
        if (found.cut_off_v_deg) { // as `lamp --cut-off` has it, where it can be had
            const double v = *found.cut_off_v_deg, h = outline.middle_h_deg + (found.rise_deg.value_or(0.0) < 0.0 ? 2.5 : -2.5);
            found.cut_off_v_deg = vertical_scan({&lamp.table, {}}, h, v - 0.6, v + 0.6).inflection_deg.value_or(v);
            if (found.step_deg.value_or(1.0) <= sharpness_step_deg + 1e-6)
                for (const double aside : {-1.0, 0.0, 1.0})
                    if (const auto g = vertical_scan({&lamp.table, {}}, h + aside, v - 0.6, v + 0.6).sharpness)
                        found.sharpness = std::max(found.sharpness.value_or(0.0), *g);
        }
        check.cut_off();
        check.aim();
        check.sharpness();
        check.rise();
    }
    check.flux();
    check.peak_place();
    check.units();
    check.weak();
    check.coverage();
    check.steps();
    return found;
}

} // namespace fernlicht
