#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

void check_limit(const YamlMap& keys, const Limit& limit) {
    if (!limit.at_least && !limit.at_most)
        keys.entry().refuse("a limit without a number", "at_least, at_most or both");
    if (limit.at_least && limit.at_most && *limit.at_least > *limit.at_most)
        keys.entry().refuse(fmt::format("at_least {} above at_most {}", *limit.at_least, *limit.at_most), "a range that holds a value");
}

void check_tolerance(const YamlMap& keys, const Tolerance& tolerance) {
    const auto from = keys.find("from"), to = keys.find("to");
    if (from.has_value() != to.has_value())
        keys.refuse_missing(from ? "to" : "from", "both ends of an even distribution");
    if (from && (keys.find("sigma") || keys.find("mean")))
        from->refuse("from beside sigma or mean", "an even distribution from .. to, or a normal one");
    if (!from && !keys.find("sigma"))
        keys.refuse_missing("sigma", "it, 0 where all cars are alike, or from and to");
    if (from && *tolerance.from > *tolerance.to)
        from->refuse(fmt::format("from {} above to {}", *tolerance.from, *tolerance.to), "ends that ascend");
}

/// None of its values is larger.
Fields<Tolerance> tolerance_fields(double most) {
    return Fields<Tolerance>{
        field("sigma", 1, &Tolerance::sigma, range(0.0, most),
              "standard deviation of a normal distribution; 0: all are as the drive has it")
            .text_by([](const Tolerance& of) { return of.from ? std::string() : fmt::format("{}", of.sigma); }),
        field("mean", 2, &Tolerance::mean, range(-most, most), "its mean, from what the drive has").written_off_default(),
        field("from", 3, &Tolerance::from, range(-most, most), "an even distribution instead: between this,"),
        field("to", 4, &Tolerance::to, range(-most, most), "and this"),
        field("source", 5, &Tolerance::source, any(), "who states it; without one it is assumed").written_off_default(),
    }
        .checked(check_tolerance);
}

void check_tolerances(const YamlMap& keys, const ToleranceParameters& tolerances) {
    if (tolerances.cars > tolerances.draws)
        keys.entry().refuse(fmt::format("{} cars in full of {} drawn", tolerances.cars, tolerances.draws), "at most as many as draws");
    for (std::size_t i = 0; i < tolerances.limits.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (tolerances.limits[i].reading == tolerances.limits[k].reading)
                keys.require("limits").list(0, 100)[i].refuse("a second limit on " + tolerances.limits[i].reading, "one, with both ends");
}

} // namespace

const Fields<Limit>& limit_fields() {
    static const Fields<Limit> fields =
        Fields<Limit>{
            field("reading", 1, &Limit::reading, any(), "its name, as in readings.csv")
                .read_by([](const YamlEntry& entry, Limit& limit) {
                    limit.reading = entry.text();
                    limit.line = entry.value().line;
                })
                .required(),
            field("at_least", 2, &Limit::at_least, range(-1.0e12, 1.0e12), "in the reading's unit"),
            field("at_most", 3, &Limit::at_most, range(-1.0e12, 1.0e12), "in the reading's unit"),
        }
            .checked(check_limit)
            .in_schema(R"({"anyOf": [{"required": ["at_least"]}, {"required": ["at_most"]}]})");
    return fields;
}

const Fields<ToleranceParameters>& tolerances_fields() {
    using Given = ToleranceParameters;
    static const Fields<Given> fields =
        Fields<Given>{
            field("pitch_deg", 1, &Given::pitch_deg, tolerance_fields(5.0), "of each lamp; sigma 0.1 assumed").short_for("sigma"),
            field("yaw_deg", 2, &Given::yaw_deg, tolerance_fields(5.0), "of each lamp; sigma 0.1 assumed").short_for("sigma"),
            field("roll_deg", 3, &Given::roll_deg, tolerance_fields(5.0), "of each lamp about its axis; sigma 0.1 assumed")
                .short_for("sigma"),
            field("flux_percent", 4, &Given::flux_percent, tolerance_fields(50.0), "of each lamp; sigma 5 assumed").short_for("sigma"),
            field("height_mm", 5, &Given::height_mm, tolerance_fields(500.0), "of the car, all lamps; sigma 10 assumed").short_for("sigma"),
            field("load_kg", 6, &Given::load_kg, tolerance_fields(2000.0),
                  "over the rear axle since the lamps were aimed, in a drive with a vehicle; none assumed")
                .short_for("sigma"),
            list("limits", 7, &Given::limits, 0, 100, limit_fields(), "whose share of cars within is told, each and all together"),
            field("draws", 8, &Given::draws, range(100, 100'000), "cars drawn; each reading follows its slopes where these hold"),
            field("cars", 9, &Given::cars, range(20, 2000), "of these played in full: what slopes are held against"),
            field("rendered", 10, &Given::rendered, any(), "true: reach and width of the cars in full are drawn, which takes long")
                .written_off_default(),
            field("seed", 11, &Given::seed, range(0, 1'000'000'000), "of the draws").written_off_default(),
        }
            .block()
            .checked(check_tolerances);
    return fields;
}

} // namespace fernlicht
