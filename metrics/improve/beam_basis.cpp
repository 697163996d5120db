#include "metrics/improve/beam_basis.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace fernlicht {

void BeamBox::add(double h_deg, double v_deg) {
    left_deg = std::min(left_deg, h_deg);
    right_deg = std::max(right_deg, h_deg);
    bottom_deg = std::min(bottom_deg, v_deg);
    top_deg = std::max(top_deg, v_deg);
}

LinearForm sparse(const std::vector<double>& sums) {
    LinearForm form;
    for (std::size_t i = 0; i < sums.size(); ++i)
        if (sums[i] != 0.0)
            form.emplace_back(i, sums[i]);
    return form;
}

double value_of(const LinearForm& form, const std::vector<double>& x) {
    double sum = 0.0;
    for (const auto& [variable, factor] : form)
        sum += factor * x[variable];
    return sum;
}

BeamBasis::Axis BeamBasis::axis_of(const std::vector<double>& samples_deg, double from_deg, double to_deg, double step_deg) {
    const auto above = std::ranges::upper_bound(samples_deg, from_deg);
    std::size_t at = above == samples_deg.begin() ? 0 : static_cast<std::size_t>(above - samples_deg.begin()) - 1;
    Axis axis;
    axis.samples.resize(samples_deg.size());
    axis.knots_deg.push_back(samples_deg[at]);
    while ((axis.knots_deg.back() < to_deg || axis.knots_deg.size() < 3) && at + 1 < samples_deg.size()) {
        std::size_t next = at + 1;
        while (next + 1 < samples_deg.size() && samples_deg[next] - samples_deg[at] < step_deg - 1e-9)
            ++next;
        for (std::size_t i = at; i < next; ++i)
            axis.samples[i] = {axis.knots_deg.size() - 1, (samples_deg[i] - samples_deg[at]) / (samples_deg[next] - samples_deg[at]), true};
        axis.knots_deg.push_back(samples_deg[next]);
        at = next;
    }
    while (axis.knots_deg.size() < 3) // a table of two samples: nothing between them changes
        axis.knots_deg.push_back(axis.knots_deg.back() + step_deg);
    return axis;
}

BeamBasis::BeamBasis(const CandelaTable& table, const BeamBox& box, double h_step_deg, double v_step_deg, double floor_cd)
    : table_(table), h_(axis_of(table.h_deg, box.left_deg, box.right_deg, h_step_deg)),
      v_(axis_of(table.v_deg, box.bottom_deg, box.top_deg, v_step_deg)), floor_cd_(floor_cd) {}

Direction BeamBasis::knot(std::size_t variable) const {
    return {h_.knots_deg[variable % columns() + 1], v_.knots_deg[variable / columns() + 1]};
}

LinearForm BeamBasis::at_sample(std::size_t sample) const {
    const Between &h = h_.samples[sample % table_.h_deg.size()], &v = v_.samples[sample / table_.h_deg.size()];
    LinearForm form;
    if (!h.inside || !v.inside)
        return form;
    for (std::size_t up = 0; up < 2; ++up)
        for (std::size_t right = 0; right < 2; ++right) {
            const std::size_t row = v.knot + up, column = h.knot + right;
            const double share = (up ? v.share : 1.0 - v.share) * (right ? h.share : 1.0 - h.share);
            if (share > 0.0 && row > 0 && row <= rows() && column > 0 && column <= columns())
                form.emplace_back((row - 1) * columns() + column - 1, share);
        }
    return form;
}

LinearForm BeamBasis::form(const std::vector<double>& per_cd) const {
    std::vector<double> sums(size());
    for (std::size_t i = 0; i < per_cd.size(); ++i)
        if (per_cd[i] != 0.0)
            for (const auto& [variable, share] : at_sample(i))
                sums[variable] += share * per_cd[i] * weight_cd(i);
    return sparse(sums);
}

LinearForm BeamBasis::form(const std::vector<SampleWeight>& per_cd) const {
    LinearForm parts, form;
    for (const auto& [sample, weight] : per_cd)
        for (const auto& [variable, share] : at_sample(sample))
            parts.emplace_back(variable, share * weight * weight_cd(sample));
    std::ranges::stable_sort(parts, {}, &LinearForm::value_type::first);
    for (const auto& [variable, factor] : parts)
        if (!form.empty() && form.back().first == variable)
            form.back().second += factor;
        else
            form.emplace_back(variable, factor);
    return form;
}

CandelaTable BeamBasis::changed(const std::vector<double>& x) const {
    CandelaTable changed = table_;
    for (std::size_t i = 0; i < changed.cd.size(); ++i)
        if (const double relative = value_of(at_sample(i), x); relative != 0.0)
            changed.cd[i] = std::max(0.0, changed.cd[i] + relative * weight_cd(i));
    return changed;
}

std::vector<QuadraticProgramme::Term> BeamBasis::size_and_bends(double length_h_deg, double length_v_deg) const {
    std::map<std::pair<std::size_t, std::size_t>, double> sums;
    const auto add_square = [&](const LinearForm& form, double weight) {
        for (const auto& [i, a] : form)
            for (const auto& [j, b] : form)
                if (i >= j)
                    sums[{i, j}] += 2.0 * weight * a * b;
    };
    const auto variable = [&](std::size_t row, std::size_t column) -> std::optional<std::size_t> {
        if (row < 1 || row > rows() || column < 1 || column > columns())
            return std::nullopt;
        return (row - 1) * columns() + column - 1;
    };
    // Steps before and behind a knot; beyond the ends, where all is 0, as within.
    const auto steps = [](const std::vector<double>& knots, std::size_t i) {
        const double before = i > 0 ? knots[i] - knots[i - 1] : knots[1] - knots[0];
        return std::pair(before, i + 1 < knots.size() ? knots[i + 1] - knots[i] : before);
    };
    const auto bend = [](double before, double behind, double length, std::optional<std::size_t> last, std::optional<std::size_t> here,
                         std::optional<std::size_t> next) {
        const double factor = 2.0 * length * length / (before + behind);
        LinearForm form;
        if (last)
            form.emplace_back(*last, factor / before);
        if (here)
            form.emplace_back(*here, -factor * (1.0 / before + 1.0 / behind));
        if (next)
            form.emplace_back(*next, factor / behind);
        return form;
    };
    for (std::size_t row = 0; row < v_.knots_deg.size(); ++row)
        for (std::size_t column = 0; column < h_.knots_deg.size(); ++column) {
            const auto [left, right] = steps(h_.knots_deg, column);
            const auto [below, above] = steps(v_.knots_deg, row);
            const double area = 0.25 * (left + right) * (below + above);
            const auto here = variable(row, column);
            if (here)
                add_square({{*here, 1.0}}, area);
            add_square(
                bend(left, right, length_h_deg, column > 0 ? variable(row, column - 1) : std::nullopt, here, variable(row, column + 1)),
                area);
            add_square(
                bend(below, above, length_v_deg, row > 0 ? variable(row - 1, column) : std::nullopt, here, variable(row + 1, column)),
                area);
        }
    std::vector<QuadraticProgramme::Term> terms;
    for (const auto& [place, value] : sums)
        if (value != 0.0)
            terms.push_back({place.first, place.second, value});
    return terms;
}

} // namespace fernlicht
