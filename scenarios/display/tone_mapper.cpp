#include "scenarios/display/tone_mapper.h"

#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// A histogram curve that is not found yet is linear.
ToneMapperKind shape_of(const ToneMapper& mapper) {
    return mapper.kind == ToneMapperKind::histogram && mapper.curve.empty() ? ToneMapperKind::linear : mapper.kind;
}

struct CurvePlace {
    ToneKnot from;
    double slope = 1.0;
};

/// The straight piece of the curve, in logarithms, over `x` by `along`: a knot's luminance or its share. Below the first knot: slope 1.
template <class Along> CurvePlace piece_at(const std::vector<ToneKnot>& curve, double x, Along along) {
    const auto next = std::upper_bound(curve.begin(), curve.end(), x, [&](double at, const ToneKnot& knot) { return at < along(knot); });
    if (next == curve.begin())
        return {curve.front(), 1.0};
    const auto after = next == curve.end() ? next - 1 : next;
    const ToneKnot &a = *(after - 1), &b = *after;
    return {a, (b.ln_share - a.ln_share) / (b.ln_luminance - a.ln_luminance)};
}

} // namespace

std::string_view name(ToneMapperKind kind) {
    constexpr std::string_view names[] = {"linear", "rational", "logarithmic", "histogram"};
    return names[static_cast<std::size_t>(kind)];
}

double toned(const ToneMapper& mapper, double l) {
    if (!(l > 0.0))
        return 0.0;
    switch (shape_of(mapper)) {
    case ToneMapperKind::linear:
        return photometry::tone_linear(l, mapper.l_max_cdm2);
    case ToneMapperKind::rational:
        return photometry::tone_rational(l, mapper.l_max_cdm2, mapper.s);
    case ToneMapperKind::logarithmic:
        return std::log1p(mapper.s * (std::min(l, mapper.l_max_cdm2) / mapper.l_max_cdm2)) /
               std::log1p(mapper.s); // tone_logarithmic to the last digit
    case ToneMapperKind::histogram:
        break;
    }
    if (l >= mapper.l_max_cdm2)
        return 1.0;
    const CurvePlace piece = piece_at(mapper.curve, std::log(l), [](const ToneKnot& knot) { return knot.ln_luminance; });
    return std::min(std::exp(piece.from.ln_share + piece.slope * (std::log(l) - piece.from.ln_luminance)), 1.0);
}

std::optional<double> untoned(const ToneMapper& mapper, double d) {
    if (!(d >= 0.0 && d <= 1.0))
        return std::nullopt;
    if (d == 0.0 || d == 1.0)
        return d * mapper.l_max_cdm2;
    switch (shape_of(mapper)) {
    case ToneMapperKind::linear:
        return d * mapper.l_max_cdm2;
    case ToneMapperKind::rational:
        return d * mapper.l_max_cdm2 / (mapper.s * (1.0 - d) + d);
    case ToneMapperKind::logarithmic:
        return mapper.l_max_cdm2 / mapper.s * std::expm1(d * std::log1p(mapper.s));
    case ToneMapperKind::histogram:
        break;
    }
    const CurvePlace piece = piece_at(mapper.curve, std::log(d), [](const ToneKnot& knot) { return knot.ln_share; });
    return std::exp(piece.from.ln_luminance + (std::log(d) - piece.from.ln_share) / piece.slope);
}

double contrast_kept(const ToneMapper& mapper, double l) {
    const double x = l / mapper.l_max_cdm2;
    if (!(x < 1.0))
        return 0.0;
    switch (shape_of(mapper)) {
    case ToneMapperKind::linear:
        return 1.0;
    case ToneMapperKind::rational:
        return 1.0 / ((mapper.s - 1.0) * x + 1.0);
    case ToneMapperKind::logarithmic:
        return mapper.s * x / (1.0 + mapper.s * x) / std::log1p(mapper.s * x);
    case ToneMapperKind::histogram:
        break;
    }
    return piece_at(mapper.curve, std::log(l), [](const ToneKnot& knot) { return knot.ln_luminance; }).slope;
}

double contrast_kept(const ToneMapper& mapper, double l, double black_share) {
    const double light = (1.0 - black_share) * toned(mapper, l);
    return light > 0.0 ? contrast_kept(mapper, l) * light / (light + black_share) : 0.0;
}

} // namespace fernlicht
