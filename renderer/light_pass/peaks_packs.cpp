#include "renderer/light_pass/peaks_packs.h"

#include "scenarios/packs/pack.h"

namespace fernlicht::packs::FERNLICHT_LEVEL {
namespace {

float sum(Floats a) {
    float total = 0.0F;
    for (std::size_t i = 0; i < lanes; ++i)
        total += a.v[i];
    return total;
}

} // namespace

void stream(const float* a, const float* b, float* to, std::size_t count) {
    for (std::size_t i = 0; i < count; i += lanes)
        store(load(a + i) + load(b + i), to + i);
}

float look_up(const float* table, std::size_t count, std::size_t steps) {
    std::int32_t all[lanes];
    for (std::size_t i = 0; i < lanes; ++i)
        all[i] = static_cast<std::int32_t>(i);
    const Ints lane = load(all);
    Floats left = 0.0, right = 0.0;
    for (std::size_t step = 0, first = 0; step < steps; ++step) {
        const Pair found = gather_pair(table, Ints(static_cast<std::int32_t>(first)) + lane);
        left += found.first;
        right += found.second;
        first = first + 2 * lanes < count ? first + lanes : 0;
    }
    return sum(left + right);
}

float multiply_and_add(float a, float b, std::size_t steps) {
    const Floats by = a, more = b;
    Floats x0 = 0.0, x1 = a, x2 = b, x3 = 1.0, x4 = 2.0, x5 = 3.0, x6 = 4.0, x7 = 5.0, x8 = 6.0, x9 = 7.0, x10 = 8.0, x11 = 9.0;
    const auto next = [&](Floats& x) { x = x * by + more; };
    const auto all = [&](auto&... x) { (next(x), ...); };
    for (std::size_t step = 0; step < steps; ++step)
        all(x0, x1, x2, x3, x4, x5, x6, x7, x8, x9, x10, x11);
    return sum(x0 + x1 + x2 + x3 + x4 + x5 + x6 + x7 + x8 + x9 + x10 + x11);
}

float divide(float a, std::size_t steps) {
    const Floats what = a;
    Floats x0 = a, x1 = 1.0, x2 = 2.0, x3 = 3.0, x4 = 4.0, x5 = 5.0, x6 = 6.0, x7 = 7.0;
    const auto all = [&](auto&... x) { ((x = what / x), ...); };
    for (std::size_t step = 0; step < steps; ++step)
        all(x0, x1, x2, x3, x4, x5, x6, x7);
    return sum(x0 + x1 + x2 + x3 + x4 + x5 + x6 + x7);
}

} // namespace fernlicht::packs::FERNLICHT_LEVEL
