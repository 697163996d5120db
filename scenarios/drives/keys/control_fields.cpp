#include "scenarios/drives/keys/control_fields.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/schema.h"
#include "scenarios/vehicle/car_model.h"
#include "scenarios/yaml/yaml_tree.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

constexpr double shortest_period_s = 1.0e-4;
constexpr std::size_t max_windows = 256, max_variables = 1000;

template <bool is_fmu> void read_law_file(const YamlEntry& entry, PluginParameters& plugin) {
    plugin.library = entry.path();
    plugin.fmu = is_fmu;
    check_file(plugin.library, entry);
}
template <bool is_fmu> std::string law_file_text(const PluginParameters& of) {
    return of.fmu == is_fmu && !of.library.empty() ? quoted(of.library.string()) : "";
}

using VariableTexts = std::vector<std::pair<std::string, std::string>>;

/// By an FMU's names, which may hold anything.
void read_variables(const YamlEntry& entry, VariableTexts& texts, PluginPlaces& places) {
    places.maps.push_back({entry.file(), entry.value().line, entry.value().column, entry.key_path()});
    if (entry.is_scalar() || entry.is_list() || entry.value().members.empty() || entry.value().members.size() > max_variables)
        entry.refuse(fmt::format("a map of 1 to {} names", max_variables));
    for (const YamlMember& member : entry.value().members)
        texts.emplace_back(member.key, YamlEntry(member.value, entry.file(), fmt::format("{}.{}", entry.key_path(), member.key)).text());
}

std::string variables_text(const VariableTexts& texts) {
    std::vector<std::string> all;
    for (const auto& [name, text] : texts)
        all.push_back(fmt::format("{}: {}", quoted(name), quoted(text)));
    return all.empty() ? "" : fmt::format("{{{}}}", fmt::join(all, ", "));
}

template <VariableTexts PluginParameters::*member>
FieldOf<PluginParameters> variables(std::string_view key, int id, std::string_view meaning) {
    return own<PluginParameters>(
        key, id, [](const YamlEntry& entry, PluginParameters& plugin) { read_variables(entry, plugin.*member, plugin.places); },
        [](const PluginParameters& plugin) { return variables_text(plugin.*member); },
        R"({"type": "object", "minProperties": 1, "maxProperties": 1000, "additionalProperties": {"type": "string", "minLength": 1}})",
        meaning);
}

void check_plugin(const YamlMap& keys, const PluginParameters& plugin) {
    if (!keys.one_of({"library", "fmu"}))
        keys.refuse_missing("library", "a shared library, or fmu");
    if (plugin.fmu ? !plugin.parameters.empty() : !plugin.values.empty())
        keys.require("parameters").refuse(plugin.fmu ? "a map of the FMU's parameters" : "the library's own text");
    for (const char* const key : {"inputs", "outputs"})
        if (const auto given = keys.find(key); given && !plugin.fmu)
            given->refuse("names of variables beside a library", "fmu in its place");
}

void check_stuck_swivel(const YamlMap& keys, const StuckSwivelParameters& stuck) {
    if (!(stuck.off_rad > 0.0))
        keys.entry().refuse("an angle off that is not above 0", "off_deg above 0");
}

double from_kg(double kg) { return gravity_mps2 * kg; }
double from_n(double n) { return n; }
FieldRule load_of(const std::string& axle) { return units({axle + "_kg", from_kg, -2000.0, 5000.0}, {axle + "_n", from_n, -2.0e4, 5.0e4}); }

/// [a, b, c]: edges of two windows; [[a, b], ...]: windows that may leave gaps; pixels: those of its file.
void read_windows(const YamlEntry& given, SegmentedLamp& lamp) {
    if (given.is_scalar()) {
        given.choice({"pixels"});
        lamp.pixels = true;
        return;
    }
    std::vector<std::pair<double, double>>& windows = lamp.windows_deg;
    const std::vector<YamlEntry> items = given.list(1, max_windows + 1);
    if (items.front().is_list()) {
        for (const YamlEntry& item : items) {
            const std::vector<double> edges = item.numbers(2, 2, -180.0, 180.0);
            if (edges[0] >= edges[1] || (!windows.empty() && edges[0] < windows.back().second))
                item.refuse("windows that overlap or do not ascend", "[from, to], one after the other");
            windows.emplace_back(edges[0], edges[1]);
        }
        return;
    }
    const std::vector<double> edges = given.numbers(2, max_windows + 1, -180.0, 180.0);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        if (edges[i] >= edges[i + 1])
            given.refuse("edges that do not ascend", "degrees from left to right");
        windows.emplace_back(edges[i], edges[i + 1]);
    }
}

std::string windows_text(const SegmentedLamp& lamp) {
    if (lamp.pixels)
        return "pixels";
    std::vector<std::string> windows;
    for (const auto& [from, to] : lamp.windows_deg)
        windows.push_back(fmt::format("[{}, {}]", from, to));
    return fmt::format("[{}]", fmt::join(windows, ", "));
}

const Fields<LevellingParameters>& law_levelling_fields() {
    static const Fields<LevellingParameters> fields = [] {
        Fields<LevellingParameters> of = levelling_fields();
        for (Field& field : of.fields)
            if (field.group.get() == &actuator_fields())
                field.group = shared_group(law_actuator_fields());
        return of;
    }();
    return fields;
}

template <ControlFailure::Kind kind> bool is_failure(const void* failure) {
    return static_cast<const ControlFailure*>(failure)->kind == kind;
}

const Fields<std::pair<double, double>>& point_fields() {
    using Point = std::pair<double, double>;
    static const Fields<Point> fields{
        field("at_s", 1, &Point::first, range(0.0, 1.0e6), "from when; times ascend").required(),
        field("value", 2, &Point::second, range(-1.0e12, 1.0e12), "in the signal's unit").required(),
    };
    return fields;
}

const Fields<ScriptedSignal>& input_fields() {
    static const Fields<ScriptedSignal> fields =
        Fields<ScriptedSignal>{
            list("values", 1, &ScriptedSignal::values, 1, max_input_values, point_fields(), "")
                .schema_by(fmt::format(R"({{"anyOf": [{{"type": "number"}}, {{"type": "array", "minItems": 1, "items": {}}}]}})",
                                       schema_of(point_fields()))),
        }
            .bare();
    return fields;
}

} // namespace

const Fields<ActuatorParameters>& law_actuator_fields() {
    static const Fields<ActuatorParameters> fields = [] {
        Fields<ActuatorParameters> of = actuator_fields();
        std::erase_if(of.fields, [](const Field& field) { return field.key == "control_period_s"; });
        for (Field& field : of.fields)
            field.rule.degrees_where_exact = false;
        return of;
    }();
    return fields;
}

const Fields<BendParameters>& bend_fields() {
    using Bend = BendParameters;
    static const Fields<Bend> fields{
        field("law", 1, &Bend::law, words(bend_laws), "what says where the bend leads"),
        field("lamps", 2, &Bend::lamps, names(1, max_control_lamps), "all but those whose names have 'corner' by default"),
        field("preview_s", 3, &Bend::preview_s, range(0.0, 10.0), "the lamps look to where the car will be then"),
        field("gain", 4, &Bend::gain, range(0.0, 10.0), "on the angle"),
        field("filter_s", 5, &Bend::filter_s, range(0.0, 100.0), "time constant; 0: none"),
        field("dead_band", 6, &Bend::dead_band_rad, in_radians("dead_band", 45.0), "left out of the angle on both sides of 0"),
        field("from_speed", 7, &Bend::from_speed_mps, speed("from_speed"), "slower: straight ahead; all of the angle from twice as fast"),
        field("outer_share", 8, &Bend::outer_share, range(0.0, 1.0), "of the angle, for the lamp outside of the bend"),
        inlined(9, &Bend::actuator, law_actuator_fields()),
    };
    return fields;
}

const Fields<CorneringParameters>& cornering_fields() {
    using Cornering = CorneringParameters;
    static const Fields<Cornering> fields{
        field("left", 1, &Cornering::left, names(1, max_control_lamps), "lamps of that side").written_off_default(),
        field("right", 2, &Cornering::right, names(1, max_control_lamps), "lamps of that side").written_off_default(),
        field("until", 3, &Cornering::until_speed_mps, speed("until"), "faster: off"),
        field("again_below", 4, &Cornering::again_below_mps, speed("again_below"), "slower: on again"),
        field("on", 5, &Cornering::on_rad, in_radians("on", 60.0), "of the front wheels"),
        field("off", 6, &Cornering::off_rad, in_radians("off", 60.0), "of the front wheels"),
        field("fade_s", 7, &Cornering::fade_s, range(0.0, 100.0), "from off to on"),
    };
    return fields;
}

const Fields<BeamModeSettings>& mode_fields() {
    static const Fields<BeamModeSettings> fields{
        field("level", 1, &BeamModeSettings::level, range(0.0, 1.0), "of the class's lamps"),
        field("pitch", 2, &BeamModeSettings::pitch_rad, in_radians("pitch", 10.0), "added to the aim"),
        own<BeamModeSettings>(
            "file", 3, nullptr, [](const BeamModeSettings& mode) { return file_text(mode.file.get()); }, file_schema,
            "in place of the lamp's own"),
    };
    return fields;
}

template <std::size_t i> BeamModeSettings& settings_of(ModeParameters& modes) { return modes.settings[i]; }

const Fields<ModeParameters>& modes_fields() {
    using Modes = ModeParameters;
    static const Fields<Modes> fields =
        Fields<Modes>{
            field("lamps", 10, &Modes::lamps, names(1, max_control_lamps), "all but those whose names have 'corner' or 'high' by default"),
            field("c", 11, settings_of<0>, mode_fields(), "country"),
            field("v", 12, settings_of<1>, mode_fields(), "town"),
            field("e", 13, settings_of<2>, mode_fields(), "motorway"),
            field("w", 14, settings_of<3>, mode_fields(), "wet road"),
            field("v_below", 1, &Modes::v_below_mps, speed("v_below"), "town"),
            field("v_lit_below", 2, &Modes::v_lit_below_mps, speed("v_lit_below"), "town, where the road is lit"),
            field("v_lit_lx", 3, &Modes::v_lit_lx, range(0.0, 2.0e5), "what counts as lit"),
            field("e_above", 4, &Modes::e_above_mps, speed("e_above"), "motorway"),
            field("e_motorway_above", 5, &Modes::e_motorway_above_mps, speed("e_motorway_above"), "motorway, where the map says so"),
            field("w_wetness", 6, &Modes::w_wetness, range(1.0e-6, 1.0), "wet road from here on"),
            field("w_wipers_s", 7, &Modes::w_wipers_s, range(0.0, 1.0e6), "wet road after wiping so long"),
            field("hysteresis", 8, &Modes::hysteresis_mps, speed("hysteresis"), "to leave a class"),
            field("delay_s", 9, &Modes::delay_s, range(0.0, 1000.0), "a class is asked for so long before it comes"),
        }
            .block();
    return fields;
}

const Fields<HighBeamParameters>& high_beam_fields() {
    using High = HighBeamParameters;
    static const Fields<High> fields{
        field("lamps", 1, &High::lamps, names(1, max_control_lamps), "those whose names have 'high' by default"),
        field("on_above", 2, &High::on_above_mps, speed("on_above"), "faster: on"),
        field("off_below", 3, &High::off_below_mps, speed("off_below"), "slower: off"),
        field("dark_below_lx", 4, &High::dark_below_lx, range(0.0, 2.0e5), "darker: on"),
        field("lit_above_lx", 5, &High::lit_above_lx, range(0.0, 2.0e5), "lighter: off"),
        field("oncoming_m", 6, &High::oncoming_m, range(0.0, 5000.0),
              "oncoming road users nearer than this switch it off, or darken its windows"),
        field("preceding_m", 7, &High::preceding_m, range(0.0, 5000.0), "the same of those ahead"),
        field("on_delay_s", 8, &High::on_delay_s, range(0.0, 100.0), "until it comes on"),
        field("dip_delay_s", 9, &High::dip_delay_s, range(0.0, 100.0), "until it is off"),
        field("fade_s", 10, &High::fade_s, range(0.0, 100.0), "from off to on"),
    };
    return fields;
}

const Fields<GlareFreeParameters>& glare_free_fields() {
    using GlareFree = GlareFreeParameters;
    static const Fields<GlareFree> fields =
        Fields<GlareFree>{
            named("windows_deg", 4, &GlareFree::lamps, max_control_lamps,
                  Fields<SegmentedLamp>{own<SegmentedLamp>("windows", 1, read_windows, windows_text, R"({"anyOf": [{"const": "pixels"},
            {"type": "array", "minItems": 2, "maxItems": 257, "items": {"type": "number", "minimum": -180, "maximum": 180}},
            {"type": "array", "minItems": 1, "maxItems": 257, "items": {"type": "array", "minItems": 2, "maxItems": 2,
                "items": {"type": "number", "minimum": -180, "maximum": 180}}}]})",
                                                           "")}
                      .bare(),
                  "of each lamp: edges from left to right; pixels: those of a pixel lamp, each by itself")
                .required(),
            field("margin", 1, &GlareFree::margin_rad, in_radians("margin", 20.0), "to each side of other road users"),
            field("mask_delay_s", 2, &GlareFree::mask_delay_s, range(0.0, 100.0), "until a window goes dark"),
            field("relight_delay_s", 3, &GlareFree::relight_delay_s, range(0.0, 100.0), "until it is lit again"),
            field("foresee_s", 5, &GlareFree::foresee_s, range(0.0, 10.0),
                  "windows are dark, too, where others will be so much later, both cars going as they go now: to make up for delays"),
        }
            .block();
    return fields;
}

const Fields<ControlCameraParameters>& camera_fields() {
    using Camera = ControlCameraParameters;
    static const Fields<Camera> fields =
        Fields<Camera>{
            field("grade", 1, &Camera::grade, words({"good", "legal"}),
                  "how far it finds others: as makers say of theirs, or as far as it must"),
            field("oncoming_m", 2, &Camera::oncoming_m, range(0.0, 5000.0), "in place of the grade's 800 or 400"),
            field("preceding_m", 3, &Camera::preceding_m, range(0.0, 5000.0), "in place of 400 or 100"),
            field("bicycle_m", 4, &Camera::bicycle_m, range(0.0, 5000.0), "in place of 150 or 75"),
            field("field", 5, &Camera::field_rad, in_radians("field", 180.0), "from side to side"),
            field("rate_hz", 6, &Camera::rate_hz, range(0.1, 1000.0), "of its frames"),
            field("latency_s", 7, &Camera::latency_s, range(0.0, 10.0), "from a frame to what is told of it"),
            field("noise", 8, &Camera::noise_rad, in_radians("noise", 10.0), "standard deviation of a bearing, anew in each frame"),
            field("missed", 9, &Camera::missed, range(0.0, 1.0), "share of frames in which a road user is not found"),
            field("hides", 10, &Camera::hides, any(), "crests of the road and other vehicles hide those behind"),
            field("seed", 11, &Camera::seed, range(0, 1'000'000'000), "of what is missed and of the noise"),
        }
            .block();
    return fields;
}

const Fields<PluginParameters>& plugin_fields() {
    using Plugin = PluginParameters;
    static const Fields<Plugin> fields =
        Fields<Plugin>{
            own<Plugin>("library", 1, read_law_file<false>, law_file_text<false>, R"({"type": "string", "minLength": 1})",
                        "a shared library, relative to the drive file; or"),
            own<Plugin>("fmu", 7, read_law_file<true>, law_file_text<true>, R"({"type": "string", "minLength": 1})",
                        "an FMU for co-simulation (FMI 2.0 or 3.0)"),
            own<Plugin>(
                "parameters", 2,
                [](const YamlEntry& entry, Plugin& plugin) {
                    entry.is_scalar() ? void(plugin.parameters = entry.text()) : read_variables(entry, plugin.values, plugin.places);
                },
                [](const Plugin& plugin) { return plugin.parameters.empty() ? variables_text(plugin.values) : quoted(plugin.parameters); },
                R"({"anyOf": [{"type": ["string", "number"], "minLength": 1},
                {"type": "object", "minProperties": 1, "maxProperties": 1000, "additionalProperties": {"type": ["string", "number", "boolean"]}}]})",
                "text that the library is handed as it is; of an FMU start values of parameters and inputs, by name"),
            variables<&Plugin::inputs>("inputs", 8, "of an FMU whose names are others: its input and the signal that it reads"),
            variables<&Plugin::outputs>("outputs", 9, "likewise: its output and the command; lamp.*.level: of all lamps that it may move"),
            field("lamps", 3, &Plugin::lamps, names(1, max_control_lamps), "that it may move; all by default"),
            field("period_s", 4, &Plugin::period_s, range(shortest_period_s, 100.0),
                  "a whole number of control periods, or the next one after"),
            field("budget_s", 5, &Plugin::budget_s, range(1.0e-6, 100.0), "of a call; longer ones are counted"),
            field("give_up_s", 6, &Plugin::give_up_s, range(0.01, 3600.0), "a call that takes so long ends the run"),
        }
            .checked(check_plugin)
            .in_schema(R"({"oneOf": [{"required": ["library"], "not": {"anyOf": [{"required": ["inputs"]}, {"required": ["outputs"]}]},
                    "properties": {"parameters": {"type": ["string", "number"]}}},
                {"required": ["fmu"], "properties": {"parameters": {"type": "object"}}}]})");
    return fields;
}

const Fields<ControlFailure>& failure_fields() {
    using Failure = ControlFailure;
    static const Fields<Failure> fields{
        field("at_s", 1, &Failure::at_s, range(0.0, 1.0e6), "from when").required(),
        field("until_s", 2, &Failure::until_s, range(0.0, 1.0e6), "for good by default").written_off_default(),
        field("stuck_swivel", 3, &Failure::what, any(), "a lamp").heard_if(is_failure<Failure::Kind::stuck_swivel>),
        field("stuck_levelling", 4, &Failure::what, any(), "a lamp").heard_if(is_failure<Failure::Kind::stuck_levelling>),
        field("lost_signal", 5, &Failure::what, any(), "a signal").heard_if(is_failure<Failure::Kind::lost_signal>),
    };
    return fields;
}

const Fields<ControlParameters>& law_fields() {
    using Control = ControlParameters;
    static const Fields<Control> fields =
        Fields<Control>{
            field("period_s", 1, &Control::period_s, range(shortest_period_s, 10.0), "of the laws"),
            field("bend", 5, &Control::bend, bend_fields(), "lamps follow the bend").short_for("law"),
            field("levelling", 6, &Control::levelling, law_levelling_fields(), "lamps follow the body's pitch").short_for("control"),
            field("cornering", 7, &Control::cornering, cornering_fields(), "light into tight bends"),
            field("load", 2, &Control::load,
                  Fields<AxleLoad>{
                      field("front", 1, &AxleLoad::front_n, load_of("front"), "on that axle since the lamps were aimed"),
                      field("rear", 2, &AxleLoad::rear_n, load_of("rear"), "on that axle since the lamps were aimed"),
                  },
                  "weight added")
                .written_off_default(),
            field("modes", 13, &Control::modes, modes_fields(), "classes of the low beam, by speed, light and weather"),
            field("high_beam", 8, &Control::high_beam, high_beam_fields(), "automatic").or_word("automatic"),
            field("camera", 17, &Control::camera, camera_fields(), "by what laws know of other road users; exactly and at once by default")
                .short_for("grade"),
            field("glare_free", 9, &Control::glare_free, glare_free_fields(), "dark windows where other road users are"),
            list("plugins", 10, &Control::plugins, 0, max_plugins, plugin_fields(), "laws in shared libraries and FMUs")
                .written_off_default(),
            field("safe_pitch", 3, &Control::safe_pitch_rad, in_radians("safe_pitch", 10.0),
                  "of lamps whose levelling has lost its signal"),
            field("stuck_swivel", 4, &Control::stuck_swivel,
                  Fields<StuckSwivelParameters>{
                      field("off", 1, &StuckSwivelParameters::off_rad, in_radians("off", 45.0), "from what it is asked for"),
                      field("after_s", 2, &StuckSwivelParameters::after_s, range(0.0, 100.0), "for so long"),
                      field("pitch", 3, &StuckSwivelParameters::pitch_rad, in_radians("pitch", 10.0), "how low its lamp goes"),
                      field("level", 4, &StuckSwivelParameters::level, range(0.0, 1.0), "how dim, where nothing levels it"),
                  }
                      .checked(check_stuck_swivel),
                  "when a swivel is found stuck, and what then")
                .or_absent("none"),
            list("failures", 11, &Control::failures, 0, max_failures, failure_fields(), "what is wrong from when to when")
                .written_off_default(),
            named("inputs", 12, &Control::inputs, max_inputs, input_fields(), "signals that the drive writes"),
        }
            .block()
            .defined_as("control");
    return fields;
}

} // namespace fernlicht
