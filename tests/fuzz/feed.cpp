#include "tests/fuzz/readers.h"

#include "tests/shipped.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

namespace fernlicht::fuzz {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, std::string_view bytes) {
    std::ofstream out(file, std::ios::binary);
    if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
        throw std::runtime_error("cannot be written: " + file.string());
}

constexpr const char* lamp = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n1 1 0\n-10 0 10\n-20 0 20\n0 10 0\n10 900 10\n0 10 0\n";

constexpr const char* drive = "fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 1\nlamp_sets:\n  one: {file: low.ies}\n";

constexpr const char* recipe = "fernlicht_recipe: 1\nlayout: matrix\ndelimiter: tab\nunit: cd\n";

constexpr const char* cars = R"(<OpenSCENARIO><FileHeader revMajor="1" revMinor="2"/><Catalog name="cars">
<Vehicle name="car" vehicleCategory="car"><BoundingBox><Center x="1.4" y="0" z="0.75"/><Dimensions length="4" width="2" height="1.5"/></BoundingBox>
<Performance maxSpeed="60" maxAcceleration="4" maxDeceleration="8"/></Vehicle></Catalog></OpenSCENARIO>
)";

constexpr const char* frames = "(0.000000) can0 123#0102030405060708\n(0.020000) can0 123#0102030405060709\n";

const std::map<std::string, std::string, std::less<>>& companions() {
    static const auto all = [] {
        std::map<std::string, std::string, std::less<>> files{
            {"low.ies", lamp}, {"drive.yaml", drive}, {"recipe.yaml", recipe}, {"catalogs/cars.xosc", cars}, {"bus.log", frames}};
        for (int nm = 380; nm <= 780; nm += 10)
            files["spectrum.csv"] += std::to_string(nm) + ", 1\n";
        for (const auto& [name, shipped] : {std::pair("road.xodr", "roads/straight.xodr"), std::pair("views.yaml", "views/six.yaml"),
                                            std::pair("car.glb", "models/car.glb"), std::pair("bus.dbc", "can/mock-up.dbc"),
                                            std::pair("story.xosc", "storyboards/s-bend-dusk.xosc")})
            files[name] = bytes_of(shipped_library / shipped);
        return files;
    }();
    return all;
}

} // namespace

void make_companions(const fs::path& folder) {
    fs::create_directories(folder / "catalogs");
    fs::create_directories(folder / "cells/c0");
    for (const auto& [name, bytes] : companions())
        write(folder / name, bytes);
}

void feed(const Reader& reader, std::string_view bytes, const fs::path& folder) {
    bool more = true;
    for (const std::string_view file : reader.files)
        if (more) {
            const std::size_t end = std::min(bytes.find(part_end), bytes.size());
            write(folder / file, bytes.substr(0, end));
            more = end < bytes.size();
            bytes.remove_prefix(std::min(end + part_end.size(), bytes.size()));
        } else if (const auto companion = companions().find(file); companion != companions().end()) {
            write(folder / file, companion->second);
        } else {
            fs::remove(folder / file);
        }
    tried([&] { reader.read(folder); });
}

std::vector<std::string> unpacked(const fs::path& pack) {
    const std::string whole = bytes_of(pack);
    std::vector<std::string> inputs;
    for (std::size_t at = 0; at < whole.size();) {
        std::size_t count = 0;
        const auto [end, error] = std::from_chars(whole.data() + at, whole.data() + whole.size(), count);
        const auto begin = static_cast<std::size_t>(end - whole.data()) + 1;
        if (error != std::errc() || begin > whole.size() || count > whole.size() - begin)
            throw std::runtime_error(pack.string() + ": is no pack of inputs");
        inputs.push_back(whole.substr(begin, count));
        at = begin + count;
    }
    return inputs;
}

std::string packed(const std::vector<std::string>& inputs) {
    std::string pack;
    for (const std::string& input : inputs)
        pack += std::to_string(input.size()) + "\n" + input;
    return pack;
}

std::vector<std::string> kept_inputs(const Reader& reader, const fs::path& tests_fuzz) {
    std::vector<fs::path> seeds;
    if (const fs::path folder = tests_fuzz / "seeds" / reader.name; fs::is_directory(folder))
        seeds.assign(fs::directory_iterator(folder), {});
    std::ranges::sort(seeds);
    std::vector<std::string> inputs;
    for (const fs::path& seed : seeds)
        inputs.push_back(bytes_of(seed));
    if (const fs::path pack = tests_fuzz / "corpus" / (std::string(reader.name) + ".pack"); fs::exists(pack))
        for (std::string& input : unpacked(pack))
            inputs.push_back(std::move(input));
    return inputs;
}

} // namespace fernlicht::fuzz
