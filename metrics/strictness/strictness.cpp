#include "metrics/strictness/strictness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace fernlicht {
namespace {

using Kind = StrictnessNode::Kind;
using Channels = std::vector<Image<float>>;

void check(const Channels& tested, const Channels& reference) {
    if (tested.empty() || tested.size() != reference.size())
        throw std::invalid_argument(fmt::format("pictures of {} and {} channels cannot be compared", tested.size(), reference.size()));
    for (const Channels* channels : {&tested, &reference})
        for (const Image<float>& image : *channels) {
            if (image.width() != reference[0].width() || image.height() != reference[0].height() || image.empty())
                throw std::invalid_argument(fmt::format("pictures of {}x{} and {}x{} cannot be compared", image.width(), image.height(),
                                                        reference[0].width(), reference[0].height()));
            if (!std::ranges::all_of(image.pixels(), [](float v) { return std::isfinite(v); }))
                throw std::invalid_argument("a picture holds a value that is not finite");
        }
}

void check(const StrictnessNode& node, const Image<float>& picture) {
    if (!(node.bound.absolute >= 0.0 && node.bound.relative >= 0.0 && node.percent >= 0.0 && node.percent <= 100.0))
        throw std::invalid_argument("a bound is below 0 or a percentage outside 0 to 100");
    if (!(node.figure >= 0.0 && node.figure <= 1.0))
        throw std::invalid_argument("a figure is outside 0 to 1");
    if ((node.kind == Kind::all || node.kind == Kind::any) && node.children.empty())
        throw std::invalid_argument("all or any of nothing");
    if (!node.mask)
        return;
    if (node.mask->width() != picture.width() || node.mask->height() != picture.height())
        throw std::invalid_argument(fmt::format("the mask {} of {}x{} does not fit pictures of {}x{}", node.mask_name, node.mask->width(),
                                                node.mask->height(), picture.width(), picture.height()));
    if (std::ranges::all_of(node.mask->pixels(), [](std::uint8_t m) { return m == 0; }))
        throw std::invalid_argument(fmt::format("the mask {} looks at no pixel", node.mask_name));
}

/// A difference and what the bound allows there.
struct Compared {
    double difference = 0.0, allowed = 0.0;
};

double share(const Compared& c) {
    return c.allowed > 0.0 ? c.difference / c.allowed : c.difference > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
}

bool worse(const Compared& a, const Compared& b) { return share(a) != share(b) ? share(a) > share(b) : a.difference > b.difference; }

/// The worst channel of a pixel against the reference at one place.
Compared at_place(const Channels& tested, const Channels& reference, int x, int y, int rx, int ry, const PixelBound& bound) {
    Compared worst;
    for (std::size_t c = 0; c < tested.size(); ++c) {
        const auto r = static_cast<double>(reference[c].at(rx, ry));
        const Compared here{std::abs(static_cast<double>(tested[c].at(x, y)) - r), bound.absolute + bound.relative * std::abs(r)};
        if (c == 0 || worse(here, worst))
            worst = here;
    }
    return worst;
}

/// Against the pixel's own place, or with `shift` the best of the nine.
Compared compared(const Channels& tested, const Channels& reference, int x, int y, const PixelBound& bound, bool shift) {
    Compared best = at_place(tested, reference, x, y, x, y, bound);
    if (!shift || best.difference == 0.0)
        return best;
    for (int ry = std::max(0, y - 1); ry <= std::min(reference[0].height() - 1, y + 1); ++ry)
        for (int rx = std::max(0, x - 1); rx <= std::min(reference[0].width() - 1, x + 1); ++rx) {
            const Compared there = at_place(tested, reference, x, y, rx, ry, bound);
            if (worse(best, there))
                best = there;
        }
    return best;
}

std::string bound_text(const PixelBound& bound, const std::string& unit) {
    const std::string share = fmt::format("{:g} % of the reference", 100.0 * bound.relative);
    if (bound.relative == 0.0)
        return fmt::format("{:g} {}", bound.absolute, unit);
    return bound.absolute == 0.0 ? share : fmt::format("{:g} {} + {}", bound.absolute, unit, share);
}

std::string statement_of(const StrictnessNode& node, const std::string& unit) {
    std::string text;
    if (node.kind == Kind::percentage)
        text = fmt::format("at most {:g} % of the pixels differ by more than {}", node.percent, bound_text(node.bound, unit));
    else if (node.bound.absolute == 0.0 && node.bound.relative == 0.0)
        text = "no pixel differs";
    else
        text = fmt::format("no pixel differs by more than {}", bound_text(node.bound, unit));
    if (node.kind == Kind::hard_limit)
        return text + ", anywhere";
    if (node.one_pixel_shift)
        text += " from all pixels next to it";
    if (node.mask)
        text += fmt::format(", where {} is not black", node.mask_name);
    return text;
}

void set_margin(StrictnessResult& leaf) {
    leaf.passed = leaf.found <= leaf.threshold;
    if (leaf.threshold > 0.0)
        leaf.margin = (leaf.threshold - leaf.found) / leaf.threshold;
    else if (leaf.passed)
        leaf.margin = 0.0;
}

StrictnessResult judge_leaf(const StrictnessNode& node, const Channels& tested, const Channels& reference, const std::string& unit) {
    const bool everywhere = node.kind == Kind::hard_limit;
    StrictnessResult leaf;
    leaf.statement = statement_of(node, unit);
    Compared worst;
    std::size_t beyond = 0;
    for (int y = 0; y < reference[0].height(); ++y)
        for (int x = 0; x < reference[0].width(); ++x) {
            if (node.mask && !everywhere && node.mask->at(x, y) == 0)
                continue;
            const Compared here = compared(tested, reference, x, y, node.bound, node.one_pixel_shift && !everywhere);
            beyond += here.difference > here.allowed ? 1U : 0U;
            if (leaf.pixels == 0 || worse(here, worst)) {
                worst = here;
                leaf.worst_x = x;
                leaf.worst_y = y;
            }
            ++leaf.pixels;
        }
    if (node.kind == Kind::percentage) {
        leaf.found = 100.0 * static_cast<double>(beyond) / static_cast<double>(leaf.pixels);
        leaf.threshold = node.percent;
        leaf.unit = "% of the pixels";
    } else {
        leaf.found = worst.difference;
        leaf.threshold = worst.allowed;
        leaf.unit = unit;
    }
    set_margin(leaf);
    return leaf;
}

/// SSIM is at most 1: what it lacks to that is limited, so that a margin means the same in every leaf.
StrictnessResult judge_whole(const StrictnessNode& node, const WholeFigures& whole, std::size_t pixels) {
    const bool flip = node.kind == Kind::mean_flip;
    StrictnessResult leaf;
    leaf.statement = flip ? fmt::format("mean FLIP at most {:g}", node.figure) : fmt::format("SSIM at least {:g}", node.figure);
    leaf.unit = flip ? "mean FLIP" : "of 1 - SSIM";
    leaf.threshold = flip ? node.figure : 1.0 - node.figure;
    leaf.pixels = pixels;
    const std::optional<double>& found = flip ? whole.mean_flip : whole.ssim;
    if (found) {
        leaf.found = flip ? *found : 1.0 - *found;
        set_margin(leaf);
        return leaf;
    }
    const std::string& why = flip ? whole.no_flip : whole.no_ssim;
    leaf.passed = flip && why.empty(); // what was not measured is not kept
    if (leaf.passed)
        leaf.margin = 1.0;
    leaf.statement += leaf.passed ? ": asks nothing of what nobody sees" : ": not measured, " + why;
    return leaf;
}

/// A failure without a margin is worse than any with one.
double sortable(const StrictnessResult& r) { return r.margin.value_or(-std::numeric_limits<double>::infinity()); }

StrictnessResult judge_node(const StrictnessNode& node, const Channels& tested, const Channels& reference, const std::string& unit,
                            const WholeFigures& whole) {
    check(node, reference[0]);
    if (node.kind == Kind::mean_flip || node.kind == Kind::ssim)
        return judge_whole(node, whole, reference[0].size());
    if (node.kind != Kind::all && node.kind != Kind::any)
        return judge_leaf(node, tested, reference, unit);
    StrictnessResult result;
    const bool all = node.kind == Kind::all;
    result.statement = all ? "all of" : "any of";
    for (const StrictnessNode& child : node.children)
        result.children.push_back(judge_node(child, tested, reference, unit, whole));
    const auto passed = [](const StrictnessResult& child) { return child.passed; };
    result.passed = all ? std::ranges::all_of(result.children, passed) : std::ranges::any_of(result.children, passed);
    result.margin =
        (all ? std::ranges::min_element(result.children, {}, sortable) : std::ranges::max_element(result.children, {}, sortable))->margin;
    return result;
}

} // namespace

bool has_leaf(const StrictnessNode& tree, Kind kind) {
    return tree.kind == kind || std::ranges::any_of(tree.children, [&](const StrictnessNode& child) { return has_leaf(child, kind); });
}

StrictnessResult judge_strictness(const StrictnessNode& tree, const Channels& tested, const Channels& reference, const std::string& unit,
                                  const WholeFigures& whole) {
    check(tested, reference);
    return judge_node(tree, tested, reference, unit, whole);
}

namespace {

const std::array<double, ErrorHistogram::bins + 1>& edges() {
    static const auto all = [] {
        std::array<double, ErrorHistogram::bins + 1> values{};
        for (int i = 0; i <= ErrorHistogram::bins; ++i)
            values[static_cast<std::size_t>(i)] =
                std::pow(10.0, std::log10(ErrorHistogram::lowest) + static_cast<double>(i) / ErrorHistogram::bins_per_decade);
        return values;
    }();
    return all;
}

} // namespace

double ErrorHistogram::edge(int i) { return edges().at(static_cast<std::size_t>(i)); }

std::size_t ErrorHistogram::pixels() const { return std::accumulate(counts.begin(), counts.end(), equal); }

namespace {

void add_pixel(ErrorHistogram& histogram, const std::vector<Image<float>>& tested, const std::vector<Image<float>>& reference,
               std::size_t i) {
    double difference = 0.0;
    for (std::size_t c = 0; c < tested.size(); ++c) {
        const double d = std::abs(static_cast<double>(tested[c].pixels()[i]) - static_cast<double>(reference[c].pixels()[i]));
        if (!std::isfinite(d))
            throw std::invalid_argument("a picture holds a value that is not finite");
        difference = std::max(difference, d);
    }
    if (difference == 0.0) {
        ++histogram.equal;
        return;
    }
    const auto above = std::upper_bound(edges().begin(), edges().end(), difference);
    const auto bin = std::clamp<std::ptrdiff_t>(above - edges().begin() - 1, 0, ErrorHistogram::bins - 1);
    ++histogram.counts[static_cast<std::size_t>(bin)];
}

} // namespace

ErrorHistogram error_histogram(const std::vector<Image<float>>& tested, const std::vector<Image<float>>& reference) {
    if (tested.empty() || tested.size() != reference.size())
        throw std::invalid_argument("pictures of different channels cannot be compared");
    for (std::size_t c = 0; c < tested.size(); ++c)
        for (const Image<float>* image : {&tested[c], &reference[c]})
            if (image->width() != tested[0].width() || image->height() != tested[0].height())
                throw std::invalid_argument("pictures of different sizes cannot be compared");
    using Range = tbb::blocked_range<std::size_t>;
    const auto add = [&](const Range& pixels, ErrorHistogram histogram) {
        for (std::size_t i = pixels.begin(); i != pixels.end(); ++i)
            add_pixel(histogram, tested, reference, i);
        return histogram;
    };
    const auto both = [](ErrorHistogram a, const ErrorHistogram& b) {
        a.equal += b.equal;
        std::ranges::transform(a.counts, b.counts, a.counts.begin(), std::plus{});
        return a;
    };
    ErrorHistogram none;
    none.counts.assign(ErrorHistogram::bins, 0);
    return tbb::parallel_reduce(Range(0, tested[0].size(), 8192), none, add, both);
}

} // namespace fernlicht
