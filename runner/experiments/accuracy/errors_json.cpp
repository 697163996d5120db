#include "runner/experiments/accuracy/errors_json.h"

#include "runner/findings/extent_keys.h"

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json quantiles_json(const ErrorQuantiles& q) { return {{"median", q.median}, {"p95", q.p95}, {"p99", q.p99}}; }

Json worst_json(const WorstPixel& worst, const std::vector<int>& frames) {
    return {{"error", worst.error},
            {"tested", worst.tested},
            {"reference", worst.reference},
            {"frame", frames.at(static_cast<std::size_t>(worst.picture))},
            {"x_px", worst.x},
            {"y_px", worst.y}};
}

} // namespace

Json errors_json(const std::optional<PixelErrors>& errors, const std::string& why_not, const std::vector<int>& frames) {
    if (!errors)
        return {{"not_measured", why_not.empty() ? "no pixel was compared" : why_not}};
    Json out{{"pixels", errors->pixels}, {"dark_pixels", errors->dark_pixels}};
    if (errors->pixels > 0) {
        out["relative"] = quantiles_json(errors->error);
        out["relative_floor"] = quantiles_json(errors->floor);
        out["mean"] = errors->mean;
        out["worst"] = worst_json(errors->worst, frames);
        if (errors->area_m2)
            out["area_m2"] = *errors->area_m2;
        out[errors->area_m2 ? "percent_of_area_beyond" : "percent_of_pixels_beyond"] = {
            {"1", errors->percent_beyond[0]}, {"5", errors->percent_beyond[1]}, {"20", errors->percent_beyond[2]}};
    }
    if (errors->dark_pixels > 0) {
        out["dark"] = quantiles_json(errors->dark_error);
        out["dark_floor"] = quantiles_json(errors->dark_floor);
        out["dark_worst"] = worst_json(errors->dark_worst, frames);
    }
    return out;
}

nlohmann::ordered_json reach_json(const std::vector<ReachError>& reach) {
    Json out = Json::array();
    for (const ReachError& error : reach) {
        Json entry{{"plane", plane_name(error.plane)}, {"limit_lx", error.limit_lx}, {"moments", error.moments}};
        if (error.why_not.empty())
            entry.update({{"median_m", error.median_m}, {"worst_m", error.worst_m}});
        else
            entry["not_measured"] = error.why_not;
        out.push_back(std::move(entry));
    }
    return out;
}

} // namespace fernlicht
