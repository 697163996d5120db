#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/display/tone_mapper.h"
#include "scenarios/display/white_adaptation.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/fields/schema.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double max_s = 1.0e6, min_l_max_cdm2 = 1.0e-6, max_l_max_cdm2 = 1.0e9; // the GPU divides by it in float
constexpr std::size_t max_knots = 10000;
constexpr double white_apart = 0.01; // of l_max_cdm2 from the curve's last knot; a logarithm of two decimals is 0.005 off

ToneMapperKind kind_of(const void* mapper) { return static_cast<const ToneMapper*>(mapper)->kind; }
bool has_s(const void* mapper) { return kind_of(mapper) == ToneMapperKind::rational || kind_of(mapper) == ToneMapperKind::logarithmic; }
bool has_curve(const void* mapper) { return kind_of(mapper) == ToneMapperKind::histogram; }
bool has_white(const void*) { return true; }

/// A number that words may stand for, which were looked for before.
double number_beside_words(const YamlEntry& entry, double least, double greatest, std::string_view words) {
    try {
        return entry.number(least, greatest);
    } catch (const InputError&) {
        entry.refuse(fmt::format("a number from {:g} to {:g}, {}", least, greatest, words));
    }
}

void read_s(const YamlEntry& entry, ToneMapper& mapper) {
    mapper.fitted_s = entry.is_scalar() && entry.value().text == "fitted";
    if (mapper.fitted_s && mapper.kind != ToneMapperKind::rational)
        entry.refuse("'fitted'", "a number: only `kind: rational` has an s that is fitted");
    if (!mapper.fitted_s)
        mapper.s = number_beside_words(entry, 1.0, max_s, "or, with `kind: rational`, `fitted`");
}

std::string s_text(const ToneMapper& mapper) { return mapper.fitted_s ? "fitted" : fmt::format("{}", mapper.s); }

void read_white(const YamlEntry& entry, ToneMapper& mapper) {
    if (entry.is_scalar() && (entry.value().text == "all" || entry.value().text == "surfaces"))
        mapper.white = entry.value().text == "all" ? WhitePoint::all : WhitePoint::surfaces;
    else
        mapper.l_max_cdm2 =
            number_beside_words(entry, min_l_max_cdm2, max_l_max_cdm2,
                                "in cd/m2, `all` (the brightest of the drive) or `surfaces` (the brightest surface that emits no light)");
}

std::string white_text(const ToneMapper& mapper) {
    return mapper.white == WhitePoint::given ? fmt::format("{}", mapper.l_max_cdm2) : mapper.white == WhitePoint::all ? "all" : "surfaces";
}

/// Curve and white say the same: where both are given they must agree, and the last knot is moved to white, which the picture is tagged
/// with; a curve alone has its white from that knot.
void agree_on_white(const YamlEntry& curve, const std::optional<YamlEntry>& l_max, ToneMapper& mapper) {
    ToneKnot& last = mapper.curve.back();
    if (!(last.ln_luminance >= std::log(min_l_max_cdm2) && last.ln_luminance <= std::log(max_l_max_cdm2)))
        curve.refuse(fmt::format("a last knot at exp({:g}) cd/m2", last.ln_luminance),
                     fmt::format("white, from {:g} to {:g} cd/m2", min_l_max_cdm2, max_l_max_cdm2));
    const double knot_cdm2 = std::exp(last.ln_luminance);
    if (!l_max)
        mapper.l_max_cdm2 = std::clamp(knot_cdm2, min_l_max_cdm2, max_l_max_cdm2);
    else if (mapper.white != WhitePoint::given || !(std::abs(mapper.l_max_cdm2 - knot_cdm2) <= white_apart * knot_cdm2) ||
             !(std::log(mapper.l_max_cdm2) > mapper.curve[mapper.curve.size() - 2].ln_luminance))
        l_max->refuse(fmt::format("{} as white", l_max->is_scalar() ? l_max->value().text : "a list"),
                      fmt::format("the luminance of the curve's last knot, exp({:g}) = {:.4g} cd/m2, within {:g} %, or no l_max_cdm2",
                                  last.ln_luminance, knot_cdm2, 100.0 * white_apart));
    last.ln_luminance = std::log(mapper.l_max_cdm2);
}

void read_curve(const YamlEntry& entry, ToneMapper& mapper) {
    for (const YamlEntry& knot : entry.list(2, max_knots)) {
        const std::vector<double> at = knot.numbers(2, 2, -1.0e3, 1.0e3);
        if (!mapper.curve.empty() && !(at[0] > mapper.curve.back().ln_luminance && at[1] > mapper.curve.back().ln_share))
            knot.refuse("a knot that does not rise", "logarithms of luminance and share above those of the knot before");
        mapper.curve.push_back({at[0], at[1]});
    }
    if (mapper.curve.back().ln_share != 0.0)
        entry.refuse(fmt::format("a last share of exp({:g})", mapper.curve.back().ln_share), "0, white");
}

std::string curve_text(const ToneMapper& mapper) {
    std::string knots;
    for (const ToneKnot& knot : mapper.curve)
        knots += fmt::format("{}[{}, {}]", knots.empty() ? "" : ", ", knot.ln_luminance, knot.ln_share);
    return knots.empty() ? "" : "[" + knots + "]";
}

/// What keys of several kinds, and kinds of several keys, must agree on.
constexpr std::string_view mapper_schema = R"({"allOf": [
    {"not": {"required": ["kind", "s"], "properties": {"kind": {"enum": ["logarithmic"]}, "s": {"const": "fitted"}}}},
    {"not": {"required": ["curve", "l_max_cdm2"], "properties": {"l_max_cdm2": {"enum": ["all", "surfaces"]}}}},
    {"anyOf": [{"required": ["kind"]}, {"not": {"required": ["curve"]}}]}]})";
constexpr std::string_view s_schema = R"({"anyOf": [{"type": "number", "minimum": 1, "maximum": 1000000}, {"const": "fitted"}]})";
constexpr std::string_view white_schema =
    R"({"anyOf": [{"type": "number", "minimum": 1e-06, "maximum": 1000000000}, {"enum": ["all", "surfaces"]}]})";
constexpr std::string_view curve_schema = R"({"type": "array", "minItems": 2, "maxItems": 10000,
    "items": {"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "number"}}})";

bool has_gamma(const void* camera) { return static_cast<const CameraSettings*>(camera)->tone == TransferKind::gamma; }

const Fields<CameraSettings>& recording_camera_fields() {
    static const Fields<CameraSettings> fields{
        field("tone", 1, &CameraSettings::tone, words({"linear", "gamma", "srgb"}), "from the share of saturation to the code"),
        field("gamma", 2, &CameraSettings::gamma, range(0.1, 10.0), "of `tone: gamma`").heard_if(has_gamma),
        field("exposure_s", 3, &CameraSettings::exposure_s, above(0.0, 3600.0), "exposure time"),
        field("f_number", 4, &CameraSettings::f_number, range(0.5, 100.0), "of the lens"),
        field("iso", 5, &CameraSettings::iso, range(1.0, 1.0e7), "saturation-based speed, ISO 12232: 78 lx s over it saturate"),
        field("saturation_e", 6, &CameraSettings::saturation_e, range(0.0, 1.0e7),
              "electrons of a channel at saturation, at this speed; 0: no noise"),
        field("read_noise_e", 7, &CameraSettings::read_noise_e, range(0.0, 1.0e4), "standard deviation of reading, in electrons"),
        field("bloom", 8, &CameraSettings::bloom, range(0.0, 0.3), "share of the light that the lens turns by more than 2.5 degrees"),
    };
    return fields;
}

/// A camera has neither lens and retina nor a tone mapper of its own choice, and its codes are for sRGB. Resolved drives write the usual
/// tone mapper, which may stand beside it; `tone_mapper` is read before `display`.
void refuse_beside_camera(const YamlMap& keys, const Drive& drive) {
    const DisplaySettings& display = drive.display;
    const auto eye = keys.find("eye");
    if (!display.camera || !eye)
        return;
    const char* const beside = display.profile                        ? "profile"
                               : display.veil                         ? "eye.veil"
                               : display.night_colours                ? "eye.colours"
                               : display.night_sharpness              ? "eye.sharpness"
                               : display.adaptation                   ? "adaptation"
                               : !(drive.tone_mapper == ToneMapper{}) ? "tone_mapper"
                                                                      : nullptr;
    if (beside != nullptr)
        eye->refuse(fmt::format("a camera beside {}", beside), "one of the two: a camera stands in the place of eye and display");
}

const Fields<NightSky>& night_sky_fields() {
    static const Fields<NightSky> fields{
        field("zenith_cdm2", 1, &NightSky::zenith_cdm2, range(0.0, 1.0), "at the zenith, without moon and towns; dark sites have 0.00025"),
        field("extinction_mag", 2, &NightSky::extinction_mag, range(0.0, 5.0), "of the air above, magnitudes at the zenith"),
        named("towns", 3, &NightSky::towns, 64,
              Fields<Town>{
                  field("azimuth", 1, &Town::azimuth_rad, degrees_within("azimuth", 360.0), "from north over east"),
                  field("distance_km", 2, &Town::distance_km, range(1.0, 200.0), "to its middle; Walker's law was found from 10 to 50"),
                  field("inhabitants", 3, &Town::inhabitants, range(0.0, 1.0e8), "whose light glows above it"),
              },
              "that light the sky up"),
    };
    return fields;
}

constexpr double least_y = 0.01;

void read_chromaticity(const YamlEntry& entry, WhiteAdaptation& white) {
    const std::vector<double> xy = entry.numbers(2, 2, 0.0, 1.0);
    if (!(xy[1] >= least_y && xy[0] + xy[1] <= 1.0))
        entry.refuse(fmt::format("the chromaticity {}, {}", xy[0], xy[1]), "x and y of a light, CIE 1931: y from 0.01, x + y up to 1");
    if (!can_adapt_to({xy[0], xy[1]}))
        entry.refuse(fmt::format("the chromaticity {}, {}", xy[0], xy[1]),
                     "x and y of a light that all three receptors of CAT16 answer to");
    white.chromaticity = {xy[0], xy[1]};
}

std::string chromaticity_text(const WhiteAdaptation& white) {
    return white.chromaticity ? fmt::format("[{}, {}]", white.chromaticity->x, white.chromaticity->y) : "";
}

constexpr std::string_view chromaticity_schema =
    R"({"type": "array", "minItems": 2, "maxItems": 2, "items": {"type": "number", "minimum": 0, "maximum": 1}})";

} // namespace

const Fields<ToneMapper>& tone_mapper_fields() {
    using Mapper = ToneMapper;
    static const Fields<Mapper> fields =
        Fields<Mapper>{
            field("kind", 1, &Mapper::kind, words({"linear", "rational", "logarithmic", "histogram"}), "from luminance to what is shown"),
            own("s", 2, read_s, s_text, s_schema, "how steep; 1 is linear; fitted: by the drive's own pictures").heard_if(has_s),
            own("l_max_cdm2", 3, read_white, white_text, white_schema,
                "luminance that becomes white; all: the brightest of the drive; surfaces: the brightest surface that emits no light")
                .heard_if(has_white),
            own("curve", 4, read_curve, curve_text, curve_schema, "knots of ln luminance and ln share; the last is white")
                .heard_if(has_curve),
        }
            .in_schema(mapper_schema);
    return fields;
}

std::string tone_mapper_schema() {
    ToneMapper scratch;
    return fmt::format(R"({{"anyOf": [{}, {}]}})", schema_of(field_named(tone_mapper_fields(), "kind")),
                       schemas_by_word(tone_mapper_fields(), &scratch));
}

void read_tone_mapper(const YamlEntry& given, ToneMapper& mapper) {
    const Fields<ToneMapper>& fields = tone_mapper_fields();
    if (given.is_scalar()) {
        mapper.kind = static_cast<ToneMapperKind>(given.choice(field_named(fields, "kind").rule.words));
        return;
    }
    if (given.value().kind != YamlValue::Kind::map)
        given.refuse("linear, rational, logarithmic, histogram, or a map with keys such as kind and l_max_cdm2");
    const YamlMap keys = given.map(keys_of(fields));
    read_group(fields, keys, &mapper);
    if (const auto curve = keys.find("curve"))
        agree_on_white(*curve, keys.find("l_max_cdm2"), mapper);
}

const Fields<DisplaySettings>& display_fields() {
    using Display = DisplaySettings;
    static const Fields<Display> fields =
        Fields<Display>{
            field("profile", 1, &Display::profile_file, any(), "of a display, measured; docs/display.md").written_off_default(),
            field("windscreen", 2, &Display::windscreen,
                  Fields<Windscreen>{
                      field("transmittance", 1, &Windscreen::transmittance, range(0.01, 1.0), "of light; UN R43 asks for 0.7 at least"),
                      field("haze", 2, &Windscreen::haze, range(0.0, 0.3),
                            "share turned by more than 2.5 degrees; new 0.003, worn 0.01 to 0.03"),
                  },
                  "between road and eye"),
            section("eye", 3,
                    Fields<DisplaySettings>{
                        field("veil", 1, &DisplaySettings::veil,
                              Fields<EyeVeil>{
                                  field("age_years", 1, &EyeVeil::age_years, range(1.0, 120.0), "of the eye"),
                                  field("pigmentation", 2, &EyeVeil::pigmentation, range(0.0, 1.2),
                                        "0 black, 0.5 brown, 1 blue-green, 1.2 very light"),
                              },
                              "light scattered in the eye")
                            .or_flag(),
                        field("colours", 2, &DisplaySettings::night_colours, any(), "lost in the dark"),
                        field("sharpness", 3, &DisplaySettings::night_sharpness, any(), "lost in the dark"),
                        field("white", 4, &DisplaySettings::white,
                              Fields<WhiteAdaptation>{
                                  field("degree", 1, &WhiteAdaptation::degree, range(0.0, 1.0),
                                        "how far the eye adapts, 0 not at all; default: CIECAM16's D for a dark surround, 0.66 at night"),
                                  own("xy", 2, read_chromaticity, chromaticity_text, chromaticity_schema,
                                      "chromaticity of the light that it is adapted to; default: that of the drive's lamps and sky"),
                              },
                              "adaptation to the colour of the light; CAT16")
                            .written_off_default(),
                        field("camera", 5, &DisplaySettings::camera, recording_camera_fields(), "in the place of eye and tone mapper")
                            .or_flag(),
                    },
                    "what it does to the picture")
                .written_off_default(),
            field(
                "adaptation", 4, &Display::adaptation,
                Fields<ExposureAdaptation>{
                    field("brighter_s", 1, &ExposureAdaptation::brighter_s, range(1.0e-3, 3600.0), "time constant where it gets brighter"),
                    field("darker_s", 2, &ExposureAdaptation::darker_s, range(1.0e-3, 3600.0), "and darker"),
                },
                "white follows what the eye is adapted to")
                .or_flag(),
            field("sky", 5, &Display::sky, night_sky_fields(), "of a clear night, in pictures alone").or_flag(),
        }
            .block();
    return fields;
}

void read_display(const YamlEntry& given, Drive& drive) {
    const auto read_profile = [&](const YamlEntry& entry) {
        drive.display.profile_file = entry.path();
        drive.display.profile = read_display_profile(drive.display.profile_file, drive.opened);
    };
    if (given.is_scalar())
        return read_profile(given);
    const YamlMap keys = given.map(keys_of(display_fields()));
    if (const auto profile = keys.find("profile"))
        read_profile(*profile);
    read_group(display_fields(), keys, &drive.display);
    refuse_beside_camera(keys, drive);
}

} // namespace fernlicht
