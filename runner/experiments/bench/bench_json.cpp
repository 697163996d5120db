#include "runner/experiments/bench/bench_result.h"
#include "runner/files/clean_text.h"
#include "runner/files/json_text.h"
#include "runner/findings/context_json.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json machine_json(const BenchResult& result) {
    Json context = context_json(result.context);
    context["gl_vendor"] = result.gl_vendor;
    context["cores"] = result.cores;
    context["load_average_before"] = as_json(result.load_before);
    context["load_average_after"] = as_json(result.load_after);
    context["other_cores"] = as_json(result.others.cores);
    context["busiest_other"] =
        result.others.busiest.empty() ? Json(nullptr) : Json{{"process", result.others.busiest}, {"cores", result.others.busiest_cores}};
    return context;
}

Json settings_json(const BenchResult& result) {
    return {{"drive", result.drive},
            {"title", result.title},
            {"lamp_set", result.lamp_set},
            {"width_px", result.width_px},
            {"height_px", result.height_px},
            {"moments", as_json(result.moments, moment_members)},
            {"rounds_planned", result.rounds_planned},
            {"rounds_done", result.orders.size()},
            {"warm_up_plays_dropped", result.warm_up_plays},
            {"reference", reference_technique},
            {"lit_by", result.lit_by.empty() ? Json(nullptr) : Json(result.lit_by)}};
}

Json with_text(PairedRatio ratio) { return JsonPart(joined(ratio_members(ratio), JsonMembers{{"text", verdict_text(ratio)}})).write(); }

Json work_json(const Work& work) {
    return {{"passes", work.passes},
            {"draws", work.draws},
            {"calls", work.calls},
            {"samplers", work.samplers},
            {"shadow_maps", work.shadow_maps},
            {"lamps", work.lamps},
            {"triangles", work.triangles},
            {"fragments", work.fragments},
            {"texture_bytes", work.texture_bytes}};
}

Json technique_json(const BenchRow& row, const BenchResult& result) {
    const Technique& technique = row.benched->row;
    const TimingSamples& samples = row.benched->samples;
    Json out{{"technique", technique.name},
             {"thesis_row", technique.thesis_row > 0 ? Json(technique.thesis_row) : Json(nullptr)},
             {"thesis_fps", technique.thesis_fps.empty() ? Json(nullptr) : Json(technique.thesis_fps)},
             {"frames_per_s", row.frames_per_s()},
             {"frame_s", as_json(row.frame, spread_members)},
             {"frame_deviation_s", row.frame_deviation_s},
             {"frame_median_interval_s",
              row.frame_median
                  ? Json{{"low", row.frame_median->low}, {"high", row.frame_median->high}, {"confidence", row.frame_median->confidence}}
                  : Json(nullptr)},
             {"latency_s", as_json(row.latency, spread_members)},
             {"cpu_s", as_json(row.cpu, spread_members)},
             {"gpu_s", as_json(row.gpu, spread_members)}};
    if (!row.gpu)
        out["gpu_not_measured"] = result.gpu_not_measured;
    out["ratio"] = row.ratio ? with_text(*row.ratio) : Json(nullptr);
    out["work"] = row.work ? work_json(*row.work) : Json(nullptr);
    out["samples"] = {{"frame_s", samples.frame_s}, {"cpu_s", samples.cpu_s}, {"gpu_s", samples.gpu_s}, {"latency_s", samples.latency_s}};
    return out;
}

/// Every two techniques, the later in the table over the earlier.
Json comparisons_json(const std::vector<BenchRow>& rows) {
    Json out = Json::array();
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const auto ratio = paired_ratio(rows[i].benched->samples.frame_s, rows[k].benched->samples.frame_s);
            Json entry{{"technique", rows[i].benched->row.name}, {"against", rows[k].benched->row.name}};
            entry.update(with_text(ratio.value()));
            out.push_back(std::move(entry));
        }
    return out;
}

Json roofline_json(const Roofline& roofline) {
    Json ceilings = Json::array();
    for (const Roofline::Ceiling& ceiling : roofline.ceilings())
        ceilings.push_back({{"what", ceiling.what},
                            {"a_frame", ceiling.a_frame},
                            {"peak_per_cpu_s", ceiling.peak_per_s},
                            {"floor_cpu_s", ceiling.floor_s()}});
    return {{"pixels", roofline.light.pixels},
            {"threads", roofline.peaks.threads},
            {"lanes", packs::lanes_of(roofline.peaks.level)},
            {"light_cpu_s", roofline.light.cpu_s},
            {"floor_cpu_s", roofline.bound().floor_s()},
            {"bound", roofline.bound().what},
            {"ratio", roofline.ratio()},
            {"ceilings", std::move(ceilings)}};
}

} // namespace

JsonMembers ratio_members(PairedRatio& ratio) {
    return {{"rounds", ratio.rounds},
            {"median", ratio.median},
            {"p05", ratio.p05},
            {"p95", ratio.p95},
            {"verdict", one_of(ratio.difference, names_of<Difference>(difference_name, 3))}};
}

std::string bench_json(const BenchResult& result) {
    const std::vector<BenchRow> rows = summarise(result);
    Json techniques = Json::array(), orders = Json::array();
    for (const BenchRow& row : rows)
        techniques.push_back(technique_json(row, result));
    for (const auto& order : result.orders) {
        Json names = Json::array();
        for (const std::size_t i : order)
            names.push_back(result.techniques.at(i).row.name);
        orders.push_back(std::move(names));
    }
    return json_text(Json{{"schema", "fernlicht bench"},
                          {"schema_version", 2},
                          {"context", machine_json(result)},
                          {"interrupted", result.interrupted.empty() ? Json(nullptr) : Json(result.interrupted)},
                          {"warnings", bench_warnings(result)},
                          {"settings", settings_json(result)},
                          {"techniques", techniques},
                          {"comparisons", comparisons_json(rows)},
                          {"roofline", result.roofline ? roofline_json(*result.roofline) : Json(nullptr)},
                          {"roofline_not_measured", result.roofline ? Json(nullptr) : Json(result.roofline_not_measured)},
                          {"orders", orders}});
}

std::string bench_csv(const BenchResult& result) {
    std::string out = "technique,round,place,frame_s,cpu_s,gpu_s,latency_median_s\r\n";
    const std::size_t moments = result.moments.size();
    for (std::size_t i = 0; i < result.techniques.size(); ++i) {
        const TimingSamples& samples = result.techniques[i].samples;
        for (std::size_t round = 0; round < samples.frame_s.size(); ++round) {
            const auto& order = result.orders.at(round);
            const auto first = samples.latency_s.begin() + static_cast<std::ptrdiff_t>(round * moments);
            const Spread latency = spread_of({first, first + static_cast<std::ptrdiff_t>(moments)}).value();
            out += fmt::format("{},{},{},{},{},{},{}\r\n", csv_text(std::string(result.techniques[i].row.name)), round,
                               std::ranges::find(order, i) - order.begin(), samples.frame_s[round], samples.cpu_s[round],
                               samples.gpu_s.empty() ? "" : fmt::format("{}", samples.gpu_s[round]), latency.median);
        }
    }
    return out;
}

} // namespace fernlicht
