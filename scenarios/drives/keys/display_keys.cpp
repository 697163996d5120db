#include "scenarios/drives/keys/display_keys.h"

#include "scenarios/display/tone_mapper.h"
#include "scenarios/values/errors.h"
#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double most_s = 1.0e6, least_l_max_cdm2 = 1.0e-6, most_l_max_cdm2 = 1.0e9; // the GPU divides by it in float
constexpr std::size_t most_knots = 10000;
constexpr double white_apart = 0.01; // of l_max_cdm2 from the curve's last knot; a logarithm of two decimals is 0.005 off

bool has_s(ToneMapperKind kind) { return kind == ToneMapperKind::rational || kind == ToneMapperKind::logarithmic; }
bool has_curve(ToneMapperKind kind) { return kind == ToneMapperKind::histogram; }
bool any_tone_mapper(ToneMapperKind) { return true; }

/// A key and the tone mappers that hear it.
struct ToneKey {
    std::string_view key;
    bool (*heard_by)(ToneMapperKind);
};
constexpr ToneKey tone_keys[] = {{"s", has_s}, {"l_max_cdm2", any_tone_mapper}, {"curve", has_curve}};

void refuse_tone_keys_without_effect(const YamlMap& keys, ToneMapperKind kind) {
    std::string heard = "kind";
    for (const ToneKey& row : tone_keys)
        if (row.heard_by(kind))
            heard += fmt::format(", {}", row.key);
    for (const ToneKey& row : tone_keys)
        if (const auto given = keys.find(row.key); given && !row.heard_by(kind))
            given->refuse(fmt::format("a key that kind '{}' does not use", name(kind)), fmt::format("none but {}", heard));
}

ToneMapperKind read_tone_kind(const YamlEntry& entry) {
    static constexpr ToneMapperKind kinds[] = {ToneMapperKind::linear, ToneMapperKind::rational, ToneMapperKind::logarithmic,
                                               ToneMapperKind::histogram};
    return kinds[entry.choice({"linear", "rational", "logarithmic", "histogram"})];
}

/// A number that words may stand for, which were looked for before.
double number_beside_words(const YamlEntry& entry, double least, double greatest, std::string_view words) {
    try {
        return entry.number(least, greatest);
    } catch (const InputError&) {
        entry.refuse(fmt::format("a number from {:g} to {:g}, {}", least, greatest, words));
    }
}

void read_white(const YamlEntry& entry, ToneMapper& mapper) {
    if (entry.is_scalar() && (entry.value().text == "all" || entry.value().text == "surfaces"))
        mapper.white = entry.value().text == "all" ? WhitePoint::all : WhitePoint::surfaces;
    else
        mapper.l_max_cdm2 = number_beside_words(entry, least_l_max_cdm2, most_l_max_cdm2,
                                                "in cd/m2, `all` (the brightest of the drive) or `surfaces` (of what does not shine)");
}

/// Curve and white say the same: where both are given they must agree, and the last knot is moved to white, which the picture is tagged
/// with; a curve alone has its white from that knot.
void agree_on_white(const YamlEntry& curve, const std::optional<YamlEntry>& l_max, ToneMapper& mapper) {
    ToneKnot& last = mapper.curve.back();
    if (!(last.ln_luminance >= std::log(least_l_max_cdm2) && last.ln_luminance <= std::log(most_l_max_cdm2)))
        curve.refuse(fmt::format("a last knot at exp({:g}) cd/m2", last.ln_luminance),
                     fmt::format("white, from {:g} to {:g} cd/m2", least_l_max_cdm2, most_l_max_cdm2));
    const double knot_cdm2 = std::exp(last.ln_luminance);
    if (!l_max)
        mapper.l_max_cdm2 = std::clamp(knot_cdm2, least_l_max_cdm2, most_l_max_cdm2);
    else if (mapper.white != WhitePoint::given || !(std::abs(mapper.l_max_cdm2 - knot_cdm2) <= white_apart * knot_cdm2) ||
             !(std::log(mapper.l_max_cdm2) > mapper.curve[mapper.curve.size() - 2].ln_luminance))
        l_max->refuse(fmt::format("{} as white", l_max->is_scalar() ? l_max->value().text : "a list"),
                      fmt::format("the luminance of the curve's last knot, exp({:g}) = {:.4g} cd/m2, within {:g} %, or no l_max_cdm2",
                                  last.ln_luminance, knot_cdm2, 100.0 * white_apart));
    last.ln_luminance = std::log(mapper.l_max_cdm2);
}

void read_curve(const YamlEntry& entry, const std::optional<YamlEntry>& l_max, ToneMapper& mapper) {
    for (const YamlEntry& knot : entry.list(2, most_knots)) {
        const std::vector<double> at = knot.numbers(2, 2, -1.0e3, 1.0e3);
        if (!mapper.curve.empty() && !(at[0] > mapper.curve.back().ln_luminance && at[1] > mapper.curve.back().ln_share))
            knot.refuse("a knot that does not rise", "logarithms of luminance and share above those of the knot before");
        mapper.curve.push_back({at[0], at[1]});
    }
    if (mapper.curve.back().ln_share != 0.0)
        entry.refuse(fmt::format("a last share of exp({:g})", mapper.curve.back().ln_share), "0, white");
    agree_on_white(entry, l_max, mapper);
}

Windscreen read_windscreen(const YamlEntry& entry) {
    Windscreen screen;
    const YamlMap keys = entry.map({"transmittance", "haze"});
    screen.transmittance = keys.number_or("transmittance", screen.transmittance, 0.01, 1.0);
    screen.haze = keys.number_or("haze", screen.haze, 0.0, 0.3);
    return screen;
}

EyeVeil read_veil(const YamlEntry& entry) {
    EyeVeil veil;
    if (entry.is_scalar() && entry.flag())
        return veil;
    const YamlMap keys = entry.map({"age_years", "pigmentation"});
    veil.age_years = keys.number_or("age_years", veil.age_years, 1.0, 120.0);
    veil.pigmentation = keys.number_or("pigmentation", veil.pigmentation, 0.0, 1.2);
    return veil;
}

} // namespace

ToneMapper read_tone_mapper(const YamlMap& drive) {
    ToneMapper mapper;
    const auto given = drive.find("tone_mapper");
    if (!given)
        return mapper;
    if (given->is_scalar()) {
        mapper.kind = read_tone_kind(*given);
        return mapper;
    }
    if (given->value().kind != YamlValue::Kind::map)
        given->refuse("linear, rational, logarithmic, histogram, or a map with keys such as kind and l_max_cdm2");
    const YamlMap keys = given->map({"kind", "s", "l_max_cdm2", "curve"});
    if (const auto kind = keys.find("kind"))
        mapper.kind = read_tone_kind(*kind);
    refuse_tone_keys_without_effect(keys, mapper.kind);
    if (const auto s = keys.find("s")) {
        mapper.fitted_s = s->is_scalar() && s->value().text == "fitted";
        if (mapper.fitted_s && mapper.kind != ToneMapperKind::rational)
            s->refuse("'fitted'", "a number: only `kind: rational` has an s that is fitted");
        if (!mapper.fitted_s)
            mapper.s = number_beside_words(*s, 1.0, most_s, "or, with `kind: rational`, `fitted`");
    }
    const auto l_max = keys.find("l_max_cdm2");
    if (l_max)
        read_white(*l_max, mapper);
    if (const auto curve = keys.find("curve"))
        read_curve(*curve, l_max, mapper);
    return mapper;
}

DisplaySettings read_display(const YamlMap& drive, FilesRead& opened) {
    DisplaySettings display;
    const auto given = drive.find("display");
    if (!given)
        return display;
    const auto read_profile = [&](const YamlEntry& entry) {
        display.profile_file = entry.path();
        display.profile = read_display_profile(display.profile_file, opened);
    };
    if (given->is_scalar()) {
        read_profile(*given);
        return display;
    }
    const YamlMap keys = given->map({"profile", "windscreen", "eye", "adaptation"});
    if (const auto profile = keys.find("profile"))
        read_profile(*profile);
    if (const auto windscreen = keys.find("windscreen"))
        display.windscreen = read_windscreen(*windscreen);
    if (const auto eye = keys.find("eye")) {
        const YamlMap parts = eye->map({"veil", "colours", "sharpness"});
        if (const auto veil = parts.find("veil"); veil && !(veil->is_scalar() && !veil->flag()))
            display.veil = read_veil(*veil);
        display.night_colours = parts.flag_or("colours", false);
        display.night_sharpness = parts.flag_or("sharpness", false);
    }
    if (const auto adaptation = keys.find("adaptation"); adaptation && !(adaptation->is_scalar() && !adaptation->flag())) {
        display.adaptation = ExposureAdaptation{};
        if (!adaptation->is_scalar()) {
            const YamlMap times = adaptation->map({"brighter_s", "darker_s"});
            display.adaptation->brighter_s = times.number_or("brighter_s", display.adaptation->brighter_s, 1.0e-3, 3600.0);
            display.adaptation->darker_s = times.number_or("darker_s", display.adaptation->darker_s, 1.0e-3, 3600.0);
        }
    }
    return display;
}

std::string write_tone_mapper(const ToneMapper& mapper) {
    const std::string s = !has_s(mapper.kind) ? "" : mapper.fitted_s ? ", s: fitted" : fmt::format(", s: {}", mapper.s);
    const std::string white = mapper.white == WhitePoint::given ? fmt::format("{}", mapper.l_max_cdm2)
                              : mapper.white == WhitePoint::all ? "all"
                                                                : "surfaces";
    std::string curve;
    for (const ToneKnot& knot : mapper.curve)
        curve += fmt::format("{}[{}, {}]", curve.empty() ? "" : ", ", knot.ln_luminance, knot.ln_share);
    return fmt::format("tone_mapper: {{kind: {}{}, l_max_cdm2: {}{}}}\n", name(mapper.kind), s, white,
                       curve.empty() ? "" : fmt::format(", curve: [{}]", curve));
}

std::string write_display(const DisplaySettings& display) {
    if (!display.after_drawing())
        return {};
    std::string text = "display:\n";
    if (display.profile)
        text += fmt::format("  profile: {}\n", quoted(display.profile_file.string()));
    if (display.windscreen)
        text += fmt::format("  windscreen: {{transmittance: {}, haze: {}}}\n", display.windscreen->transmittance, display.windscreen->haze);
    if (display.veil || display.night_colours || display.night_sharpness) {
        const std::string veil =
            display.veil ? fmt::format("veil: {{age_years: {}, pigmentation: {}}}, ", display.veil->age_years, display.veil->pigmentation)
                         : "";
        text += fmt::format("  eye: {{{}colours: {}, sharpness: {}}}\n", veil, display.night_colours, display.night_sharpness);
    }
    if (display.adaptation)
        text +=
            fmt::format("  adaptation: {{brighter_s: {}, darker_s: {}}}\n", display.adaptation->brighter_s, display.adaptation->darker_s);
    return text;
}

} // namespace fernlicht
