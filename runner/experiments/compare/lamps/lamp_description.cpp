#include "runner/experiments/compare/lamps/lamp_description.h"

#include "runner/findings/plots/isocandela.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

std::pair<double, double> finest_and_coarsest(const std::vector<double>& axis) {
    if (axis.size() < 2)
        return {0.0, 0.0};
    double finest = axis[1] - axis[0], coarsest = finest;
    for (std::size_t i = 1; i < axis.size(); ++i) {
        finest = std::min(finest, axis[i] - axis[i - 1]);
        coarsest = std::max(coarsest, axis[i] - axis[i - 1]);
    }
    return {finest, coarsest};
}

/// The table as cells, with the question whether one holds data; outside the table it does not.
struct Cells {
    const CandelaTable& t;
    std::size_t columns() const { return t.h_deg.size() - 1; }
    std::size_t rows() const { return t.v_deg.size() - 1; }
    bool gap(std::size_t row, std::size_t column) const { return !t.gaps.empty() && t.gaps[row * columns() + column] != 0; }
    bool wraps() const { return t.h_deg.back() - t.h_deg.front() >= 360.0 - 1e-9; }
};

/// Whether sample (v, h) borders on something unknown. The poles and the seam of a table that wraps round border on nothing.
bool at_edge(const Cells& cells, std::size_t v, std::size_t h) {
    const CandelaTable& t = cells.t;
    const bool seam = h == 0 || h == cells.columns();
    const bool end = v == 0 || v == cells.rows();
    if ((seam && !cells.wraps()) || (end && std::abs(t.v_deg[v]) < 90.0))
        return true;
    for (std::size_t row = v == 0 ? 0 : v - 1; row <= std::min(v, cells.rows() - 1); ++row)
        for (std::size_t column = h == 0 ? 0 : h - 1; column <= std::min(h, cells.columns() - 1); ++column)
            if (cells.gap(row, column))
                return true;
    return false;
}

void measure_coverage(const CandelaTable& t, LampDescription& d) {
    const Cells cells{t};
    for (std::size_t row = 0; row < cells.rows(); ++row) {
        const double band = std::sin(radians(t.v_deg[row + 1])) - std::sin(radians(t.v_deg[row]));
        for (std::size_t column = 0; column < cells.columns(); ++column) {
            if (cells.gap(row, column))
                ++d.gap_cells;
            else
                d.covered_share += band * radians(t.h_deg[column + 1] - t.h_deg[column]) / (4.0 * pi);
        }
    }
    for (std::size_t v = 0; v < t.v_deg.size(); ++v)
        for (std::size_t h = 0; h < t.h_deg.size(); ++h)
            if (t.at(v, h) > d.edge_cd && at_edge(cells, v, h))
                d.edge_cd = t.at(v, h);
}

const char* rule_name(BetweenSamples rule) { return rule == BetweenSamples::linear_cd ? "linear in cd" : "linear in log cd"; }

void add_line(std::string& out, const char* key, const std::string& value) { out += fmt::format("{:<14} {}\n", key, value); }

std::string flux_text(const LampDescription& d) {
    std::string text = fmt::format("{:.1f} lm by integration", d.flux_lm);
    if (!d.declared_flux_lm)
        return text + "; the file declares none";
    text += fmt::format("; the file declares {:.6g} lm of its light source", *d.declared_flux_lm);
    if (*d.declared_flux_lm > 0.0)
        text += fmt::format(" ({:.1f} %)", 100.0 * d.flux_lm / *d.declared_flux_lm);
    return text;
}

std::string edge_text(const LampDescription& d) {
    if (d.covered_share > 1.0 - 1e-9)
        return "nothing: the table covers every direction";
    if (d.edge_cd <= 1e-9 * d.peak.cd) // rounding of resampled angles
        return "no light, and nothing is lost: intensity is 0 all along the table's edges";
    return fmt::format("taken as 0; at the edges the table still has up to {:.4g} cd ({:.3g} % of the peak)", d.edge_cd,
                       100.0 * d.edge_cd / d.peak.cd);
}

std::string interpolation_text(const InterpolationError& e) {
    if (e.samples == 0)
        return "not measured: too few samples or no light";
    return fmt::format("median {:.2g} %, p95 {:.2g} %, worst {:.2g} % of the peak at H {:.4g}, V {:.4g} ({} samples predicted)",
                       100.0 * e.median_relative, 100.0 * e.p95_relative, 100.0 * e.worst_relative, e.worst_h_deg, e.worst_v_deg,
                       e.samples);
}

void add_spots(std::string& out, const SpotFit& fit, double peak_cd) {
    if (fit.spots.empty()) {
        add_line(out, "spot lights", "none: no light to the front");
        return;
    }
    add_line(out, "spot lights",
             fmt::format("{} fitted; they leave over {:.1f} % (L2), {:.2g} % of the peak (rms where lit)", fit.spots.size(),
                         100.0 * fit.relative_l2, 100.0 * fit.rms_of_peak));
    add_line(out, "",
             fmt::format("worst {:.3g} % of the peak at H {:.4g}, V {:.4g}; {:.1f} lm for {:.1f} lm", 100.0 * fit.worst_of_peak,
                         fit.worst_h_deg, fit.worst_v_deg, fit.flux_lm, fit.table_flux_lm));
    for (const Spot& spot : fit.spots)
        add_line(out, "",
                 fmt::format("H {:6.2f}, V {:6.2f}: {:.5g} cd ({:.3g} % of the peak), exponent {:.4g}, cut-off {:.4g} degrees", spot.h_deg,
                             spot.v_deg, spot.cd, 100.0 * spot.cd / peak_cd, spot.exponent, spot.cutoff_deg));
}

nlohmann::ordered_json spots_json(const SpotFit& fit) {
    nlohmann::ordered_json spots = nlohmann::ordered_json::array();
    for (const Spot& spot : fit.spots)
        spots.push_back(
            {{"h_deg", spot.h_deg}, {"v_deg", spot.v_deg}, {"cd", spot.cd}, {"exponent", spot.exponent}, {"cutoff_deg", spot.cutoff_deg}});
    return {{"relative_l2", fit.relative_l2},     {"rms_of_peak", fit.rms_of_peak},
            {"worst_of_peak", fit.worst_of_peak}, {"worst_h_deg", fit.worst_h_deg},
            {"worst_v_deg", fit.worst_v_deg},     {"flux_lm", fit.flux_lm},
            {"table_flux_lm", fit.table_flux_lm}, {"spots", spots}};
}

nlohmann::ordered_json coverage_json(const LampDescription& d) {
    return {{"h_from_deg", d.h_from_deg},
            {"h_to_deg", d.h_to_deg},
            {"v_from_deg", d.v_from_deg},
            {"v_to_deg", d.v_to_deg},
            {"h_samples", d.h_samples},
            {"v_samples", d.v_samples},
            {"h_finest_deg", d.h_finest_deg},
            {"h_coarsest_deg", d.h_coarsest_deg},
            {"v_finest_deg", d.v_finest_deg},
            {"v_coarsest_deg", d.v_coarsest_deg},
            {"share_of_sphere", d.covered_share},
            {"gap_cells", d.gap_cells},
            {"edge_cd", d.edge_cd}};
}

nlohmann::ordered_json interpolation_json(const InterpolationError& e) {
    if (e.samples == 0)
        return {{"samples", 0}, {"not_measured", "too few samples or no light"}};
    return {{"samples", e.samples},          {"median_of_peak", e.median_relative},
            {"p95_of_peak", e.p95_relative}, {"worst_of_peak", e.worst_relative},
            {"worst_h_deg", e.worst_h_deg},  {"worst_v_deg", e.worst_v_deg}};
}

} // namespace

LampDescription describe(const LampFile& lamp) {
    const CandelaTable& t = lamp.table;
    LampDescription d;
    d.name = lamp.name;
    d.format = lamp.format;
    d.rule = t.rule;
    d.h_samples = t.h_deg.size();
    d.v_samples = t.v_deg.size();
    d.h_from_deg = t.h_deg.front();
    d.h_to_deg = t.h_deg.back();
    d.v_from_deg = t.v_deg.front();
    d.v_to_deg = t.v_deg.back();
    std::tie(d.h_finest_deg, d.h_coarsest_deg) = finest_and_coarsest(t.h_deg);
    std::tie(d.v_finest_deg, d.v_coarsest_deg) = finest_and_coarsest(t.v_deg);
    measure_coverage(t, d);
    d.peak = peak_of(t);
    d.hv_cd = intensity_cd(t, 0.0, 0.0);
    d.flux_lm = flux_lm(t);
    d.declared_flux_lm = lamp.declared_flux_lm;
    d.interpolation = interpolation_error(t);
    d.labels = lamp.labels;
    d.notes = lamp.notes;
    return d;
}

std::string text_of(const LampDescription& d) {
    const auto lux = [](double cd) { return fmt::format("{:.5g} cd = {:.4g} lx at 25 m", cd, cd / plots::cd_per_lx_at_25_m); };
    std::string out;
    add_line(out, "lamp", printable(d.name, 90));
    add_line(out, "format", printable(d.format, 90));
    add_line(out, "peak",
             d.peak.cd > 0.0 ? lux(d.peak.cd) + fmt::format(", at H {:.4g}, V {:.4g} degrees", d.peak.h_deg, d.peak.v_deg)
                             : std::string("no light in any direction"));
    add_line(out, "straight ahead", lux(d.hv_cd));
    add_line(out, "flux", flux_text(d));
    add_line(out, "covers",
             fmt::format("H {:g} to {:g}, V {:g} to {:g} degrees: {:.3g} % of the sphere", d.h_from_deg, d.h_to_deg, d.v_from_deg,
                         d.v_to_deg, 100.0 * d.covered_share));
    add_line(out, "outside", edge_text(d));
    if (d.gap_cells > 0)
        add_line(out, "gaps", fmt::format("{} cells without data", d.gap_cells));
    add_line(out, "samples",
             fmt::format("{} x {}; steps of {:.3g} to {:.3g} in H, {:.3g} to {:.3g} in V", d.h_samples, d.v_samples, d.h_finest_deg,
                         d.h_coarsest_deg, d.v_finest_deg, d.v_coarsest_deg));
    add_line(out, "between them", std::string(rule_name(d.rule)) + "; error " + interpolation_text(d.interpolation));
    if (d.spots)
        add_spots(out, *d.spots, d.peak.cd);
    for (const auto& [key, value] : d.labels)
        add_line(out, "label", printable(key, 30) + ": " + printable(value, 90));
    for (const std::string& note : d.notes)
        add_line(out, "note", printable(note, 300));
    return out;
}

std::string json_of(const LampDescription& d) {
    nlohmann::ordered_json j{
        {"name", d.name},
        {"format", d.format},
        {"between_samples", d.rule == BetweenSamples::linear_cd ? "linear_cd" : "log_cd"},
        {"peak",
         {{"cd", d.peak.cd}, {"h_deg", d.peak.h_deg}, {"v_deg", d.peak.v_deg}, {"lx_at_25_m", d.peak.cd / plots::cd_per_lx_at_25_m}}},
        {"straight_ahead_cd", d.hv_cd},
        {"flux_lm", d.flux_lm},
        {"declared_flux_lm", nullptr},
        {"coverage", coverage_json(d)},
        {"interpolation_error", interpolation_json(d.interpolation)},
        {"labels", nlohmann::ordered_json::array()},
        {"notes", d.notes}};
    if (d.declared_flux_lm)
        j["declared_flux_lm"] = *d.declared_flux_lm;
    if (d.spots)
        j["spot_fit"] = spots_json(*d.spots);
    for (const auto& [key, value] : d.labels)
        j["labels"].push_back({{"key", key}, {"text", value}});
    return j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace fernlicht
