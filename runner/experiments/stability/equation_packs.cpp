// The same text over packs: compiled once for each level, and nothing else in it.
#include "scenarios/packs/photometry.h"

namespace fernlicht::packs::FERNLICHT_LEVEL {
namespace photometry {

#define FN inline
#include "renderer/shaders/equation_calls.glsl"
#undef FN

} // namespace photometry

void equation_values(int equation, const float* arguments, float* values, std::size_t points) {
    for (std::size_t first = 0; first < points; first += lanes) {
        const auto four = [&](std::size_t slot) {
            return photometry::vec4(load(arguments + slot * points + first), load(arguments + (slot + 1) * points + first),
                                    load(arguments + (slot + 2) * points + first), load(arguments + (slot + 3) * points + first));
        };
        const photometry::vec4 value = photometry::equation_value(equation, four(0), four(4), four(8), four(12));
        store(value.x, values + first);
        store(value.y, values + points + first);
        store(value.z, values + 2 * points + first);
        store(value.w, values + 3 * points + first);
    }
}

} // namespace fernlicht::packs::FERNLICHT_LEVEL
