#include "metrics/regulation/row_check.h"

#include "metrics/beam/beam_places.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double followed_to_deg = 0.001; // a hundredth of the coarsest angle that a table of limits names

void merge(Extremes& all, const Extremes& other) {
    if (other.lowest && (!all.lowest || other.lowest->cd < all.lowest->cd))
        all.lowest = other.lowest;
    if (other.highest && (!all.highest || other.highest->cd > all.highest->cd))
        all.highest = other.highest;
    all.all_covered = all.all_covered && other.all_covered;
}

void look(Extremes& all, const ReceivedBeam& beam, Direction where, WantedExtremes wanted) {
    const std::optional<double> cd = beam.at(where);
    const auto here = cd ? std::optional(Extreme{*cd, where}) : std::nullopt;
    merge(all, {wanted.lowest ? here : std::nullopt, wanted.highest ? here : std::nullopt, cd.has_value()});
}

/// From the best sample on to neighbours that are better, in halving steps.
template <class Allowed> void follow(std::optional<Extreme>& best, const ReceivedBeam& beam, double sign, double step, Allowed allowed) {
    if (!best)
        return;
    static constexpr std::array<Direction, 4> ways{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (double s = step / 2.0; s >= followed_to_deg; s /= 2.0)
        for (int moves = 0; moves < 8; ++moves) {
            const Direction from = best->where;
            for (const Direction way : ways) {
                const Direction to{from.h_deg + s * way.h_deg, from.v_deg + s * way.v_deg};
                const std::optional<double> cd = allowed(to) ? beam.at(to) : std::nullopt;
                if (cd && sign * (*cd - best->cd) > 0.0)
                    best = Extreme{*cd, to};
            }
            if (best->where == from)
                break;
        }
}

std::size_t samples_along(double length_deg, double step_deg) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length_deg / step_deg - 1e-9)));
}

double blend(double a, double b, double share) { return a + (b - a) * share; }

/// The part of a segment that can hold data; false when there is none. `covered` becomes false when something was cut.
bool clip(const ReceivedBeam& beam, Direction& from, Direction& to, bool& covered) {
    const ReceivedBeam::Window w = beam.window();
    if (w.right_deg - w.left_deg >= 360.0 - 1e-9)
        return true;
    double begin = 0.0, end = 1.0;
    const auto cut = [&](double a, double b, double low, double high) {
        if (a == b)
            return a >= low && a <= high;
        double in = (low - a) / (b - a), out = (high - a) / (b - a);
        if (in > out)
            std::swap(in, out);
        begin = std::max(begin, in);
        end = std::min(end, out);
        return begin <= end;
    };
    const bool some = cut(from.h_deg, to.h_deg, w.left_deg, w.right_deg) && cut(from.v_deg, to.v_deg, w.bottom_deg, w.top_deg);
    covered = covered && some && begin == 0.0 && end == 1.0;
    if (!some)
        return false;
    const Direction a = from, b = to;
    if (begin > 0.0)
        from = {blend(a.h_deg, b.h_deg, begin), blend(a.v_deg, b.v_deg, begin)};
    if (end < 1.0)
        to = {blend(a.h_deg, b.h_deg, end), blend(a.v_deg, b.v_deg, end)};
    return true;
}

struct Block {
    Direction low, high;
    ReceivedBeam::Bounds bounds;
};

constexpr double block_deg = 1.0;  // some twenty samples a side
constexpr double rounding = 1e-12; // of means of equal samples

void look_through(Extremes& all, const ReceivedBeam& beam, const Block& block, const std::vector<Direction>& corners,
                  WantedExtremes wanted) {
    const double width = block.high.h_deg - block.low.h_deg, height = block.high.v_deg - block.low.v_deg;
    const std::size_t columns = samples_along(width, beam.step_deg()), rows = samples_along(height, beam.step_deg());
    for (std::size_t j = 0; j <= rows; ++j)
        for (std::size_t i = 0; i <= columns; ++i) {
            const Direction d{block.low.h_deg + width * static_cast<double>(i) / static_cast<double>(columns),
                              block.low.v_deg + height * static_cast<double>(j) / static_cast<double>(rows)};
            if (is_within(corners, d))
                look(all, beam, d, wanted);
        }
}

/// Best first: the block that promises most is cut in four, or looked through once it is small, until none promises more than was found.
template <class Promises, class Found> void search(const ReceivedBeam& beam, Direction low, Direction high, Promises promises_less,
                                                   Found beaten, const std::vector<Direction>& corners, WantedExtremes wanted,
                                                   Extremes& all) {
    std::vector<Block> heap{{low, high, beam.bounds(low, high)}};
    while (!heap.empty()) {
        std::pop_heap(heap.begin(), heap.end(), promises_less);
        const Block block = heap.back();
        heap.pop_back();
        if (beaten(block))
            return;
        const double width = block.high.h_deg - block.low.h_deg, height = block.high.v_deg - block.low.v_deg;
        if (std::max(width, height) <= block_deg) {
            look_through(all, beam, block, corners, wanted);
            continue;
        }
        const int columns = width > block_deg ? 2 : 1, rows = height > block_deg ? 2 : 1;
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                Block part{{block.low.h_deg + width * i / columns, block.low.v_deg + height * j / rows},
                           {block.low.h_deg + width * (i + 1) / columns, block.low.v_deg + height * (j + 1) / rows},
                           {}};
                part.bounds = beam.bounds(part.low, part.high);
                heap.push_back(part);
                std::push_heap(heap.begin(), heap.end(), promises_less);
            }
    }
}

} // namespace

Extremes extremes_on(const ReceivedBeam& beam, Direction from, Direction to, WantedExtremes wanted) {
    Extremes all;
    if (!clip(beam, from, to, all.all_covered))
        return all;
    const double length = std::max(std::abs(to.h_deg - from.h_deg), std::abs(to.v_deg - from.v_deg));
    const std::size_t n = samples_along(length, beam.step_deg());
    const auto place = [&](double share) { return Direction{blend(from.h_deg, to.h_deg, share), blend(from.v_deg, to.v_deg, share)}; };
    double low_share = 0.0, high_share = 0.0;
    for (std::size_t i = 0; i <= n; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(n);
        const Extremes before = all;
        look(all, beam, i == n ? to : place(share), wanted);
        if (all.lowest && (!before.lowest || all.lowest->cd < before.lowest->cd))
            low_share = share;
        if (all.highest && (!before.highest || all.highest->cd > before.highest->cd))
            high_share = share;
    }
    if (length == 0.0)
        return all;
    const auto follow_along = [&](std::optional<Extreme>& best, double share, double sign) {
        for (double s = 0.5 / static_cast<double>(n); best && s * length >= followed_to_deg; s /= 2.0)
            for (const double next : {share - s, share + s}) {
                const std::optional<double> cd = next >= 0.0 && next <= 1.0 ? beam.at(place(next)) : std::nullopt;
                if (cd && sign * (*cd - best->cd) > 0.0) {
                    best = Extreme{*cd, place(next)};
                    share = next;
                }
            }
    };
    follow_along(all.lowest, low_share, -1.0);
    follow_along(all.highest, high_share, 1.0);
    return all;
}

Extremes extremes_in(const ReceivedBeam& beam, const std::vector<Direction>& corners, WantedExtremes wanted) {
    Extremes all;
    for (std::size_t i = 0; i < corners.size(); ++i)
        merge(all, extremes_on(beam, corners[i], corners[(i + 1) % corners.size()], wanted));
    double left = corners[0].h_deg, right = left, bottom = corners[0].v_deg, top = bottom;
    for (const Direction d : corners) {
        left = std::min(left, d.h_deg);
        right = std::max(right, d.h_deg);
        bottom = std::min(bottom, d.v_deg);
        top = std::max(top, d.v_deg);
    }
    const ReceivedBeam::Window w = beam.window();
    left = std::max(left, std::max(w.left_deg, -180.0));
    right = std::min(right, std::min(w.right_deg, 180.0));
    bottom = std::max(bottom, w.bottom_deg);
    top = std::min(top, w.top_deg);
    if (left > right || bottom > top)
        return all;
    const Direction low{left, bottom}, high{right, top};
    if (wanted.highest)
        search(
            beam, low, high, [](const Block& a, const Block& b) { return a.bounds.high_cd < b.bounds.high_cd; },
            [&](const Block& block) { return all.highest && block.bounds.high_cd <= all.highest->cd * (1.0 + rounding); }, corners,
            {false, true}, all);
    if (wanted.lowest)
        search(
            beam, low, high, [](const Block& a, const Block& b) { return a.bounds.low_cd > b.bounds.low_cd; },
            [&](const Block& block) { return all.lowest && block.bounds.low_cd >= all.lowest->cd * (1.0 - rounding); }, corners,
            {true, false}, all);
    const auto allowed = [&](Direction d) { return is_within(corners, d); };
    if (wanted.lowest)
        follow(all.lowest, beam, -1.0, beam.step_deg(), allowed);
    if (wanted.highest)
        follow(all.highest, beam, 1.0, beam.step_deg(), allowed);
    return all;
}

} // namespace fernlicht
