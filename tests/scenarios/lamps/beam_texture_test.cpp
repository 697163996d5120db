// Beam textures: where pixels lie, what they are worth, and round trips through EXR.
#include "tests/scenarios/lamps/lamp_trial.h"

#include <cstdint>

namespace fernlicht {
namespace {

using testing::HasSubstr;

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
    LampReadOptions options;
    options.texture_scale_lx = scale;
    options.texture_distance_m = distance;
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
    EXPECT_THAT(refusal("x.png", Png(1, 4, 1, {1, 2, 3, 4}).bytes()), HasSubstr("has 1 x 4 x 1 pixels"));
    EXPECT_THAT(refusal("x.png", "\x89PNG nonsense"), HasSubstr("x.png: ends early or is damaged, expected a PNG or EXR picture"));
    EXPECT_THAT(refusal("x.png", plain.substr(0, plain.size() - 1)), HasSubstr("ends early"));
    EXPECT_THAT(refusal("x.exr", "\x76\x2f\x31\x01 nonsense"), HasSubstr("cannot be decoded"));
    std::string huge = plain; // a header that promises 2^31 - 1 columns
    huge.replace(16, 4, "\x7f\xff\xff\xff", 4);
    EXPECT_THAT(refusal("x.png", huge), HasSubstr("x.png"));
}

LampFile lamp_with(const CandelaTable& table) {
    LampFile lamp;
    lamp.name = "round trip";
    lamp.table = table;
    lamp.labels = {{"MANUFAC", "B\xc3\xbc"
                               "cher: sons"}};
    lamp.declared_flux_lm = 987.6543210123;
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
        EXPECT_EQ(back.name, lamp.name);
        EXPECT_EQ(back.labels, lamp.labels);
        EXPECT_EQ(back.declared_flux_lm, lamp.declared_flux_lm);
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
