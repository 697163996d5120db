// Beam matrices: units, screens, separators and round trips.
#include "tests/scenarios/lamps/lamp_trial.h"

#include <cstdint>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tuple>

namespace fernlicht {
namespace {

using testing::HasSubstr;

class BeamMatrix : public LampTrial {
  protected:
    CandelaTable table(const std::string& text) const { return read("m.csv", text).table; }
};

constexpr const char* body = "V\\H,-10,0,10\n-1,1,2,3\n0,4,5,6\n2,7,8,9\n";

TEST_F(BeamMatrix, CandelaStandAsTheyAreAndLuxCountWithTheSquareOfTheDistance) {
    const LampFile lamp = read("m.csv", std::string("# unit: cd\n# a comment\n") + body);
    EXPECT_EQ(lamp.format, "beam matrix");
    EXPECT_EQ(lamp.name, "m");
    EXPECT_EQ(lamp.table, (CandelaTable{{-10, 0, 10}, {-1, 0, 2}, {1, 2, 3, 4, 5, 6, 7, 8, 9}, {}, BetweenSamples::linear_cd}));
    EXPECT_EQ(read("no-extension", std::string("# unit: cd\n") + body).table, lamp.table) << "told by content";
    EXPECT_DOUBLE_EQ(peak_of(table(std::string("# unit: lx\n") + body)).cd, 9 * 625.0);
    EXPECT_DOUBLE_EQ(peak_of(table(std::string("# unit: lx\n# distance_m: 10\n") + body)).cd, 900.0);
}

TEST_F(BeamMatrix, AFlatWallCostsTheCubeOfTheCosine) {
    // A lamp of 1000 cd to all sides: E on the wall is 1.6 cos^3(theta). Ignoring that is 4.7 % at 10 degrees, 21 % at 20, 54 % at 30.
    std::string lux = "# unit: lx\n# screen: planar\n# angles: goniometer\nV\\H,-30,-20,-10,0,10,20,30\n";
    for (const double v : {-20.0, -10.0, 0.0, 5.0}) {
        lux += fmt::format("{}", v);
        for (int h = -30; h <= 30; h += 10)
            lux += fmt::format(",{}", 1000.0 / 625.0 * std::pow(std::cos(radians(h)) * std::cos(radians(v)), 3.0));
        lux += "\n";
    }
    for (const double cd : table(lux).cd)
        EXPECT_NEAR(cd, 1000.0, 1e-9);
    std::string ignored = lux;
    ignored.replace(ignored.find("planar"), 6, "spherical");
    const CandelaTable wrong = table(ignored);
    for (const auto& [h, loss] : {std::pair{10.0, 0.047}, std::pair{20.0, 0.21}, std::pair{30.0, 0.54}})
        EXPECT_NEAR(1000.0 / intensity_cd(wrong, h, 0.0) - 1.0, loss, 0.005);
}

TEST_F(BeamMatrix, ScreenAnglesAreTurnedIntoTheGoniometers) {
    // A spot seen on the wall at atan(x/d) = 40, atan(y/d) = -10: its elevation above the horizontal is less than 10 degrees.
    std::string text = "# unit: cd\n# angles: screen\nV\\H";
    const auto spot = [](double a, double b) { return 1000.0 * std::exp(-(std::pow(a - 40.0, 2) + std::pow(b + 10.0, 2)) / 20.0); };
    for (int a = -50; a <= 50; ++a)
        text += fmt::format(",{}", a);
    text += "\n";
    for (int b = -30; b <= 10; ++b) {
        text += fmt::format("{}", b);
        for (int a = -50; a <= 50; ++a)
            text += fmt::format(",{}", spot(a, b));
        text += "\n";
    }
    const LampFile lamp = read("s.csv", text);
    const double elevation = degrees(std::atan2(std::tan(radians(-10.0)), std::hypot(1.0, std::tan(radians(40.0)))));
    EXPECT_NEAR(peak_of(lamp.table).h_deg, 40.0, 1e-9);
    EXPECT_NEAR(peak_of(lamp.table).v_deg, elevation, 1e-9);
    EXPECT_DOUBLE_EQ(peak_of(lamp.table).cd, 1000.0);
    EXPECT_NEAR(elevation, -7.69, 0.01);
    EXPECT_THAT(all_notes(lamp), HasSubstr("Resampled from flat screen"));
    EXPECT_EQ(intensity_cd(lamp.table, 180.0, 0.0), 0.0);
}

TEST_F(BeamMatrix, ScreenAnglesAndAPlanarScreenTogether) {
    // 1000 cd to all sides, measured in the wall over screen angles.
    std::string text = "# unit: lx\n# angles: screen\n# screen: planar\n# distance_m: 5\nV\\H,-30,0,30\n";
    for (const double b : {-20.0, 0.0, 20.0}) {
        text += fmt::format("{}", b);
        for (const double a : {-30.0, 0.0, 30.0})
            text += fmt::format(",{}", 1000.0 / 25.0 * std::pow(1.0 / std::hypot(1.0, std::tan(radians(a)), std::tan(radians(b))), 3.0));
        text += "\n";
    }
    const CandelaTable t = table(text);
    for (const double h : {-25.0, 0.0, 12.0})
        for (const double v : {-15.0, 0.0, 10.0})
            EXPECT_NEAR(intensity_cd(t, h, v), 1000.0, 1e-6);
}

TEST_F(BeamMatrix, SeparatorsOrderOfRowsAndZeroPadding) {
    const CandelaTable expected = table("# unit: cd\nV\\H,-1.5,0\n-1,1.5,2\n0,4,5.25\n");
    EXPECT_EQ(table("# unit: cd\nV\\H;-1,5;0\n-1;1,5;2\n0;4;5,25\n"), expected);
    EXPECT_EQ(table("# unit: cd\n\t-1.5\t0\n-1\t1.5\t2\n0\t4\t5.25\n"), expected);
    EXPECT_EQ(table("# unit: cd\r\nV\\H  -1.5 0\r\n-1 1.5   2\r\n\r\n0 4 5.25\r\n"), expected);
    EXPECT_EQ(table("\xef\xbb\xbf# unit: cd\n,-1.5,0,\n-1,1.5,2,\n0,\"4\",5.25,\n"), expected);
    const LampFile lamp = read("d.csv", "# unit: cd\nV\\H,-1,0\n1,7,8\n0,4,5\n-1,1,2\n");
    EXPECT_EQ(lamp.table, table("# unit: cd\nV\\H,-1,0\n-1,1,2\n0,4,5\n1,7,8\n"));
    EXPECT_THAT(all_notes(lamp), HasSubstr("vertical angles do not ascend"));
    const std::string padded = "V\\H,-1,0,1\n-90,0,0,0\n-2,5,5,5\n0,5,5,5\n2,5,5,5\n";
    EXPECT_EQ(intensity_cd(table("# unit: cd\n" + padded), 0.0, -2.1), 0.0);
    EXPECT_GT(intensity_cd(table("# unit: cd\n# gaps_deg: none\n" + padded), 0.0, -2.1), 4.9);
    EXPECT_EQ(intensity_cd(table("# unit: cd\n# gaps_deg: 0 1 0 2; -1 0 -2 0\n" + padded), 0.5, 1.0), 0.0);
    EXPECT_THAT(refusal("g.csv", "# unit: cd\n# gaps_deg: some\n" + padded), HasSubstr("g.csv:2: gaps_deg: found 'some'"));
    EXPECT_EQ(table("# unit: cd\n# #\n#\nV\\H,-1,0\n-1,1,2\n0,4,5\n"), table("# unit: cd\nV\\H,-1,0\n-1,1,2\n0,4,5\n"))
        << "comments of nothing";
}

TEST_F(BeamMatrix, ManyRectanglesOfGapsTakeNoMoreThanTheirText) {
    std::string text = "# unit: cd\n# gaps_deg: -1 1 -2 2";
    for (int i = 0; i < 200'000; ++i)
        text += ";-300 300 -300 300";
    text += "\nV\\H";
    for (int h = 0; h < 1500; ++h)
        text += fmt::format(",{}", h * 0.01);
    for (int v = 0; v < 1000; ++v) {
        text += fmt::format("\n{}", v * 0.01);
        for (int h = 0; h < 1500; ++h)
            text += ",1";
    }
    EXPECT_EQ(flux_lm(table(text)), 0.0); // 3e11 steps if each rectangle visited its cells
}

TEST_F(BeamMatrix, MessagesNameLineAndCell) {
    const std::pair<std::string, const char*> cases[]{
        {"", "x.csv: is empty"},
        {body,
         "x.csv:1: unit: is not given before the numbers, expected a line '# unit: lx' or '# unit: cd'; other text grids need a recipe"},
        {std::string("# unit: fc\n") + body, "x.csv:1: unit: found 'fc', expected cd or lx"},
        {std::string("# unit: lx\n# distance: 25\n") + body, "x.csv:2: distance: is no key of a beam matrix, expected distance_m"},
        {std::string("# unit: lx\n# distance_m: -25\n") + body, "x.csv:2: distance_m: found -25"},
        {std::string("# unit: lx\n# distance_m: inf\n") + body, "found 'inf'"},
        {std::string("# unit: lx\n# angles: polar\n") + body, "found 'polar', expected goniometer or screen"},
        {std::string("# unit: lx\n# screen: curved\n") + body, "expected spherical or planar"},
        {"# unit: cd\n", "the file ends before the matrix"},
        {"# unit: cd\nV\\H,0,1\n", "the file ends before the matrix"},
        {"# unit: cd\nV\\H,0,1\n0,1\n", "x.csv:3: found 2 cells, expected 3"},
        {"# unit: cd\nV\\H,0,1\n0,1,2\n1,3,nan\n", "x.csv:4: column 3: found 'nan'"},
        {"# unit: cd\nV\\H,0,1\n0,1,2\n1,3,\n", "x.csv:4: found 2 cells"},
        {"# unit: cd\nV\\H,0,one\n0,1,2\n1,3,4\n", "x.csv:2: horizontal angle: found 'one'"},
        {"# unit: cd\nV\\H,0,1\n0,1,2\n95,3,4\n", "x.csv:3: vertical angles: found 95"},
        {"# unit: cd\nV\\H,0\n0,1\n1,3\n", "horizontal angles: found 1 of them, expected at least 2"},
        {"# unit: cd\nV\\H,0,1\n0,1,2\n", "vertical angles: found 1 of them"},
        {"# unit: cd\nV\\H,0,1\n0,1,-2\n1,3,4\n", "x.csv:3: intensity at horizontal 1, vertical 0: is -2 cd"},
        {"# unit: cd\nV\\H,0,1\n1,1,2\n\n0,3,-4\n", "x.csv:5: intensity at horizontal 1, vertical 0: is -4 cd"},
        {"# unit: lx\n# distance_m: 25,5\n", "x.csv:2: distance_m: has decimal commas, expected points: write 25.5 for 25,5"},
        {"# unit: cd\nV\\H -1,5 0 1,5\n0 1 2 3\n1 2 3 4\n", "x.csv:2:5: has decimal commas, expected points: write -1.5 for"},
        {"# unit: cd\nV\\H,0,1\n0,1,5,2,5\n1,3,4\n", "x.csv:3: found 5 cells, expected 3: a vertical angle and one per horizontal angle; "
                                                     "where numbers have decimal commas, semicolons separate"},
        {"# unit: lx\n# screen: planar\nV\\H,0,90\n0,1,2\n1,3,4\n", "found 90, expected angles from -89 to 89"},
    };
    for (const auto& [text, says] : cases)
        EXPECT_THAT(refusal("x.csv", text), HasSubstr(says));
    for (const char* bad : {"inf", "-inf", "1e999", "1e13"})
        EXPECT_THAT(refusal("x.csv", fmt::format("# unit: cd\nV\\H,0,1\n0,1,2\n1,3,{}\n", bad)), HasSubstr("x.csv")) << bad;
}

TEST_F(BeamMatrix, NothingMakesItFallOver) {
    must_survive_random_bytes("r.csv", "", 21);
    must_survive_random_bytes("r.csv", "# unit: lx\n", 22);
    must_survive_random_bytes("r.csv", "# unit: lx\nV\\H,0,1,2\n", 23);
    must_survive_changed_bytes("r.csv", std::string("# unit: lx\n# screen: planar\n# distance_m: 25\n") + body, 24);
    const std::string good = std::string("# unit: cd\n") + body;
    for (std::size_t n = 0; n < good.size(); ++n)
        must_not_fall_over("p.csv", good.substr(0, n));
}

TEST_F(BeamMatrix, RoundTripsLoseNothingAndOtherNamesCannotBeWritten) {
    const LampFile back = must_come_back(
        "trip.csv", {.name = "round, trip; \"quoted\"", .labels = {{"MANUFAC", "Büch\ner: sons"}, {"unit", "furlong"}}}, "beam matrix");
    EXPECT_EQ(back.labels, (decltype(back.labels){{"MANUFAC", "Büch er: sons"}, {"unit", "furlong"}}));
    LampFile lamp{.table = random_lamp_table(1)};
    EXPECT_THROW(write_lamp(lamp, folder_ / "lamp.txt"), InputError);
    lamp.table.cd[0] = -1.0;
    EXPECT_THROW(write_lamp(lamp, folder_ / "lamp.csv"), std::invalid_argument);
}

// Beam textures: where pixels lie, what they are worth, and round trips through EXR.

/// An uncompressed PNG, 8 bits a sample.
class Png {
  public:
    Png(int width, int height, int channels, const std::string& samples) {
        const auto colour_type = static_cast<char>(channels == 1 ? 0 : channels == 3 ? 2 : 6);
        chunk("IHDR", big_endian(width) + big_endian(height) + std::string{8, colour_type, 0, 0, 0});
        for (std::size_t row = 0, length = static_cast<std::size_t>(width * channels); row < static_cast<std::size_t>(height); ++row)
            raw_ += std::string(1, '\0') + samples.substr(row * length, length);
    }
    Png& text(const std::string& key, const std::string& value) {
        chunk("tEXt", key + std::string(1, '\0') + value);
        return *this;
    }
    std::string bytes() {
        std::uint32_t a = 1, b = 0;
        for (const char c : raw_) {
            a = (a + static_cast<unsigned char>(c)) % 65521;
            b = (b + a) % 65521;
        }
        const auto n = static_cast<unsigned>(raw_.size()); // one stored block
        std::string data{'\x78',
                         '\x01',
                         '\x01',
                         static_cast<char>(n & 255),
                         static_cast<char>(n >> 8),
                         static_cast<char>(~n & 255),
                         static_cast<char>(~n >> 8 & 255)};
        chunk("IDAT", data + raw_ + big_endian(static_cast<int>(b << 16 | a)));
        chunk("IEND", "");
        return "\x89PNG\r\n\x1a\n" + chunks_;
    }

  private:
    static std::string big_endian(int value) {
        const auto u = static_cast<std::uint32_t>(value);
        return {static_cast<char>(u >> 24), static_cast<char>(u >> 16 & 255), static_cast<char>(u >> 8 & 255), static_cast<char>(u & 255)};
    }
    void chunk(const std::string& type, const std::string& data) {
        std::uint32_t crc = 0xffffffffU;
        for (const char c : type + data) {
            crc ^= static_cast<unsigned char>(c);
            for (int bit = 0; bit < 8; ++bit)
                crc = crc >> 1 ^ (0xedb88320U & (0U - (crc & 1U)));
        }
        chunks_ += big_endian(static_cast<int>(data.size())) + type + data + big_endian(static_cast<int>(~crc));
    }
    std::string chunks_, raw_;
};

LampReadOptions options_for(double scale, double distance, double left, double right, double bottom, double top) {
    LampReadOptions options{.texture_scale_lx = scale, .texture_distance_m = distance};
    options.texture_h_extent_deg[0] = left;
    options.texture_h_extent_deg[1] = right;
    options.texture_v_extent_deg[0] = bottom;
    options.texture_v_extent_deg[1] = top;
    return options;
}

class BeamTexture : public LampTrial {};

TEST_F(BeamTexture, EightBitPixelsAreLinearAndTheirCentresAreTheSamples) {
    const std::string samples{'\x00', '\x33', '\x66', '\xff', '\x99', '\xcc'}; // 3 x 2, top row first
    const LampFile lamp = read("t.png", Png(3, 2, 1, samples).bytes(), options_for(50.0, 10.0, -6.0, 6.0, -3.0, 1.0));
    EXPECT_EQ(lamp.format, "beam texture");
    EXPECT_EQ(lamp.table.h_deg, (std::vector<double>{-4, 0, 4}));
    EXPECT_EQ(lamp.table.v_deg, (std::vector<double>{-2, 0}));
    const std::vector<double> expected{1.0, 0.6, 0.8, 0.0, 0.2, 0.4}; // of 50 lx at 10 m
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(lamp.table.cd[i], expected[i] * 5000.0, 1e-3);
    EXPECT_THAT(all_notes(lamp), HasSubstr("steps of 19.6 cd"));
}

TEST_F(BeamTexture, MetadataStandInForOptions) {
    const std::string bytes = Png(2, 2, 1, {'\xff', '\xff', '\x00', '\x00'})
                                  .text("fernlicht:scale_lx", "100")
                                  .text("fernlicht:distance_m", "5")
                                  .text("fernlicht:h_extent_deg", "-2 2")
                                  .text("fernlicht:v_extent_deg", "-1 1")
                                  .bytes();
    const LampFile lamp = read("t.png", bytes);
    EXPECT_NEAR(peak_of(lamp.table).cd, 2500.0, 1e-9);
    EXPECT_EQ(peak_of(lamp.table).v_deg, 0.5);
    EXPECT_NEAR(peak_of(read("t.png", bytes, options_for(8.0, 25.0, 0, 0, 0, 0)).table).cd, 5000.0, 1e-9) << "options win";
}

TEST_F(BeamTexture, ColouredPicturesGiveTheirLuminanceAndAlphaIsNoLight) {
    const std::string red{'\xff', '\0', '\0', '\xff', '\0', '\0', '\xff', '\0', '\0', '\xff', '\0', '\0'};
    const LampFile lamp = read("c.png", Png(2, 2, 3, red).bytes(), options_for(1.0, 1.0, -1, 1, -1, 1));
    EXPECT_NEAR(peak_of(lamp.table).cd, 0.2126, 1e-6);
    EXPECT_THAT(all_notes(lamp), HasSubstr("coloured"));
    std::string clear;
    for (int i = 0; i < 4; ++i)
        clear += std::string{'\xff', '\xff', '\xff', '\x10'};
    EXPECT_NEAR(peak_of(read("a.png", Png(2, 2, 4, clear).bytes(), options_for(1.0, 1.0, -1, 1, -1, 1)).table).cd, 1.0, 1e-6);
}

TEST_F(BeamTexture, MessagesNameWhatIsMissing) {
    const std::string plain = Png(2, 2, 1, {1, 2, 3, 4}).bytes();
    EXPECT_THAT(refusal("x.png", plain), HasSubstr("x.png: fernlicht:scale_lx: is neither in the options nor in the picture"));
    EXPECT_THAT(refusal("x.png", plain, options_for(1, 25, 0, 0, 0, 0)), HasSubstr("fernlicht:h_extent_deg: is neither"));
    EXPECT_THAT(refusal("x.png", plain, options_for(1, 25, -1, 1, 0, 0)), HasSubstr("fernlicht:v_extent_deg: is neither"));
    EXPECT_THAT(refusal("x.png", plain, options_for(1, 25, 1, -1, -1, 1)), HasSubstr("found 1 to -1, expected ascending angles"));
    EXPECT_THAT(refusal("x.png", plain, options_for(1, 25, -1, 1, -300, 1)), HasSubstr("v_extent_deg"));
    EXPECT_THAT(refusal("x.png", plain, options_for(-1, 25, -1, 1, -1, 1)), HasSubstr("texture scale: found -1"));
    EXPECT_THAT(refusal("x.png", plain, options_for(1, 0, -1, 1, -1, 1)), HasSubstr("texture distance: found 0"));
    EXPECT_THAT(refusal("x.png", plain, options_for(std::nan(""), 25, -1, 1, -1, 1)), HasSubstr("found nan"));
    EXPECT_THAT(refusal("x.png", Png(1, 4, 1, {1, 2, 3, 4}).bytes()), HasSubstr("has 1 x 4 pixels"));
    EXPECT_THAT(refusal("x.png", "\x89PNG nonsense"), HasSubstr("x.png: ends early or is damaged, expected a PNG or EXR picture"));
    EXPECT_THAT(refusal("x.png", plain.substr(0, plain.size() - 1)), HasSubstr("ends early"));
    EXPECT_THAT(refusal("x.exr", "\x76\x2f\x31\x01 nonsense"), HasSubstr("ends early or is damaged"));
    std::string huge = plain; // a header that promises 2^31 - 1 columns
    huge.replace(16, 4, "\x7f\xff\xff\xff", 4);
    EXPECT_THAT(refusal("x.png", huge), HasSubstr("x.png"));
}

LampFile lamp_with(const CandelaTable& table) {
    LampFile lamp{.name = "round trip", .table = table, .declared_flux_lm = 987.6543210123, .labels = {{"MANUFAC", "Bücher: sons"}}};
    return lamp;
}

TEST_F(BeamTexture, RoundTripsOfEvenGridsLoseNothingBeyondFloat) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        const LampFile lamp = lamp_with(random_lamp_table(seed, true));
        const auto path = folder_ / "trip.exr";
        write_lamp(lamp, path);
        const LampFile back = read_lamp(path);
        ASSERT_EQ(back.table.h_deg.size(), lamp.table.h_deg.size());
        ASSERT_EQ(back.table.v_deg.size(), lamp.table.v_deg.size());
        EXPECT_EQ(back.table.gaps, lamp.table.gaps) << seed;
        for (std::size_t i = 0; i < lamp.table.h_deg.size(); ++i)
            EXPECT_NEAR(back.table.h_deg[i], lamp.table.h_deg[i], 1e-12);
        for (std::size_t v = 0; v < lamp.table.v_deg.size(); ++v)
            for (std::size_t h = 0; h < lamp.table.h_deg.size(); ++h) {
                // Pixels hold the light that the table gives: nothing at samples that only gaps surround.
                const double given = intensity_cd(lamp.table, lamp.table.h_deg[h], lamp.table.v_deg[v]);
                EXPECT_NEAR(back.table.at(v, h), given, 1.2e-7 * given) << "2^-23";
            }
        EXPECT_EQ(std::tuple(back.name, back.labels, back.declared_flux_lm), std::tuple(lamp.name, lamp.labels, lamp.declared_flux_lm));
    }
}

TEST_F(BeamTexture, UnevenGridsOnALatticeKeepTheirLight) {
    CandelaTable table{{-90, -10, -1, -0.5, 0, 0.5, 10, 90}, {-5, -1, 0, 0.25, 3}, {}, {}, BetweenSamples::linear_cd};
    std::mt19937 random(3);
    for (std::size_t i = 0; i < 40; ++i)
        table.cd.push_back(static_cast<double>(random() % 30000));
    write_lamp(lamp_with(table), folder_ / "l.exr");
    const CandelaTable back = read_lamp(folder_ / "l.exr").table;
    EXPECT_EQ(back.h_deg.size(), 361U);
    EXPECT_EQ(back.v_deg.size(), 33U);
    std::uniform_real_distribution<double> h(-90.0, 90.0), v(-5.0, 3.0);
    for (int i = 0; i < 5000; ++i) {
        const double hd = h(random), vd = v(random);
        EXPECT_NEAR(intensity_cd(back, hd, vd), intensity_cd(table, hd, vd), 1e-7 * 30000.0);
    }
    EXPECT_NEAR(flux_lm(back) / flux_lm(table), 1.0, 1e-7);
}

TEST_F(BeamTexture, TheWholeSphereGoesRound) {
    CandelaTable table{{-180, -90, 0, 90, 180}, {-90, -45, 0, 45, 90}, std::vector<double>(25, 40.0), {}, BetweenSamples::linear_cd};
    write_lamp(lamp_with(table), folder_ / "s.exr");
    EXPECT_NEAR(flux_lm(read_lamp(folder_ / "s.exr").table), 4 * pi * 40, 1e-4);
}

TEST_F(BeamTexture, NothingMakesItFallOver) {
    const std::string png = Png(3, 2, 1, {1, 2, 3, 4, 5, 6})
                                .text("fernlicht:scale_lx", "1")
                                .text("fernlicht:h_extent_deg", "-1 1")
                                .text("fernlicht:v_extent_deg", "-1 1")
                                .bytes();
    EXPECT_EQ(refusal("p.png", png), "");
    for (std::size_t n = 0; n < png.size(); ++n)
        must_not_fall_over("p.png", png.substr(0, n));
    must_survive_changed_bytes("p.png", png, 31, 60);
    must_survive_random_bytes("p.png", "\x89PNG\r\n\x1a\n", 32, 30);
    write_lamp(lamp_with(random_lamp_table(2, true)), folder_ / "good.exr");
    std::ifstream in(folder_ / "good.exr", std::ios::binary);
    const std::string exr((std::istreambuf_iterator<char>(in)), {});
    for (std::size_t n = 0; n < exr.size(); n += 29)
        must_not_fall_over("p.exr", exr.substr(0, n));
    must_survive_changed_bytes("p.exr", exr, 33, 60);
    must_survive_random_bytes("p.exr", "\x76\x2f\x31\x01\x02" + std::string(3, '\0'), 34, 30);
}

} // namespace
} // namespace fernlicht
