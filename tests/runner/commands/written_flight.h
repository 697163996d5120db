// Writes small OpenFlight databases for tests, record by record, as the OpenFlight specification lays them out (16.0).
#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fernlicht::test {

class FlightWriter {
  public:
    /// `unit`: 0 metres, 4 feet.
    explicit FlightWriter(int unit) {
        std::string body(320, '\0');
        const auto at = [&](std::size_t byte, const std::string& bytes) { body.replace(byte - 4, bytes.size(), bytes); };
        at(4, "db");
        at(12, big(1600, 4));
        at(60, big(1, 2));
        at(62, big(static_cast<std::uint64_t>(unit), 1));
        at(126, big(1, 2)); // vertices in double precision
        header_ = record(1, body);
    }

    void group(const std::string& name) { body_ += record(2, padded(name, 8) + std::string(32, '\0')); }
    void object() { body_ += record(4, padded("o", 8) + std::string(16, '\0')); }
    void push() { body_ += record(10, ""); }
    void pop() { body_ += record(11, ""); }
    /// Longer than the 7 letters that a record's own name has.
    void long_name(const std::string& name) { body_ += record(33, name + '\0'); }
    void level_of_detail(double from_m, double to_m) {
        body_ += record(73, padded("lod", 8) + big(0, 4) + number(to_m) + number(from_m) + std::string(48, '\0'));
    }
    /// The first of two children is on.
    void switch_first() { body_ += record(96, padded("sw", 8) + big(0, 4) + big(0, 4) + big(1, 4) + big(1, 4) + big(1, 4)); }
    void external(const std::string& file) { body_ += record(63, padded(file, 200) + std::string(12, '\0')); }
    /// A square of 2 x 2 about a centre, facing up, in a colour.
    void square(double x, double y, double z, std::uint32_t rgb) {
        std::string face(76, '\0');
        face.replace(0, 1, "f");
        face.replace(22, 4, std::string("\xff\xff\xff\xff", 4)); // detail texture, texture: none
        face.replace(26, 2, std::string("\xff\xff", 2));         // material: none
        face.replace(40, 4, big(0x10000000, 4));                 // packed colour
        const std::uint32_t bgr = (rgb & 0xFF) << 16 | (rgb & 0xFF00) | rgb >> 16;
        face.replace(52, 4, big(0xFF000000U | bgr, 4));
        body_ += record(5, face);
        push();
        std::string list;
        for (const auto& [dx, dy] : {std::pair(-1.0, -1.0), std::pair(1.0, -1.0), std::pair(1.0, 1.0), std::pair(-1.0, 1.0)}) {
            list += big(8 + vertices_.size(), 4);
            vertices_ += record(68, big(0, 2) + big(0x1000, 2) + number(x + dx) + number(y + dy) + number(z) + big(0xFF000000U | bgr, 4) +
                                        big(0, 4));
        }
        body_ += record(72, list);
        pop();
    }
    std::string text() const {
        const std::string palette = record(67, big(8 + vertices_.size(), 4)) + vertices_;
        return header_ + palette + record(10, "") + body_ + record(11, "");
    }
    void write(const std::filesystem::path& path) const { std::ofstream(path, std::ios::binary) << text(); }

  private:
    static std::string big(std::uint64_t value, int bytes) {
        std::string out;
        for (int i = bytes - 1; i >= 0; --i)
            out += static_cast<char>(value >> (8 * i) & 0xFF);
        return out;
    }
    static std::string number(double value) { return big(std::bit_cast<std::uint64_t>(value), 8); }
    static std::string padded(std::string text, std::size_t size) {
        text.resize(size, '\0');
        return text;
    }
    static std::string record(std::uint64_t code, const std::string& body) { return big(code, 2) + big(body.size() + 4, 2) + body; }

    std::string header_, vertices_, body_;
};

} // namespace fernlicht::test
