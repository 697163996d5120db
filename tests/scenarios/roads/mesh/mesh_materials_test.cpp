// R_L of the road's materials in EN 1436's 30 m geometry, and what lanes and paint are made of.
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace fernlicht {
namespace {

/// L / E_perp in mcd/m2/lx, light at 1.24 degrees and eye at 2.29 degrees above the surface, both in one vertical plane.
double total_rl_mcd(const Material& material) {
    const double incidence_rad = 1.24 * 3.14159265358979323846 / 180.0, view_rad = 2.29 * 3.14159265358979323846 / 180.0;
    const double y = 0.2126 * static_cast<double>(material.albedo.r) + 0.7152 * static_cast<double>(material.albedo.g) +
                     0.0722 * static_cast<double>(material.albedo.b);
    const double diffuse = y * std::sin(incidence_rad) / 3.14159265358979323846;
    const double retro =
        static_cast<double>(material.retro_rl) * std::exp((static_cast<double>(material.retro_reference_rad) - (view_rad - incidence_rad)) /
                                                          static_cast<double>(material.retro_falloff_rad));
    return 1000.0 * (diffuse + retro);
}

const Material& named(const std::vector<Material>& all, const std::string& name) {
    for (const Material& material : all)
        if (material.name == name)
            return material;
    throw std::out_of_range(name);
}

TEST(MeshMaterials, RoadSurfacesHaveTheirRl) {
    const std::vector<Material> all = road_materials();
    EXPECT_NEAR(total_rl_mcd(named(all, "asphalt")), 15.0, 0.01);
    EXPECT_NEAR(total_rl_mcd(named(all, "marking-white")), 150.0, 0.1);
    EXPECT_NEAR(total_rl_mcd(named(all, "marking-yellow")), 120.0, 0.1);
}

TEST(MeshMaterials, AsphaltsDiffusePartAloneIsTooDark) {
    Material diffuse = named(road_materials(), "asphalt");
    diffuse.retro_rl = 0.0F;
    EXPECT_NEAR(total_rl_mcd(diffuse), 0.551, 0.001); // 0.08 sin(1.24 deg) / pi
}

TEST(MeshMaterials, AllAreNamedAndPhysical) {
    for (const Material& material : road_materials()) {
        EXPECT_FALSE(material.name.empty());
        for (const float albedo : {material.albedo.r, material.albedo.g, material.albedo.b}) {
            EXPECT_GT(albedo, 0.0F);
            EXPECT_LT(albedo, 1.0F);
        }
        EXPECT_GE(material.retro_rl, 0.0F);
    }
}

TEST(MeshMaterials, BoardsReturnRa2AtTwentyMinutes) {
    const Material board = named(road_materials(), "board");
    EXPECT_EQ(board.kind, SurfaceKind::board);
    EXPECT_FLOAT_EQ(board.retro_rl, 180.0F);
    EXPECT_NEAR(static_cast<double>(board.retro_reference_rad), 0.33 * 3.14159265358979323846 / 180.0, 1e-7);
}

TEST(MeshMaterials, LaneTypes) {
    EXPECT_EQ(lane_material("driving"), RoadMaterial::asphalt);
    EXPECT_EQ(lane_material("shoulder"), RoadMaterial::asphalt);
    EXPECT_EQ(lane_material("sidewalk"), RoadMaterial::concrete);
    EXPECT_EQ(lane_material("median"), RoadMaterial::verge);
    EXPECT_EQ(lane_material("none"), RoadMaterial::verge);
    EXPECT_EQ(marking_material("yellow"), RoadMaterial::marking_yellow);
    EXPECT_EQ(marking_material("standard"), RoadMaterial::marking_white);
}

} // namespace
} // namespace fernlicht
