#include "runner/judge/accepted_reference.h"

#include "runner/files/checked_json.h"
#include "runner/files/value_json.h"
#include "runner/judge/reference_json.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* schema = "fernlicht accepted results";

Json texts_json(const std::vector<std::pair<std::string, std::string>>& texts) {
    Json json = Json::object();
    for (const auto& [name, text] : texts)
        json[name] = text;
    return json;
}

/// What goes without saying is left out: of the whole drive, played once, no variance.
Json reading_json(const AcceptedReading& reading) {
    Json json{{"name", name_of(reading.key)}, {"unit", unit_of(reading.key)}, {"mean", value_json(reading.mean)}};
    if (reading.tick >= 0)
        json["frame"] = reading.tick;
    if (reading.count != (reading.mean.measured() ? 1 : 0))
        json["count"] = reading.count;
    if (reading.variance != 0.0)
        json["variance"] = reading.variance;
    return json;
}

std::string line_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

AcceptedReading read_reading(const CheckedJson& json) {
    AcceptedReading reading{key_with_unit(json), -1, value_in(json.at("mean")), 0, 0.0};
    reading.tick = json.has("frame") ? json.at("frame").whole() : -1;
    reading.count = json.has("count") ? json.at("count").whole() : reading.mean.measured() ? 1 : 0;
    reading.variance = json.has("variance") ? json.at("variance").number() : 0.0;
    if (reading.count < (reading.mean.measured() ? 1 : 0))
        json.at("count").refuse("1 or more of what was measured");
    if (reading.variance < 0.0)
        json.at("variance").refuse("0 or more");
    return reading;
}

} // namespace

Json key_json(const ReferenceKey& key) {
    return {{"drive", key.drive},     {"variant", key.variant},         {"technique", key.technique},
            {"backend", key.backend}, {"gl_renderer", key.gl_renderer}, {"simd", key.simd},
            {"inputs", key.inputs}};
}

ReferenceKey read_key(const CheckedJson& json) {
    return {json.at("drive").text(),       json.at("variant").text(), json.at("technique").text(), json.at("backend").text(),
            json.at("gl_renderer").text(), json.at("simd").text(),    json.at("inputs").text()};
}

std::string read_hash(const CheckedJson& json) {
    const std::string hash = json.text();
    if (hash.size() != 32 || hash.find_first_not_of("0123456789abcdef") != std::string::npos)
        json.refuse("32 hexadecimal digits");
    return hash;
}

bool same_results(const AcceptedReference& a, const AcceptedReference& b) {
    const auto same = [](const ReferenceFrame& x, const ReferenceFrame& y) {
        return x.tick == y.tick && x.view == y.view && x.xxh128 == y.xxh128;
    };
    return a.readings == b.readings && a.frames_left_out == b.frames_left_out && std::ranges::equal(a.frames, b.frames, same);
}

std::string reference_object(const AcceptedReference& reference) {
    const Producer& producer = reference.producer;
    const Json made_by{{"versions", texts_json(producer.versions)},
                       {"gl_version", producer.gl_version},
                       {"cpu", producer.cpu},
                       {"os", producer.os},
                       {"inputs", texts_json(producer.inputs)}};
    Json frames = Json::array();
    for (const ReferenceFrame& frame : reference.frames)
        frames.push_back({{"frame", frame.tick}, {"view", frame.view}, {"xxh128", frame.xxh128}});
    if (reference.frames_left_out)
        frames = nullptr;
    std::string text =
        fmt::format("{{\"schema\": {},\n\"schema_version\": 1,\n\"key\": {},\n\"producer\": {},\n\"frames\": {},\n\"readings\": [",
                    line_of(schema), line_of(key_json(reference.key)), line_of(made_by), line_of(frames));
    for (std::size_t i = 0; i < reference.readings.size(); ++i) // one a line, so that version control shows which differ
        text += (i == 0 ? "\n" : ",\n") + line_of(reading_json(reference.readings[i]));
    return text + "\n]}\n";
}

AcceptedReference read_reference_object(const std::filesystem::path& file) {
    const CheckedJson json = CheckedJson::read(file);
    json.expect_schema(schema, 1);
    AcceptedReference reference;
    reference.key = read_key(json.at("key"));
    const CheckedJson producer = json.at("producer");
    reference.producer = {producer.at("versions").texts(), producer.at("gl_version").text(), producer.at("cpu").text(),
                          producer.at("os").text(), producer.at("inputs").texts()};
    for (const CheckedJson& reading : json.at("readings").items())
        reference.readings.push_back(read_reading(reading));
    const CheckedJson frames = json.at("frames");
    reference.frames_left_out = frames.is_null();
    if (reference.frames_left_out)
        return reference;
    for (const CheckedJson& frame : frames.items())
        reference.frames.push_back({frame.at("frame").whole(), frame.at("view").text(), {}, read_hash(frame.at("xxh128"))});
    return reference;
}

} // namespace fernlicht
