// Our own lamps against the rows of their regulations, as sampled from the table that is shipped, with the margins printed.
#include "scenarios/lamps/lamp_model.h"

#include "tests/scenarios/lamps/regulation_rows.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <iostream>
#include <map>

namespace fernlicht {
namespace {

using namespace regulation;

constexpr double step_deg = 0.05; // along segments and across zones; the texts give none

std::filesystem::path shipped(const std::string& name) {
    return std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/lamps" / (name + ".ies");
}

const CandelaTable& table(const std::string& name) {
    static std::map<std::string, CandelaTable> tables;
    auto [it, added] = tables.try_emplace(name);
    if (added)
        it->second = read_lamp(shipped(name)).table;
    return it->second;
}

std::vector<double> samples(double from, double to) {
    std::vector<double> all;
    const int n = std::max(1, static_cast<int>(std::ceil((to - from) / step_deg - 1e-9)));
    for (int i = 0; i <= n; ++i)
        all.push_back(from + (to - from) * i / n);
    return all;
}

struct Span {
    double low = none, high = 0.0;
    void add(double cd) {
        low = std::min(low, cd);
        high = std::max(high, cd);
    }
};

Span over(const CandelaTable& t, const Row& row) {
    Span span;
    for (const double v : samples(row.v_from, row.v_to))
        for (const double h : samples(row.h_from, row.h_to))
            span.add(intensity_cd(t, h, v));
    return span;
}

void print(const std::string& lamp, const std::string& row, double found, const std::string& limit, double limit_cd) {
    std::cout << fmt::format("    {:12} {:22} {:9.0f} cd, {} {:.0f} ({:+.0f} %)\n", lamp, row, found, limit, limit_cd,
                             100.0 * (found / limit_cd - 1.0));
}

void expect_rows(const std::string& lamp, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        const Span span = over(table(lamp), row);
        EXPECT_GE(span.low, row.min_cd) << row.name;
        EXPECT_LE(span.high, row.max_cd) << row.name;
        if (row.min_cd > 0.0)
            print(lamp, row.name, span.low, "at least", row.min_cd);
        if (row.max_cd < none)
            print(lamp, row.name, span.high, "at most", row.max_cd);
    }
}

std::vector<std::string> broken(const CandelaTable& t, const std::vector<Row>& rows) {
    std::vector<std::string> names;
    for (const Row& row : rows)
        if (const Span span = over(t, row); span.low < row.min_cd || span.high > row.max_cd)
            names.push_back(row.name);
    return names;
}

/// Even-odd rule; the boundary is sampled by itself.
bool inside(const std::vector<std::pair<double, double>>& polygon, double h, double v) {
    bool in = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const auto [hi, vi] = polygon[i];
        const auto [hj, vj] = polygon[j];
        if ((vi > v) != (vj > v) && h < hi + (hj - hi) * (v - vi) / (vj - vi))
            in = !in;
    }
    return in;
}

double most_in_zone_3(const CandelaTable& t) {
    Span span;
    for (const double v : samples(0, 4))
        for (const double h : samples(-8, 8))
            if (inside(zone_3, h, v))
                span.add(intensity_cd(t, h, v));
    for (std::size_t i = 0; i < zone_3.size(); ++i) {
        const auto [h0, v0] = zone_3[i];
        const auto [h1, v1] = zone_3[(i + 1) % zone_3.size()];
        for (const double s : samples(0.0, 10.0))
            span.add(intensity_cd(t, h0 + (h1 - h0) * s / 10.0, v0 + (v1 - v0) * s / 10.0));
    }
    return span.high;
}

TEST(RegulationRows, LampsThatAreWrongBreakThem) {
    const CandelaTable& low = table("halogen-low");
    EXPECT_THAT(broken(low, r112_b), testing::IsEmpty());
    EXPECT_THAT(broken(mirrored(low), r112_b), testing::IsSupersetOf({"75R", "75L", "50L"}));
    EXPECT_THAT(broken(scaled(low, 0.3), r112_b), testing::IsSupersetOf({"75R", "50R", "25L", "25R", "zone IV"}));
    EXPECT_THAT(broken(scaled(low, 1.5), r112_b), testing::Contains("B50L"));
    CandelaTable raised = low; // aimed at the horizon in place of 1 % down
    for (double& v : raised.v_deg)
        v += 0.57;
    EXPECT_GT(most_in_zone_3(raised), zone_3_max_cd);
}

void expect_glow(const std::string& lamp) {
    const CandelaTable& t = table(lamp);
    const double most = most_in_zone_3(t);
    EXPECT_LE(most, zone_3_max_cd);
    print(lamp, "zone III", most, "at most", zone_3_max_cd);
    for (const Sum& sum : overhead) {
        double cd = 0.0;
        for (const auto& [h, v] : sum.points)
            cd += intensity_cd(t, h, v);
        EXPECT_GE(cd, sum.min_cd) << sum.name;
        print(lamp, sum.name, cd, "at least", sum.min_cd);
    }
}

TEST(LampModel, ShippedFilesAreWhatTheModelWritesByteForByte) {
    const auto folder = std::filesystem::path(testing::TempDir()) / "lamp_model";
    std::filesystem::create_directories(folder);
    for (const LampModel& m : lamp_models()) {
        const auto path = folder / (m.name + ".ies");
        write_lamp(lamp_of_model(m), path);
        FilesRead opened;
        EXPECT_TRUE(read_file(path, opened) == read_file(shipped(m.name), opened)) << m.name;
        EXPECT_LT(opened.back().bytes, 1'000'000u);
    }
    std::filesystem::remove_all(folder);
}

TEST(LampModel, ShippedFilesSayThatTheyAreAModel) {
    for (const LampModel& m : lamp_models()) {
        const LampFile lamp = read_lamp(shipped(m.name));
        EXPECT_THAT(lamp.labels, testing::Contains(testing::Pair("TEST", testing::HasSubstr("a model, not a measurement"))));
        EXPECT_EQ(lamp.table, lamp_of_model(m).table) << m.name; // no digit is lost
        EXPECT_TRUE(lamp.notes.empty()) << m.name;
    }
}

TEST(LampModel, HalogenLowBeamMeetsR112ClassB) {
    expect_rows("halogen-low", r112_b);
    expect_glow("halogen-low");
    const CandelaTable& t = table("halogen-low");
    const double twice_50r = 2.0 * intensity_cd(t, 1.72, -0.86);
    const double most = over(t, {"zone I", -9, 9, -4, -1.72}).high;
    EXPECT_LT(most, twice_50r);
    print("halogen-low", "zone I", most, "below", twice_50r);
}

TEST(LampModel, XenonLowBeamMeetsR98ClassD) {
    expect_rows("xenon-low", r98_d);
    expect_glow("xenon-low");
}

void expect_driving(const std::string& lamp, const Driving& limits) {
    const CandelaTable& t = table(lamp);
    const Peak peak = peak_of(t);
    EXPECT_GE(peak.cd, limits.imax_min);
    EXPECT_LE(peak.cd, driving_imax_max);
    EXPECT_GE(intensity_cd(t, 0, 0), 0.8 * peak.cd);
    print(lamp, "Imax", peak.cd, "at least", limits.imax_min);
    print(lamp, "HV", intensity_cd(t, 0, 0), "at least", 0.8 * peak.cd);
    for (const auto& [h, least] : {std::pair{2.5, limits.at_2_5}, {5.0, limits.at_5}})
        for (const double side : {-1.0, 1.0}) {
            const double least_on_way = over(t, {"", std::min(side * h, 0.0), std::max(side * h, 0.0), 0, 0}).low;
            EXPECT_GE(least_on_way, least) << side * h;
            print(lamp, fmt::format("H {:+.1f}", side * h), least_on_way, "at least", least);
        }
}

TEST(LampModel, HighBeamsMeetTheirDrivingRows) {
    expect_driving("halogen-high", driving_b);
    expect_driving("xenon-high", driving_d);
}

/// Sharpness: the largest fall of log10 I over 0.1 degrees upwards, and where the steepest point is.
struct Edge {
    double sharpness = 0.0, inflection_v_deg = 0.0;
};
Edge edge_at(const CandelaTable& t, double h) {
    Edge edge;
    for (double v = -2.0; v <= 1.5; v += 0.01) {
        const double fall = std::log10(intensity_cd(t, h, v)) - std::log10(intensity_cd(t, h, v + 0.1));
        if (fall > edge.sharpness)
            edge = {fall, v + 0.05};
    }
    return edge;
}

TEST(LampModel, CutOffIsSharpStraightAndOnePercentDown) {
    for (const std::string lamp : {"halogen-low", "xenon-low"}) {
        const Edge edge = edge_at(table(lamp), -2.5);
        EXPECT_GE(edge.sharpness, 0.13) << lamp;
        EXPECT_LE(edge.sharpness, 0.40) << lamp;
        std::cout << fmt::format("    {:12} sharpness G {:.3f}, inflection at V {:.2f}\n", lamp, edge.sharpness, edge.inflection_v_deg);
        for (const double h : {-1.5, -2.5, -3.5}) // linearity: within 0.2 degrees of each other
            EXPECT_NEAR(edge_at(table(lamp), h).inflection_v_deg, -0.57, 0.05) << lamp << h;
    }
}

TEST(LampModel, CutOffRisesToTheKerbByFifteenDegrees) {
    for (const std::string lamp : {"halogen-low", "xenon-low"}) {
        const double at_1 = edge_at(table(lamp), 1.0).inflection_v_deg, at_3 = edge_at(table(lamp), 3.0).inflection_v_deg;
        EXPECT_NEAR(std::atan((at_3 - at_1) / 2.0) * 180.0 / 3.14159265, 15.0, 1.5) << lamp;
        EXPECT_GE(edge_at(table(lamp), 2.0).sharpness, 0.08) << lamp;
        EXPECT_GT(peak_of(table(lamp)).h_deg, 0.0) << lamp;
    }
}

TEST(LampModel, FluxAndMaximaAreThoseOfCommonLamps) {
    const auto expect_between = [](const std::string& lamp, double lm_from, double lm_to, double lx_from, double lx_to) {
        const double flux = flux_lm(table(lamp));
        const Peak peak = peak_of(table(lamp));
        EXPECT_THAT(flux, testing::AllOf(testing::Ge(lm_from), testing::Le(lm_to))) << lamp;
        EXPECT_THAT(peak.cd / 625.0, testing::AllOf(testing::Ge(lx_from), testing::Le(lx_to))) << lamp;
        std::cout << fmt::format("    {:12} {:.0f} lm, {:.1f} lx at 25 m at H {:.2f} V {:.2f}\n", lamp, flux, peak.cd / 625.0, peak.h_deg,
                                 peak.v_deg);
    };
    expect_between("halogen-low", 400, 700, 30, 50);
    expect_between("xenon-low", 900, 1300, 60, 70);
    expect_between("halogen-high", 400, 900, 64, 120);
    expect_between("xenon-high", 900, 1700, 120, 220);
}

TEST(LampModel, TablesFollowTheModelBetweenTheirSamples) {
    for (const LampModel& m : lamp_models()) {
        const CandelaTable& t = table(m.name);
        check_invariants(t);
        const double peak = peak_of(t).cd;
        for (double v = -20.9; v < 16.0; v += 0.173)
            for (double h = -51.9; h < 52.0; h += 0.219)
                ASSERT_NEAR(intensity_cd(t, h, v), model_intensity_cd(m, h, v), 0.01 * peak) << m.name << " H " << h << " V " << v;
    }
}

TEST(LampModel, LightEndsSmoothlyAtTheEdgesOfItsTable) {
    for (const LampModel& m : lamp_models()) {
        const CandelaTable& t = table(m.name);
        for (const double h : t.h_deg)
            EXPECT_EQ(intensity_cd(t, h, t.v_deg.front()) + intensity_cd(t, h, t.v_deg.back()), 0.0);
        for (const double v : t.v_deg)
            EXPECT_EQ(intensity_cd(t, t.h_deg.front(), v) + intensity_cd(t, t.h_deg.back(), v), 0.0);
    }
}

} // namespace
} // namespace fernlicht
