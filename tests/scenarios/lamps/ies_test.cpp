// IES LM-63: what each edition and type means, and what real files do to it.
#include "scenarios/values/refusals.h"
#include "tests/scenarios/lamps/lamp_trial.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <tuple>

namespace fernlicht {
namespace {

using testing::HasSubstr, testing::Not;

class IesFile : public LampTrial {};

/// Type A, H -1 0 1, V -2 0 2; ten times column plus row: 11 at the lower left, 33 at the upper right.
constexpr const char* small_numbers = "1 -1 1 3 3 3 2 0 0 0\n1 1 55\n-2 0 2\n-1 0 1\n11 12 13\n21 22 23\n31 32 33\n";
std::string small(const std::string& head = "IESNA:LM-63-2002\n[TEST] t\n[LUMCAT] probe\n") { return head + "TILT=NONE\n" + small_numbers; }

TEST_F(IesFile, TypeAIsReadAsItStands) {
    const LampFile lamp = read("a.ies", small());
    EXPECT_EQ(lamp.format, "IES LM-63-2002, type A");
    EXPECT_EQ(lamp.name, "probe");
    EXPECT_EQ(lamp.table, (CandelaTable{{-1, 0, 1}, {-2, 0, 2}, {11, 21, 31, 12, 22, 32, 13, 23, 33}, {}, BetweenSamples::linear_cd}));
    EXPECT_FALSE(lamp.declared_flux_lm) << "-1 lumens is absolute photometry";
    ASSERT_EQ(lamp.opened.size(), 1U);
    EXPECT_EQ(lamp.opened[0].bytes, small().size());
    EXPECT_THAT(lamp.notes, testing::IsEmpty());
}

TEST_F(IesFile, EditionsAreToldByTheirHeaders) {
    const auto format = [&](const std::string& head) { return read("e.ies", small(head)).format; };
    EXPECT_EQ(format("some lamp\nmeasured 1987\n"), "IES LM-63-1986, type A");
    EXPECT_EQ(format("IESNA91\n"), "IES LM-63-1991, type A");
    EXPECT_EQ(format("IESNA95\n"), "IES LM-63-1995, type A");
    EXPECT_EQ(format(" IESNA:LM-63-1995\n"), "IES LM-63-1995, type A");
    EXPECT_EQ(format("IESNA:LM-63-95\n"), "IES LM-63-1995, type A");
    EXPECT_EQ(format("IESNA: LM-63-2002\n"), "IES LM-63-2002, type A");
    EXPECT_EQ(format("IES:LM-63-2019\n"), "IES LM-63-2019, type A");
    EXPECT_EQ(format("IESNA:LM-63-2002   \n"), "IES LM-63-2002, type A");
    EXPECT_EQ(format("IESNA:LM-63\n"), "IES LM-63-2002, type A");
    EXPECT_THAT(all_notes(read("e.ies", small("IES:LM-63-2031\n"))), HasSubstr("edition of 2031"));
}

TEST_F(IesFile, FactorsMultiplyOnceAndTheDeclaredFluxIsThatOfAllLamps) {
    const auto peak = [&](const std::string& head, const std::string& ballast_line) {
        return peak_of(read("f.ies", head + "TILT=NONE\n2 500 2.0 2 2 3 1 0 0 0\n" + ballast_line + "\n-1 1\n-1 1\n5 6\n7 100\n").table).cd;
    };
    EXPECT_DOUBLE_EQ(peak("", "0.9 1.1 60"), 100 * 2.0 * 0.9 * 1.1);
    EXPECT_DOUBLE_EQ(peak("IESNA91\n", "0.9 1.1 60"), 100 * 2.0 * 0.9 * 1.1);
    EXPECT_DOUBLE_EQ(peak("IESNA:LM-63-1995\n", "0.9 1.1 60"), 100 * 2.0 * 0.9);
    EXPECT_DOUBLE_EQ(peak("IESNA:LM-63-2002\n", "0.9 1.1 60"), 100 * 2.0 * 0.9);
    // 2019: the field is the file's generation type, here "accredited laboratory"; not 10 % more light.
    EXPECT_DOUBLE_EQ(peak("IES:LM-63-2019\n", "1 1.10000 60"), 100 * 2.0);
    EXPECT_DOUBLE_EQ(peak("IESNA91\n", "1 0 60"), 100 * 2.0) << "a reserved field of 0 must not darken the lamp";
    const LampFile lamp = read("f.ies", "TILT=NONE\n2 500 1 2 2 3 1 0 0 0\n1 1 60\n-1 1\n-1 1\n5 6\n7 8\n");
    EXPECT_DOUBLE_EQ(lamp.declared_flux_lm.value(), 1000.0);
}

TEST_F(IesFile, SeparatorsLineEndsAndBytesMayVary) {
    const CandelaTable table = read("a.ies", small()).table;
    std::string commas = small(), cr = small(), crlf, one_line = "IESNA:LM-63-2002\nTILT=NONE\n";
    for (char& c : commas)
        if (c == ' ')
            c = ',';
    for (char& c : cr)
        if (c == '\n')
            c = '\r';
    for (const char c : small())
        crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    for (const char c : std::string(small_numbers))
        one_line += c == '\n' ? ' ' : c;
    EXPECT_EQ(read("b.ies", commas).table, table);
    EXPECT_EQ(read("c.ies", cr).table, table);
    EXPECT_EQ(read("d.ies", crlf).table, table);
    EXPECT_EQ(read("e.ies", one_line).table, table);
    EXPECT_EQ(read("f.ies", "\xef\xbb\xbf" + small()).table, table);
    EXPECT_EQ(read("no-extension", small()).table, table) << "told by content";
    EXPECT_EQ(read("tilt.ies", "IESNA91\n tilt = none \n" + std::string(small_numbers)).table, table);
}

TEST_F(IesFile, LabelsAreKeptAsUtf8AndDimensionsAreNoMatter) {
    const LampFile lamp = read("l.ies", small("IESNA:LM-63-1995\n[MANUFAC] B\374cher \200\n[MORE] AG\n[_SECRET] x\nloose line\n"));
    ASSERT_EQ(lamp.labels.size(), 3U);
    EXPECT_EQ(lamp.labels[0], (std::pair<std::string, std::string>{"MANUFAC", "Bücher € AG"}));
    EXPECT_EQ(lamp.labels[1].first, "_SECRET");
    EXPECT_EQ(std::tuple(lamp.labels[2], lamp.name), std::tuple((std::pair<std::string, std::string>{"text", "loose line"}), "l"));
    const std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 3 2 -0.12 0 -0.34\n1 1 0\n-1 1\n-1 1\n5 6\n7 8\n";
    EXPECT_EQ(peak_of(read("d.ies", text).table).cd, 8.0);
}

TEST_F(IesFile, HalvesAreMirroredAndASinglePlaneIsRefused) {
    for (const int type : {2, 3}) {
        const LampFile lamp =
            read("m.ies", fmt::format("IESNA91\nTILT=NONE\n1 -1 1 2 3 {} 2 0 0 0\n1 1 0\n-1 1\n0 5 10\n9 9\n6 6\n3 3\n", type));
        EXPECT_THAT(all_notes(lamp), HasSubstr("mirrored"));
        EXPECT_NEAR(intensity_cd(lamp.table, -5.0, 0.0), 6.0, 0.01);
        EXPECT_NEAR(intensity_cd(lamp.table, 5.0, 0.0), 6.0, 0.01);
        EXPECT_NEAR(intensity_cd(lamp.table, -10.0, 0.0), 3.0, 0.01);
    }
    for (const int type : {2, 3})
        EXPECT_THAT(refusal("s.ies", fmt::format("IESNA91\nTILT=NONE\n1 -1 1 2 1 {} 2 0 0 0\n1 1 0\n-1 1\n0\n9 9\n", type)),
                    HasSubstr("s.ies:6: horizontal angles: found a single one"));
}

TEST_F(IesFile, AnglesAreSortedAndTypesTakenForWhatTheyAre) {
    const std::string head = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n1 1 0\n";
    const LampFile descending = read("a.ies", head + "2 0 -2\n-1 0 1\n13 12 11\n23 22 21\n33 32 31\n");
    EXPECT_EQ(descending.table, read("b.ies", small()).table);
    EXPECT_THAT(all_notes(descending), HasSubstr("vertical angles do not ascend"));
    const LampFile repeated = read("c.ies", head + "-2 0 2\n-1 1 1\n1 2 3\n4 5 6\n4 5 6\n");
    EXPECT_EQ(repeated.table.h_deg, (std::vector<double>{-1, 1}));
    EXPECT_THAT(all_notes(repeated), HasSubstr("1 horizontal angles are repeated"));
    EXPECT_THAT(refusal("d.ies", head + "-2 0 2\n-1 1 1\n1 2 3\n4 5 6\n7 8 9\n"),
                HasSubstr("d.ies:6: horizontal angles: the angle 1 is given twice"));
    const LampFile automotive = read("c.ies", "TILT=NONE\n1 -1 1 3 3 1 2 0 0 0\n1 1 55\n-2 0 2\n-1 0 1\n11 12 13\n21 22 23\n31 32 33\n");
    EXPECT_EQ(automotive.table, read("a.ies", small()).table);
    EXPECT_THAT(all_notes(automotive), HasSubstr("read as type A"));
    const LampFile luminaire = read("l.ies", "TILT=NONE\n1 -1 1 3 1 3 2 0 0 0\n1 1 55\n0 90 180\n0\n50 50 50\n");
    EXPECT_EQ(luminaire.format, "IES LM-63-1986, type C");
    EXPECT_NEAR(flux_lm(luminaire.table), 4 * pi * 50, 1e-9);
    EXPECT_THAT(refusal("m.ies", "TILT=NONE\n1 -1 1 2 1 3 2 0 0 0\n1 1 55\n100 100\n0\n50 50\n"),
                HasSubstr("m.ies:4: vertical angles: found 1 of them, expected at least 2"));
    EXPECT_THAT(refusal("n.ies", "TILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 55\n0 50\n0 0\n1 2\n1 2\n"),
                HasSubstr("n.ies:5: horizontal angles: found 1 of them, expected at least 2"));
}

TEST_F(IesFile, AllIntensitiesThatAreNoneAreTold) {
    const auto told = [&](const std::string& text) {
        std::string lines;
        for (const InputError& error : all_refusals([&] { read("w.ies", text); }))
            lines += std::string(error.what()) + "\n";
        return lines;
    };
    const std::string head = "TILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n1 1 55\n-2 0 2\n-1 0 1\n";
    const std::string two = told(head + "11 x12 13\n21 22 23\n31 32 nan\n");
    EXPECT_THAT(two,
                testing::AllOf(HasSubstr("w.ies:6:4: candela value: found 'x12'"), HasSubstr("w.ies:8:7: candela value: found 'nan'")));
    EXPECT_EQ(std::ranges::count(two, '\n'), 2);
    std::string many = "TILT=NONE\n1 -1 1 200 200 3 2 0 0 0\n1 1 55\n";
    for (int i = 0; i < 400 + 200 * 200; ++i)
        many += i < 400 ? fmt::format("{}\n", i % 200) : fmt::format("x{}\n", i);
    EXPECT_EQ(std::ranges::count(told(many), '\n'), 101);
    EXPECT_THAT(refusal("w.ies", head + "11 x12 13\n21 22 23\n31 32 nan\n"), HasSubstr("found 'x12'")) << "nobody listens";
}

/// H and V of type B's h = asin x, v = atan2(y, z).
std::pair<double, double> un_of_type_b(double h_b, double v_b) {
    const double x = std::sin(radians(h_b)), y = std::cos(radians(h_b)) * std::sin(radians(v_b)),
                 z = std::cos(radians(h_b)) * std::cos(radians(v_b));
    return {degrees(std::atan2(x, z)), degrees(std::asin(y))};
}

TEST_F(IesFile, TypeBPointsAwayFromTypeA) {
    // The same numbers read as B: its (10, 10) lies 0.21 degrees from A's, its (45, -5) 1.47 degrees.
    const auto text = [](int type) {
        std::string h = "-50 -45 -40 9 10 11 40 45 50", v = "-6 -5 -4 9 10 11", cd;
        for (int i = 0; i < 9; ++i)
            for (int j = 0; j < 6; ++j)
                cd += fmt::format("{} ", (i == 1 && j == 1) || (i == 4 && j == 4) ? 1000 : 0);
        return fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 6 9 {} 2 0 0 0\n1 1 0\n{}\n{}\n{}\n", type, v, h, cd);
    };
    const CandelaTable b = read("b.ies", text(2)).table;
    for (const auto& [h, v] : {std::pair{10.0, 10.0}, std::pair{-45.0, -5.0}}) {
        const auto [hu, vu] = un_of_type_b(h, v);
        EXPECT_NEAR(intensity_cd(b, hu, vu), 1000.0, 5.0) << h;
    }
    const auto distance = [&](double h, double v) {
        const auto [hu, vu] = un_of_type_b(h, v);
        const auto dot =
            std::cos(radians(v)) * std::cos(radians(vu)) * std::cos(radians(h - hu)) + std::sin(radians(v)) * std::sin(radians(vu));
        return degrees(std::acos(std::min(1.0, dot)));
    };
    EXPECT_NEAR(distance(10, 10), 0.21, 0.01);
    EXPECT_NEAR(distance(45, -5), 1.47, 0.01);
    EXPECT_NEAR(distance(9, -1.72), 0.02, 0.005);
}

/// A low beam's form: a cut-off with a rise to the right, a hot spot, a wide foreground.
double low_beam_cd(double h, double v) {
    const double cutoff = h > 0.0 ? std::min(h * std::tan(radians(15.0)), 2.0) : 0.0;
    const double below = 1.0 / (1.0 + std::exp((v + 0.57 - cutoff) * 12.0));
    return 40.0 + below * (26000.0 * std::exp(-(h - 1.0) * (h - 1.0) / 60.0 - (v + 1.4) * (v + 1.4) / 2.0) +
                           4000.0 * std::exp(-h * h / 700.0 - (v + 3.0) * (v + 3.0) / 20.0));
}

std::string automotive_type_b() {
    std::vector<double> h{-90, -45, -40, -35, -30, -25, -20, -15}, v{-90};
    for (int i = -40; i <= 40; ++i)
        h.push_back(i * 0.25);
    for (const double a : {15, 20, 25, 30, 35, 40, 45, 90})
        h.push_back(a);
    for (int i = -20; i <= 28; ++i)
        v.push_back(i * 0.25);
    v.push_back(90);
    std::string text = fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 100 1 {} {} 2 1 .1 .1 .1\n1 1 0\n", v.size(), h.size());
    for (const auto* axis : {&v, &h}) {
        for (const double a : *axis)
            text += fmt::format("{} ", a);
        text += "\n";
    }
    for (const double a : h)
        for (const double b : v)
            text += fmt::format("{}\n", std::abs(a) == 90 || std::abs(b) == 90 ? 0.0 : low_beam_cd(a, b));
    return text;
}

TEST_F(IesFile, ResamplingAnAutomotiveTypeBGridCostsLessThanATenthOfAPercent) {
    const LampFile lamp = read("b.ies", automotive_type_b());
    EXPECT_LT(lamp.table.cd.size(), 1'000'000U);
    double peak = 0.0;
    for (int i = -40; i <= 40; ++i)
        for (int j = -20; j <= 28; ++j)
            peak = std::max(peak, low_beam_cd(i * 0.25, j * 0.25));
    EXPECT_DOUBLE_EQ(peak_of(lamp.table).cd, peak) << "the peak sample is kept";
    // Against the native grid itself, read as type A, at directions that the resampling did not choose.
    std::string as_a = automotive_type_b();
    as_a.replace(as_a.find(" 2 1 .1"), 7, " 3 1 .1");
    const CandelaTable native = read("a.ies", as_a).table;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> h(-44.0, 44.0), v(-4.9, 6.9);
    double worst = 0.0;
    for (int i = 0; i < 100'000; ++i) {
        const double hb = h(random), vb = v(random);
        const auto [hu, vu] = un_of_type_b(hb, vb);
        worst = std::max(worst, std::abs(intensity_cd(lamp.table, hu, vu) - intensity_cd(native, hb, vb)));
    }
    EXPECT_LT(worst / peak, 1e-3);
    RecordProperty("worst_percent_of_peak", std::to_string(100.0 * worst / peak));
    RecordProperty("samples", std::to_string(lamp.table.h_deg.size()) + "x" + std::to_string(lamp.table.v_deg.size()));
    EXPECT_THAT(all_notes(lamp), HasSubstr("Resampled from type B"));
}

/// Against the integral over the file's own angles, where the border is straight: I cos h dh dv.
TEST_F(IesFile, ATypeBGridThatEndsInLightKeepsItsFlux) {
    for (const double step : {0.7, 2.5, 5.0}) {
        CandelaTable own; // h of type B is its latitude
        for (int i = 0; i <= static_cast<int>(80.0 / step); ++i)
            own.v_deg.push_back(-41.3 + i * step);
        for (int i = 0; i <= static_cast<int>(25.0 / step); ++i)
            own.h_deg.push_back(-16.2 + i * step);
        for (const double h : own.v_deg)
            for (const double v : own.h_deg)
                own.cd.push_back(1000.0 * std::exp(-h * h / 3000.0 - (v + 2.0) * (v + 2.0) / 500.0));
        const LampFile lamp =
            read("b.ies", fmt::format("IESNA91\nTILT=NONE\n1 -1 1 {} {} 2 2 0 0 0\n1 1 0\n{}\n{}\n{}\n", own.h_deg.size(), own.v_deg.size(),
                                      fmt::join(own.h_deg, " "), fmt::join(own.v_deg, " "), fmt::join(own.cd, "\n")));
        EXPECT_NEAR(flux_lm(lamp.table) / flux_lm(own), 1.0, 2e-4) << step;
    }
}

TEST_F(IesFile, PaddingWithZerosAt90IsNoData) {
    const LampFile lamp = read("b.ies", automotive_type_b());
    EXPECT_THAT(all_notes(lamp), HasSubstr("H from 45 to 90 degrees holds only zeros"));
    EXPECT_THAT(all_notes(lamp), HasSubstr("V from -90 to -5 degrees holds only zeros"));
    EXPECT_GT(intensity_cd(lamp.table, 0.0, -4.85), 100.0) << "at most a sliver of 0.1 degrees is lost along the border";
    EXPECT_EQ(intensity_cd(lamp.table, 0.0, -5.01), 0.0);
    EXPECT_EQ(intensity_cd(lamp.table, 0.0, -30.0), 0.0);
    EXPECT_EQ(intensity_cd(lamp.table, 60.0, -1.0), 0.0);
    EXPECT_EQ(intensity_cd(lamp.table, 0.0, 7.01), 0.0);
    EXPECT_LT(flux_lm(lamp.table), 2000.0) << "without the gap the foreground would be smeared down to the ground below";
    // Evenly spaced zeros at the end are data.
    const LampFile even = read("e.ies", "IESNA91\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n1 1 0\n-2 0 2\n-1 0 1\n0 0 0\n0 5 0\n0 0 0\n");
    EXPECT_TRUE(even.table.gaps.empty());
}

TEST_F(IesFile, TiltFactorsAreThoseOfTheMeasuredPosition) {
    const std::string included = "IESNA91\nTILT=INCLUDE\n1\n3\n0 15 90\n0.5 0.6 0.7\n" + std::string(small_numbers);
    EXPECT_DOUBLE_EQ(peak_of(read("i.ies", included).table).cd, 16.5);
    const LampFile without = read("w.ies", "IESNA91\nTILT=INCLUDE\n1\n2\n15 90\n0.6 0.7\n" + std::string(small_numbers));
    EXPECT_DOUBLE_EQ(peak_of(without.table).cd, 33.0);
    EXPECT_THAT(all_notes(without), HasSubstr("TILT has no factor for tilt 0, in which the lamp was measured: 1 is taken."));
    write("lamp.tlt", "1\n3\n0 15 90\n0.5 0.6 0.7\n");
    const LampFile lamp = read("f.ies", "IESNA91\nTILT=lamp.tlt\n" + std::string(small_numbers));
    EXPECT_DOUBLE_EQ(peak_of(lamp.table).cd, 16.5);
    ASSERT_EQ(lamp.opened.size(), 2U);
    EXPECT_EQ(lamp.opened[1].path.filename(), "lamp.tlt");
    EXPECT_THAT(refusal("g.ies", "IESNA91\nTILT=missing.tlt\n" + std::string(small_numbers)),
                HasSubstr("g.ies:2: TILT: there is no file 'missing.tlt'"));
    EXPECT_THAT(refusal("g.ies", "IESNA91\nTILT=" + std::string(300, 'a') + "\n" + small_numbers), HasSubstr("TILT: there is no file 'aaa"))
        << "a name that no file can have";
    EXPECT_THAT(refusal("h.ies", "IESNA91\nTILT=../../etc/passwd\n" + std::string(small_numbers)), HasSubstr("beside this one"));
    EXPECT_THAT(refusal("j.ies", "IESNA91\nTILT=\n" + std::string(small_numbers)), HasSubstr("j.ies:2: TILT: found ''"));
    write("bad.tlt", "1\n2\n0 x\n1 1\n");
    EXPECT_THAT(refusal("k.ies", "IESNA91\nTILT=bad.tlt\n" + std::string(small_numbers)), HasSubstr("bad.tlt:3:3: tilt angle: found 'x'"));
}

TEST_F(IesFile, SlightlyNegativeIntensitiesAreNoise) {
    const std::string head = "IESNA91\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n-1 1\n-1 1\n";
    const LampFile lamp = read("n.ies", head + "1000 -0.5\n5 6\n");
    EXPECT_EQ(lamp.table.at(1, 0), 0.0);
    EXPECT_THAT(all_notes(lamp), HasSubstr("1 intensity is slightly negative, down to -0.5 cd in line 7: taken as 0."));
    EXPECT_THAT(all_notes(read("two.ies", head + "1000 -0.5\n5 -0.7\n")),
                HasSubstr("2 intensities are slightly negative, down to -0.7 cd in line 8: taken as 0."));
    EXPECT_THAT(refusal("m.ies", head + "1000 -5\n5 6\n"),
                HasSubstr("m.ies:7: intensity at horizontal -1, vertical 1: is -5 cd, expected at least 0 cd"));
    // Planes one after the other, angles that descend: the line of the number itself.
    EXPECT_THAT(refusal("d.ies", "IESNA91\nTILT=NONE\n1 -1 1 2 2 3 2 0 0 0\n1 1 0\n1 -1\n1 -1\n1000 5\n6\n-7\n"),
                HasSubstr("d.ies:9: intensity at horizontal -1, vertical -1: is -7 cd"));
    EXPECT_THAT(refusal("h.ies", head + "1e15 5\n5 6\n"), HasSubstr("expected at most"));
}

/// Commas separate in IES files, so that these fail somewhere, or not at all and with a rest.
TEST_F(IesFile, DecimalCommasAndUtf16AreCalledThat) {
    const auto complaint = [&](const std::string& numbers) { return refusal("c.ies", "IESNA91\nTILT=NONE\n" + numbers); };
    const std::string says = "has decimal commas, expected points: write ";
    EXPECT_THAT(complaint("1 -1 1,0 2 2 3 2 0 0 0\n1 1 0\n-1 1\n-1 1\n5 6\n7 8\n"), HasSubstr("c.ies:3:6: " + says + "1.0 for 1,0"));
    EXPECT_THAT(complaint("1 -1 1 2 2 3 2 0 0 0\n1 1 0\n-1,5 1,5\n-1,5 1,5\n5 6\n7 8\n"),
                HasSubstr("c.ies:5:1: " + says + "-1.5 for -1,5"));
    EXPECT_THAT(complaint("1 -1 1 2 2 3 2 0 0 0\n1 1 0\n-1 1\n-1 1\n5,25 6\n7 8,5\n"), HasSubstr("c.ies:7:1: " + says + "5.25 for 5,25"));
    // Points in the angles, commas in the intensities alone.
    EXPECT_THAT(complaint("1 -1 1 2 2 3 2 0.1 0.1 0\n1 1 0\n-1.5 1.5\n-1.5 1.5\n5,25 6,0\n7,0 8,5\n"),
                HasSubstr("c.ies:7:1: " + says + "5.25 for 5,25"));
    EXPECT_THAT(complaint("1 -1 1 2 2 3 2 0.1 0.1 0\n1 1 0\n-1.5 1.5\n-1.5 1.5 5,25 6,0 7,0 8,5"), HasSubstr(says + "5.25 for 5,25"));
    EXPECT_THAT(complaint("1,-1,1,2,2,3,2,0,0,0\n1,1,0\n-1,1\n-1,1\n5,6\n7,x\n"), HasSubstr("c.ies:8:3: candela value: found 'x'"));
    EXPECT_THAT(complaint("1 -1 1 2 2 3 2 0 0 0\n1 1 0\n-1,1\n-1,1\n5,6\n7,x\n"), HasSubstr("found 'x'"));
    write("comma.tlt", "1\n2\n0,0 1,5\n1 1\n");
    EXPECT_THAT(refusal("k.ies", "IESNA91\nTILT=comma.tlt\n" + std::string(small_numbers)), HasSubstr("comma.tlt:3:1: " + says));
    for (const auto& [low, high] : {std::pair{1, 0}, std::pair{0, 1}}) // either order of bytes, with a mark and without
        for (const bool mark : {true, false}) {
            std::string bytes = mark ? (low != 0 ? "\xff\xfe" : "\xfe\xff") : "";
            for (const char c : small()) {
                const char both[2] = {high != 0 ? '\0' : c, high != 0 ? c : '\0'};
                bytes.append(both, 2);
            }
            EXPECT_THAT(refusal("u.ies", bytes), HasSubstr("u.ies: is encoded in UTF-16, expected UTF-8 or Windows-1252"));
            write("wide.tlt", bytes);
            EXPECT_THAT(refusal("k.ies", "IESNA91\nTILT=wide.tlt\n" + std::string(small_numbers)),
                        HasSubstr("wide.tlt: is encoded in UTF-16"));
        }
}

TEST_F(IesFile, MessagesNameLineAndPlace) {
    const std::string good = small();
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return refusal("x.ies", text);
    };
    EXPECT_THAT(refusal("x.ies", ""), HasSubstr("x.ies: is empty"));
    EXPECT_THAT(refusal("x.ies", "IESNA91\n[TEST] y\n"), HasSubstr("x.ies:2: TILT: the file ends before it"));
    EXPECT_THAT(with("22", "nan"), HasSubstr("x.ies:10:4: candela value: found 'nan', expected a finite number"));
    EXPECT_THAT(with("22", "1e999"), HasSubstr("candela value: found '1e999'"));
    EXPECT_THAT(with("22", "-inf"), HasSubstr("found '-inf'"));
    EXPECT_THAT(with("22", "0x16"), HasSubstr("found '0x16'"));
    EXPECT_THAT(with("1 -1 1 3 3 3 2", "1 -1 1 1000000000 3 3 2"), HasSubstr("x.ies:5:8: number of vertical angles: found '1000000000'"));
    EXPECT_THAT(with("1 -1 1 3 3 3 2", "1 -1 1 -3 3 3 2"), HasSubstr("number of vertical angles: found '-3'"));
    EXPECT_THAT(with("1 -1 1 3 3 3 2", "1 -1 1 5000 4000 3 2"), HasSubstr("found 5000 x 4000, expected at most 16777216 intensities"));
    EXPECT_THAT(with("1 -1 1 3 3 3 2", "1 -1 1 2.5 3 3 2"), HasSubstr("found '2.5', expected a whole number"));
    EXPECT_THAT(with("1 -1 1 3 3 3 2", "1 -1 0 3 3 3 2"), HasSubstr("candela multiplier: found 0, expected a number above 0"));
    EXPECT_THAT(with("1 -1 1 3 3 3 2", "1 -1 1 3 3 4 2"), HasSubstr("photometric type: found '4'"));
    EXPECT_THAT(with("1 -1 1 3 3 3 2", "1 -1 1 3 3 3 7"), HasSubstr("units type: found '7', expected a whole number from 1 to 2"));
    EXPECT_THAT(with("31 32 33\n", "31 32\n"), HasSubstr("x.ies:11: candela value: the file ends after 8 of 9"));
    EXPECT_THAT(with("-2 0 2", "-2 0 95"), testing::AnyOf(HasSubstr("type C"), HasSubstr("vertical angles")));
    EXPECT_THAT(all_notes(read("y.ies", good + "44 55\n")), HasSubstr("Line 12 goes on after the last candela value"));
    EXPECT_THAT(
        with("21 22 23", "21.5 22,5 23"),
        HasSubstr(
            "x.ies:10:6: found '22,5' in a table with more intensities than its angles ask for, expected 22.5, if that is a decimal"));
}

TEST_F(IesFile, NoPrefixOfAGoodFileIsReadAndNothingMakesItFallOver) {
    const std::string good = small();
    const std::size_t last_number = good.rfind(' ') + 1;
    for (std::size_t n = 0; n <= last_number; ++n)
        EXPECT_THAT(refusal("p.ies", good.substr(0, n)), HasSubstr("p.ies")) << n;
    EXPECT_EQ(refusal("p.ies", good), "");
    must_survive_random_bytes("r.ies", "", 1);
    must_survive_random_bytes("r.ies", "IESNA:LM-63-2002\nTILT=NONE\n", 2);
    must_survive_random_bytes("r.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n1 1 55\n", 3);
    must_survive_changed_bytes("r.ies", small(), 4);
    must_survive_changed_bytes(
        "r.ies", "IESNA91\nTILT=INCLUDE\n1\n3\n0 15 90\n1 1 1\n1 -1 1 3 2 3 2 0 0 0\n1 1 55\n0 45 90\n0 90\n1 2 3\n4 5 6\n", 5);
    const std::filesystem::path unreadable = folder_ / "folder.ies";
    std::filesystem::create_directory(unreadable);
    EXPECT_THROW(read_lamp(unreadable), InputError);
    EXPECT_THROW(read_lamp(folder_ / "absent.ies"), InputError);
}

TEST_F(IesFile, RoundTripsLoseNothing) {
    const std::string long_text = std::string(700, 'x') + " " + std::string(150, 'y') + " z";
    must_come_back("trip.ies", {.name = "round trip", .labels = {{"MANUFAC", "Büch\ner"}, {"MORE THAN ENOUGH", long_text}}},
                   "IES LM-63-2002, type A");
    LampFile lamp{.table = {{0.0, 5.0, 10.0}, {-1.0, 0.0}, {1, 2, 3, 4, 5, 6}, {}, BetweenSamples::linear_cd}};
    write_lamp(lamp, folder_ / "zero.ies");
    const LampFile back = read_lamp(folder_ / "zero.ies");
    EXPECT_EQ(intensity_cd(back.table, -5.0, 0.0), 0.0);
    EXPECT_EQ(intensity_cd(back.table, 0.0, 0.0), 4.0);
    EXPECT_NEAR(flux_lm(back.table), flux_lm(lamp.table), 1e-15);
}

} // namespace
} // namespace fernlicht
