#include "runner/judge/baseline.h"

#include "runner/judge/baseline_json.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* schema = "fernlicht baseline";

/// What goes without saying is left out: of the whole drive, played once, no variance.
JsonMembers reading_members(AcceptedReading& reading) {
    return joined({{"name", reading.key}, {"unit", unit_of(reading.key)}, {"mean", reading.mean}},
                  when(reading.tick >= 0, {{"frame", reading.tick}}),
                  when(reading.count != (reading.mean.measured() ? 1 : 0), {{"count", reading.count}}),
                  when(reading.variance != 0.0, {{"variance", reading.variance}}));
}

JsonMembers frame_members(BaselineFrame& frame) {
    return {{"frame", frame.tick}, {"view", frame.view}, {"xxh128", hash_part(frame.xxh128)}};
}

std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

AcceptedReading read_reading(const CheckedJson& json) {
    key_with_unit(json);
    auto reading = from_json<AcceptedReading>(json, reading_members);
    reading.count = json.has("count") ? reading.count : reading.mean.measured() ? 1 : 0;
    if (reading.count < (reading.mean.measured() ? 1 : 0))
        json.at("count").refuse("1 or more of what was measured");
    if (reading.variance < 0.0)
        json.at("variance").refuse("0 or more");
    return reading;
}

} // namespace

JsonMembers key_members(BaselineKey& key) {
    return {{"drive", key.drive},     {"lamp_set", key.lamp_set},       {"technique", key.technique},
            {"backend", key.backend}, {"gl_renderer", key.gl_renderer}, {"simd", key.simd},
            {"inputs", key.inputs}};
}

JsonMembers producer_members(Producer& producer) {
    return {{"versions", producer.versions},
            {"gl_version", producer.gl_version},
            {"cpu", producer.cpu},
            {"os", producer.os},
            {"inputs", producer.inputs}};
}

JsonPart hash_part(std::string& hash) {
    JsonPart part = json_leaf(hash);
    part.read = [&hash](const CheckedJson& json) {
        hash = json.text();
        if (hash.size() != 32 || hash.find_first_not_of("0123456789abcdef") != std::string::npos)
            json.refuse("32 hexadecimal digits");
    };
    return part;
}

bool same_results(const Baseline& a, const Baseline& b) {
    const auto same = [](const BaselineFrame& x, const BaselineFrame& y) {
        return x.tick == y.tick && x.view == y.view && x.xxh128 == y.xxh128;
    };
    return a.readings == b.readings && a.frames_left_out == b.frames_left_out && std::ranges::equal(a.frames, b.frames, same);
}

std::string baseline_object(const Baseline& baseline) {
    const Json frames = baseline.frames_left_out ? Json(nullptr) : as_json(baseline.frames, frame_members);
    std::string text = fmt::format(
        "{{\"schema\": {},\n\"schema_version\": 1,\n\"key\": {},\n\"producer\": {},\n\"frames\": {},\n\"readings\": [", line_of(schema),
        line_of(as_json(baseline.key, key_members)), line_of(as_json(baseline.producer, producer_members)), line_of(frames));
    for (std::size_t i = 0; i < baseline.readings.size(); ++i) // one a line, so that version control shows which differ
        text += (i == 0 ? "\n" : ",\n") + line_of(as_json(baseline.readings[i], reading_members));
    return text + "\n]}\n";
}

Baseline read_baseline_object(const std::filesystem::path& file) {
    const CheckedJson json = CheckedJson::read(file);
    json.expect_schema(schema, 1);
    Baseline baseline;
    baseline.key = from_json<BaselineKey>(json.at("key"), key_members);
    baseline.producer = from_json<Producer>(json.at("producer"), producer_members);
    for (const CheckedJson& reading : json.at("readings").items())
        baseline.readings.push_back(read_reading(reading));
    const CheckedJson frames = json.at("frames");
    baseline.frames_left_out = frames.is_null();
    if (!baseline.frames_left_out)
        baseline.frames = from_json<std::vector<BaselineFrame>>(frames, frame_members);
    return baseline;
}

} // namespace fernlicht
