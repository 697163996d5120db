// What is said of pictures of one straight edge whose right values are known.
#include "runner/experiments/accuracy/edge_errors.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

struct SlantedEdge {
    Image<float> by_centre, shifted; ///< 10 lx on one side of the edge and none on the other; shifted: a quarter of a pixel is dark more
    ReferenceImage areas;
};

SlantedEdge slanted_edge(double direction_rad) {
    constexpr int size = 200, parts = 32;
    SlantedEdge edge{Image<float>(size, size), Image<float>(size, size), {}};
    edge.areas.illuminance_lx.mean = Image<float>(size, size);
    edge.areas.mixed = Image<std::uint8_t>(size, size);
    const auto inside = [&](double x, double y) { // pixels from the edge
        return (x - 0.5 * size) * std::cos(direction_rad) + (y - 0.5 * size) * std::sin(direction_rad);
    };
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            int lit = 0;
            for (int i = 0; i < parts; ++i)
                for (int k = 0; k < parts; ++k)
                    lit += inside(x + (i + 0.5) / parts, y + (k + 0.5) / parts) > 0.0 ? 1 : 0;
            edge.areas.illuminance_lx.mean.at(x, y) = 10.0F * static_cast<float>(lit) / static_cast<float>(parts * parts);
            edge.areas.mixed.at(x, y) = lit > 0 && lit < parts * parts ? shadow_edge : 0;
            edge.by_centre.at(x, y) = inside(x + 0.5, y + 0.5) > 0.0 ? 10.0F : 0.0F;
            edge.shifted.at(x, y) = inside(x + 0.5, y + 0.5) > 0.25 ? 10.0F : 0.0F;
        }
    return edge;
}

TEST(EdgeErrors, OneSampleIsRightInTheMeanOfSumsAndTooDarkInThatOfShares) {
    EdgeErrorFold centre("centre", 0.05), shifted("shifted", 0.05);
    for (const double direction : {0.3, 1.1, 2.0, 4.4, 5.9}) {
        const SlantedEdge edge = slanted_edge(direction);
        centre.add(edge.by_centre, edge.by_centre, edge.areas);
        shifted.add(edge.shifted, edge.by_centre, edge.areas);
    }
    const EdgeRow one = centre.finish(), dark = shifted.finish();
    EXPECT_GT(one.shadow.pixels, 1000U);
    EXPECT_EQ(one.surfaces.pixels, 0U);
    EXPECT_LT(std::abs(one.shadow.mean), 3.0 * one.shadow.mean_standard_error);
    EXPECT_LT(one.shadow.mean_standard_error, 0.02);
    EXPECT_GT(one.shadow.absolute, 0.3);
    EXPECT_NEAR(one.shadow.mean_of_shares, std::log(2.0) - 1.0, 0.05);
    EXPECT_EQ(one.shadow.beyond_ray, 0.0);
    EXPECT_LT(std::abs(one.beside.mean), 1e-6);
    // A quarter of a pixel along the edge, of which half is lit; where the edge is slanted some of it is beside the marked pixels.
    EXPECT_NEAR(dark.shadow.beyond_ray, -0.4, 0.1);
    EXPECT_LT(dark.shadow.beyond_ray, -5.0 * dark.shadow.beyond_ray_standard_error);
    EXPECT_LE(dark.beside.mean, 0.0);
    EXPECT_NEAR(dark.shadow.mean, one.shadow.mean + dark.shadow.beyond_ray, 1e-9);
}

} // namespace
} // namespace fernlicht
