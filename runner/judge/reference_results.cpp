#include "runner/judge/reference_results.h"

#include "runner/files/checked_json.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr const char* description = "reference.json";
constexpr const char* picture = "reference.exr";

RunContext context_of(const CheckedJson& json) {
    RunContext context;
    context.versions = json.at("versions").texts();
    context.cpu = json.at("cpu").text();
    context.os = json.at("os").text();
    context.started_utc = json.at("started_utc").text();
    context.backend = "rays";
    for (const auto& [name, version] : context.versions)
        if (name == "Embree")
            context.gl_renderer = name + " " + version;
    return context;
}

/// What decides the light: files by content, moment, view, and of the settings all but seed, samples and error.
std::vector<std::pair<std::string, std::string>> inputs_of(const CheckedJson& json) {
    std::vector<std::pair<std::string, std::string>> inputs;
    for (const CheckedJson& file : json.at("context").at("inputs").items())
        inputs.emplace_back(fmt::format("file {}", inputs.size() + 1), file.at("xxh128").text());
    std::string picture_text = fmt::format("{} {} {} {}\n", json.at("view").text(), json.at("width_px").whole(),
                                           json.at("height_px").whole(), json.at("tick").whole());
    const CheckedJson settings = json.at("settings");
    for (const char* name : {"integrator", "max_bounces", "lamp_radius_m", "target_height_m", "shadows", "max_smooth", "solver"})
        picture_text += settings.at(name).dump() + "\n";
    inputs.emplace_back("picture", content_hash(picture_text.data(), picture_text.size()));
    return inputs;
}

} // namespace

bool is_reference_folder(const std::filesystem::path& folder) {
    std::error_code ignored;
    return std::filesystem::exists(folder / description, ignored) && !std::filesystem::exists(folder / "report.json", ignored);
}

Baseline read_ray_folder(const std::filesystem::path& folder) {
    const CheckedJson json = CheckedJson::read(folder / description);
    if (const CheckedJson schema = json.at("schema"); schema.text() != "fernlicht-reference")
        schema.refuse("fernlicht-reference");
    if (const CheckedJson version = json.at("version"); version.whole() != 2)
        version.refuse("version 2");
    if (const CheckedJson complete = json.at("complete"); !complete.truth())
        complete.refuse("a whole picture: `fernlicht reference --resume` goes on with it");
    const RunContext context = context_of(json.at("context"));
    Baseline baseline;
    std::vector<std::pair<std::string, std::string>> inputs = inputs_of(json);
    baseline.key = baseline_key(json.at("drive").text(), json.at("lamp_set").text(),
                                "reference-" + json.at("settings").at("integrator").text(), context, inputs);
    baseline.producer = {context.versions, "", context.cpu, context.os, std::move(inputs)};
    baseline.frames.push_back({json.at("tick").whole(), json.at("view").text(), folder / picture, ""});
    baseline.played_utc = context.started_utc;
    return baseline;
}

} // namespace fernlicht
