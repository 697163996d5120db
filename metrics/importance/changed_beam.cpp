#include "metrics/importance/changed_beam.h"

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/parallel_for.h>

namespace fernlicht {
namespace {

double drawn_between(double low, double high, std::mt19937_64& generator) {
    return std::lerp(low, high, static_cast<double>(generator() >> 11) * 0x1p-53);
}

struct AngleBox {
    double left_deg = 0.0, right_deg = 0.0, bottom_deg = 0.0, top_deg = 0.0;
};

/// Where the gradient is not 0, and a degree round it.
AngleBox box_of(const LampGradient& gradient) {
    const std::vector<double>&h = gradient.file->table.h_deg, &v = gradient.file->table.v_deg;
    AngleBox box{h.back(), h.front(), v.back(), v.front()};
    for (std::size_t i = 0; i < gradient.per_cd.size(); ++i)
        if (gradient.per_cd[i] != 0.0) {
            const double at_h = h[i % h.size()], at_v = v[i / h.size()];
            box = {std::min(box.left_deg, at_h), std::max(box.right_deg, at_h), std::min(box.bottom_deg, at_v),
                   std::max(box.top_deg, at_v)};
        }
    return {box.left_deg - 1.0, box.right_deg + 1.0, box.bottom_deg - 1.0, box.top_deg + 1.0};
}

} // namespace

double foretold_change(const BeamGradient& gradient, const ChangedTables& tables) {
    double change = 0.0;
    for (std::size_t k = 0; k < gradient.size(); ++k)
        for (std::size_t i = 0; i < gradient[k].per_cd.size(); ++i)
            change += gradient[k].per_cd[i] * (tables[k].cd[i] - gradient[k].file->table.cd[i]);
    return change;
}

std::vector<Moment> with_tables(std::vector<Moment> moments, const BeamGradient& gradient, const ChangedTables& tables) {
    for (std::size_t k = 0; k < gradient.size(); ++k) {
        auto changed = std::make_shared<LampFile>();
        changed->table = tables[k];
        const std::shared_ptr<const LampFile> file = changed;
        for (Moment& moment : moments)
            for (LitLamp& lamp : moment.lamps)
                if (lamp.name == gradient[k].lamp && lamp.file == gradient[k].file)
                    lamp.file = file;
    }
    return moments;
}

SmoothChange::SmoothChange(const BeamGradient& gradient, std::mt19937_64& generator) : gradient_(gradient) {
    constexpr int bumps = 6;
    constexpr double narrowest_deg = 0.2, widest_deg = 2.0;
    for (const LampGradient& one : gradient) {
        const CandelaTable& table = one.file->table;
        const AngleBox box = box_of(one);
        std::vector<double>& g = g_.emplace_back(table.cd.size());
        for (int bump = 0; bump < bumps; ++bump) {
            const double h = drawn_between(box.left_deg, box.right_deg, generator),
                         v = drawn_between(box.bottom_deg, box.top_deg, generator);
            const double width_deg = narrowest_deg * std::pow(widest_deg / narrowest_deg, drawn_between(0.0, 1.0, generator));
            const double height = drawn_between(-1.0, 1.0, generator);
            for (std::size_t i = 0; i < g.size(); ++i)
                g[i] += height * std::exp(-0.5 * (std::pow((table.h_deg[i % table.h_deg.size()] - h) / width_deg, 2.0) +
                                                  std::pow((table.v_deg[i / table.h_deg.size()] - v) / width_deg, 2.0)));
        }
        double most = 0.0;
        for (const double value : g)
            most = std::max(most, std::abs(value));
        for (double& value : g)
            value /= most > 0.0 ? most : 1.0;
    }
}

ChangedTables SmoothChange::tables(double size) const {
    ChangedTables tables;
    for (std::size_t k = 0; k < gradient_.size(); ++k) {
        CandelaTable& table = tables.emplace_back(gradient_[k].file->table);
        for (std::size_t i = 0; i < table.cd.size(); ++i)
            table.cd[i] *= 1.0 + size * g_[k][i];
    }
    return tables;
}

std::vector<std::vector<ForetoldChange>> try_changes(const ReadingOfLight& reading, const std::vector<Moment>& moments,
                                                     const ReadingOfLight::Found& found, const std::vector<double>& sizes, int count,
                                                     std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::vector<SmoothChange> changes;
    for (int draw = 0; draw < count; ++draw)
        changes.emplace_back(found.gradient, generator);
    std::vector<std::vector<ForetoldChange>> tried(sizes.size(), std::vector<ForetoldChange>(changes.size()));
    oneapi::tbb::parallel_for(std::size_t{0}, sizes.size() * changes.size(), [&](std::size_t k) {
        const std::size_t size = k / changes.size(), draw = k % changes.size();
        const ChangedTables tables = changes[draw].tables(sizes[size]);
        tried[size][draw] = {foretold_change(found.gradient, tables),
                             difference(reading.value(with_tables(moments, found.gradient, tables)), found.value, "")};
    });
    return tried;
}

double BeamSpot::at(double h, double v) const {
    const double squared = std::pow((h - h_deg) / full_width_deg, 2.0) + std::pow((v - v_deg) / full_width_deg, 2.0);
    return squared < 4.0 ? std::exp(-4.0 * std::log(2.0) * squared) : 0.0;
}

CandelaTable with_spot(CandelaTable table, const BeamSpot& spot, double cd) {
    for (std::size_t v = 0; v < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            table.at(v, h) = std::max(table.at(v, h) + cd * spot.at(table.h_deg[h], table.v_deg[v]), 0.0);
    return table;
}

SpotMap spot_map(const BeamGradient& gradient, const LampFile& file, std::vector<double> h_deg, std::vector<double> v_deg,
                 double full_width_deg) {
    SpotMap map{std::move(h_deg), std::move(v_deg), {}};
    map.per_cd.resize(map.h_deg.size() * map.v_deg.size());
    const auto reached = [&](const std::vector<double>& axis, double middle_deg) {
        const auto index = [&](double at) { return std::ranges::lower_bound(axis, at) - axis.begin(); };
        return std::pair(static_cast<std::size_t>(index(middle_deg - 2.0 * full_width_deg)),
                         static_cast<std::size_t>(index(middle_deg + 2.0 * full_width_deg)));
    };
    for (const LampGradient& one : gradient) {
        if (one.file.get() != &file)
            continue;
        for (std::size_t i = 0; i < one.per_cd.size(); ++i) {
            if (one.per_cd[i] == 0.0)
                continue;
            const BeamSpot spot{file.table.h_deg[i % file.table.h_deg.size()], file.table.v_deg[i / file.table.h_deg.size()],
                                full_width_deg};
            const auto [left, right] = reached(map.h_deg, spot.h_deg);
            const auto [low, high] = reached(map.v_deg, spot.v_deg);
            for (std::size_t v = low; v < high; ++v)
                for (std::size_t h = left; h < right; ++h)
                    map.per_cd[v * map.h_deg.size() + h] += one.per_cd[i] * spot.at(map.h_deg[h], map.v_deg[v]);
        }
    }
    return map;
}

} // namespace fernlicht
