#include "metrics/road/lit_line.h"

namespace fernlicht {
namespace {

/// Extends the lit part by what is lit between `from` and `to`; `unlit_m` is the unlit length so far.
void add_stretch(LitLine& result, double& unlit_m, double from_m, double to_m) {
    if (!result.lit)
        result.first_m = from_m;
    result.lit = true;
    result.lit_m += to_m - from_m;
    result.last_m = to_m;
    result.unlit_before_last_m = unlit_m;
}

void add_segment(LitLine& result, double& unlit_m, const LineSample& a, const LineSample& b, double limit_lx) {
    const bool a_lit = *a.lx >= limit_lx;
    const bool b_lit = *b.lx >= limit_lx;
    const double length_m = b.at_m - a.at_m;
    if (a_lit == b_lit) {
        a_lit ? add_stretch(result, unlit_m, a.at_m, b.at_m) : void(unlit_m += length_m);
        return;
    }
    const double crossing_m = a.at_m + length_m * crossing_share(*a.lx, *b.lx, limit_lx);
    if (a_lit) {
        add_stretch(result, unlit_m, a.at_m, crossing_m);
        unlit_m += b.at_m - crossing_m;
    } else {
        unlit_m += crossing_m - a.at_m;
        add_stretch(result, unlit_m, crossing_m, b.at_m);
    }
}

} // namespace

LitLine lit_line(const std::vector<LineSample>& line, double limit_lx) {
    LitLine result;
    double unlit_m = 0.0;
    const LineSample* before = nullptr;
    for (const LineSample& sample : line) {
        if (before != nullptr && before->lx && sample.lx)
            add_segment(result, unlit_m, *before, sample, limit_lx);
        else if (sample.lx && *sample.lx >= limit_lx)
            add_stretch(result, unlit_m, sample.at_m, sample.at_m);
        if (sample.lx)
            result.lit_at_end = *sample.lx >= limit_lx;
        before = &sample;
    }
    return result;
}

} // namespace fernlicht
