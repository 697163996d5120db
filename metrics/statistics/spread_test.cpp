#include "metrics/statistics/spread_test.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <stdexcept>

namespace fernlicht {
namespace {

void check(const SampleSpread& spread) {
    if (spread.count < 1 || !std::isfinite(spread.variance) || spread.variance < 0.0)
        throw std::invalid_argument("spread_test: a count below 1, or a variance that is negative or not finite");
}

/// Of one tail of one test.
double tail(double false_alarm, std::size_t comparisons) {
    if (!(false_alarm > 0.0 && false_alarm < 1.0) || comparisons < 1)
        throw std::invalid_argument("spread_test: no comparisons, or a false alarm's probability outside 0..1");
    return 0.5 * false_alarm / static_cast<double>(comparisons);
}

} // namespace

std::optional<SpreadTest> spread_test(const SampleSpread& a, const SampleSpread& b, double false_alarm, std::size_t comparisons) {
    check(a);
    check(b);
    static_cast<void>(tail(false_alarm, comparisons)); // refuses what is none, with and without a spread
    SpreadTest test;
    test.freedom = a.count + b.count - 2;
    const double squares = (a.count - 1) * a.variance + (b.count - 1) * b.variance;
    if (test.freedom == 0 || !(squares > 0.0))
        return std::nullopt;
    test.standard_error = std::sqrt(squares / test.freedom * (1.0 / a.count + 1.0 / b.count));
    test.bound = student_bound(test.freedom, false_alarm, comparisons);
    return test;
}

double student_bound(int freedom, double false_alarm, std::size_t comparisons) {
    if (freedom < 1)
        throw std::invalid_argument("student_bound: no degrees of freedom");
    return boost::math::quantile(boost::math::complement(boost::math::students_t(freedom), tail(false_alarm, comparisons)));
}

double normal_bound(double false_alarm, std::size_t comparisons) {
    return boost::math::quantile(boost::math::complement(boost::math::normal(), tail(false_alarm, comparisons)));
}

} // namespace fernlicht
