#include "metrics/strictness/strictness_classes.h"

namespace fernlicht {
namespace {

using Kind = StrictnessNode::Kind;

StrictnessNode every(double absolute, double relative) { return {.kind = Kind::every, .bound = {absolute, relative}}; }

StrictnessNode percentage(double percent, double absolute, double relative, bool shift) {
    return {.kind = Kind::percentage, .bound = {absolute, relative}, .percent = percent, .one_pixel_shift = shift};
}

StrictnessNode joined(Kind kind, std::vector<StrictnessNode> children) { return {.kind = kind, .children = std::move(children)}; }

} // namespace

const std::vector<StrictnessClass>& strictness_classes() {
    static const std::vector<StrictnessClass> classes{
        // "Same inputs, same backend, same driver, same kind of CPU: same bytes."
        {"identical", "the same bytes, as one machine promises for one drive", every(0.0, 0.0), every(0.0, 0.0)},
        // As accepted references are judged: a thousandth is what rounding in another order makes of a sum of lamps, 1e-4 lx where there is
        // next
        // to no light, and one pixel in 10 000 is an edge where another triangle wins. A thousandth is a tenth of a level: one level by
        // rounding.
        {"same-driver", "what another patch level of a driver or a library may round otherwise", percentage(0.01, 1.0, 0.0, false),
         percentage(0.01, 1e-4, 1e-3, false)},
        // Half of the 2 % that must never pass. 1 % of light is 255 * 0.01 / 2.4 = 1.1 levels at white: 2 with rounding. Either all pixels
        // keep it,
        // or, since edges fall otherwise in another rasteriser, 99 of 100 do while edges may move by one pixel.
        {"same-light", "another technique, rasteriser or GPU that promises the same light to 1 %",
         joined(Kind::any, {every(2.0, 0.0), percentage(1.0, 2.0, 0.0, true)}),
         joined(Kind::any, {every(0.01, 0.01), percentage(1.0, 0.01, 0.01, true)})},
        // A tenth of the light is near what an eye at night tells apart in one place; at white it is 255 * 0.1 / 2.4 = 11 levels, and 8 a
        // tenth at half
        // of white. What breaks it may be small (2 % of the pixels), but not glaring: four times as much in one pixel of a thousand.
        {"same-picture", "what a person takes for the same picture, another exposure of edges and texture included",
         joined(Kind::all, {percentage(2.0, 8.0, 0.0, true), percentage(0.1, 32.0, 0.0, true)}),
         joined(Kind::all, {percentage(2.0, 0.1, 0.1, true), percentage(0.1, 0.1, 0.4, true)})}};
    return classes;
}

} // namespace fernlicht
