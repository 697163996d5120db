// Lamps made from a table: they meet every row by one part in a hundred, and can be changed at one place.
#pragma once

#include "metrics/regulation/row_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace fernlicht::generated {

constexpr double h_step = 0.2, v_step = 0.05, h_from = -20.6, v_from = -5.2;
constexpr int columns = 207, rows = 319;
constexpr double above = 1.01, below = 0.99; ///< how near to its limits the lamp keeps
/// FMVSS 108 has lines 0.5 degrees apart and a receiver of 0.516: what breaks one reaches a little of the other, which so needs room.
constexpr double below_of_discs = 0.9;
constexpr double just_below = 0.985, just_above = 1.015; ///< of what breaks a row: further off than the lamp keeps

struct Box {
    double left, right, bottom, top;
    bool holds(Direction d) const { return d.h_deg >= left && d.h_deg <= right && d.v_deg >= bottom && d.v_deg <= top; }
};

inline Box box_round(Direction d, double dh, double dv) { return {d.h_deg - dh, d.h_deg + dh, d.v_deg - dv, d.v_deg + dv}; }

/// Whether the straight line from a to b meets the box.
inline bool meets(Direction a, Direction b, const Box& box) {
    double begin = 0.0, end = 1.0;
    const auto cut = [&](double from, double to, double low, double high) {
        if (from == to)
            return from >= low && from <= high;
        const double in = (low - from) / (to - from), out = (high - from) / (to - from);
        begin = std::max(begin, std::min(in, out));
        end = std::min(end, std::max(in, out));
        return begin <= end;
    };
    return cut(a.h_deg, b.h_deg, box.left, box.right) && cut(a.v_deg, b.v_deg, box.bottom, box.top);
}

inline bool inside(const std::vector<Direction>& polygon, Direction d) {
    bool in = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Direction a = polygon[i], b = polygon[j];
        if ((a.v_deg > d.v_deg) != (b.v_deg > d.v_deg) &&
            d.h_deg < a.h_deg + (b.h_deg - a.h_deg) * (d.v_deg - a.v_deg) / (b.v_deg - a.v_deg))
            in = !in;
    }
    return in;
}

/// Whether a row asks anything within dh, dv of a direction.
inline bool concerns(const RegulationRow& row, Direction d, double dh, double dv) {
    const Box box = box_round(d, dh, dv);
    if (row.kind == RowKind::point || row.kind == RowKind::sum)
        return std::any_of(row.places.begin(), row.places.end(), [&](Direction p) { return box.holds(p); });
    if (row.kind == RowKind::segment)
        return meets(row.places[0], row.places[1], box);
    if (inside(row.places, d))
        return true;
    for (std::size_t i = 0; i < row.places.size(); ++i)
        if (meets(row.places[i], row.places[(i + 1) % row.places.size()], box))
            return true;
    return false;
}

class Lamp {
  public:
    explicit Lamp(const Regulation& r) : r_(r), dh_(r.receiver.size_deg / 2.0 + h_step), dv_(r.receiver.size_deg / 2.0 + v_step) {
        for (int i = 0; i < columns; ++i)
            table.h_deg.push_back(h_from + h_step * i);
        for (int j = 0; j < rows; ++j)
            table.v_deg.push_back(v_from + v_step * j);
        place_spots();
        for (const double v : table.v_deg)
            for (const double h : table.h_deg)
                table.cd.push_back(value_at({h, v}));
    }

    /// The lowest or highest limit of a row in cd, with ratios as this lamp has them; nullopt: none.
    std::optional<double> minimum(const RegulationRow& row) const {
        if (!row.ratio_of.empty() && row.ratio_is_minimum)
            return row.ratio * spot_cd_;
        return row.limits.min_cd > 0.0 ? std::optional(row.limits.min_cd) : std::nullopt;
    }
    std::optional<double> maximum(const RegulationRow& row) const {
        if (!row.ratio_of.empty() && !row.ratio_is_minimum)
            for (const RegulationRow& other : r_.rows)
                if (other.id == row.ratio_of)
                    return row.ratio * above * other.limits.min_cd;
        return std::isinf(row.limits.max_cd) ? std::nullopt : std::optional(row.limits.max_cd);
    }

    /// A copy with at most or at least so much light round a place, as wide as the receiver.
    CandelaTable changed(Direction at, double cd, bool lower) const {
        CandelaTable t = table;
        for (std::size_t j = 0; j < t.v_deg.size(); ++j)
            for (std::size_t i = 0; i < t.h_deg.size(); ++i)
                if (box_round(at, dh_, dv_).holds({t.h_deg[i], t.v_deg[j]}))
                    t.at(j, i) = lower ? std::min(t.at(j, i), cd) : std::max(t.at(j, i), cd);
        return t;
    }

    /// Whether a change at a place can reach a row's receiver.
    bool reaches(const RegulationRow& row, Direction at) const {
        return disc() ? concerns(row, at, r_.receiver.size_deg + h_step, 0.95 * r_.receiver.size_deg)
                      : concerns(row, at, 2.0 * dh_, 2.0 * dv_);
    }
    bool disc() const { return r_.receiver.shape == Receiver::Shape::disc; }

    CandelaTable table;

  private:
    /// Rows that ask for so much somewhere: a spot where no other row has anything against it.
    void place_spots() {
        std::vector<const RegulationRow*> wanting;
        for (const RegulationRow& row : r_.rows)
            if (row.kind == RowKind::brightest && row.limits.min_cd > 0.0 && row.scope != Scope::each_of_two)
                wanting.push_back(&row);
        // The largest region last: the spots of smaller ones may serve it.
        std::stable_sort(wanting.begin(), wanting.end(), [](auto* a, auto* b) { return width(*a) < width(*b); });
        for (const RegulationRow* row : wanting) {
            spot_cd_ = std::max(spot_cd_, above * row->limits.min_cd);
            const bool served = std::any_of(spots_.begin(), spots_.end(),
                                            [&](const Extreme& s) { return s.cd >= row->limits.min_cd && inside(row->places, s.where); });
            if (!served)
                spots_.push_back(spot_for(*row));
        }
    }
    struct Extreme {
        double cd;
        Direction where;
    };
    static double width(const RegulationRow& row) { return std::abs(row.places[1].h_deg - row.places[0].h_deg); }

    Extreme spot_for(const RegulationRow& row) const {
        const double cd = above * row.limits.min_cd;
        for (const double v : {-1.2, 0.9, -0.6, -1.5, -3.4, 3.0})
            for (double h = -19.0; h <= 19.0; h += 0.1) {
                const Direction at{h, v};
                const bool free = std::none_of(r_.rows.begin(), r_.rows.end(), [&](const RegulationRow& other) {
                    const auto max = maximum(other);
                    return reaches(other, at) && ((max && cd > *max) || other.kind == RowKind::point);
                });
                if (free && inside(row.places, at))
                    return {cd, at};
            }
        throw std::logic_error(r_.id + ": no place for " + row.id);
    }

    double value_at(Direction d) const {
        double least = 0.0, most = std::numeric_limits<double>::infinity();
        for (const RegulationRow& row : r_.rows) {
            if (row.kind == RowKind::brightest || row.scope == Scope::each_of_two || !concerns(row, d, dh_, dv_))
                continue;
            const double count = row.kind == RowKind::sum ? static_cast<double>(row.places.size()) : 1.0;
            if (const auto min = minimum(row))
                least = std::max(least, *min / count);
            if (const auto max = maximum(row)) // of ratios a tenth is left, so that the row referred to can be changed by itself
                most = std::min(most, (!row.ratio_of.empty() ? 0.9 : disc() ? below_of_discs : below) * *max);
        }
        for (const Extreme& spot : spots_)
            if (box_round(d, dh_, dv_).holds(spot.where))
                least = std::max(least, spot.cd / above);
        if (above * least > most)
            throw std::logic_error(r_.id + ": rows contradict each other");
        return least > 0.0 ? above * least : std::isinf(most) ? 0.0 : most;
    }

    const Regulation& r_;
    double dh_, dv_;
    double spot_cd_ = 0.0;
    std::vector<Extreme> spots_;
};

} // namespace fernlicht::generated
