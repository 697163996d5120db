// Files with bytes changed, cut out, doubled or swapped at random: each is read or refused in one sentence, and nothing else happens.
// Under AddressSanitizer (ci/test) this is where the reader is tried.
#include "scenarios/models/glb_writer.h"
#include "scenarios/models/model.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sstream>
#include <unistd.h>

namespace fernlicht {
namespace {

const std::filesystem::path real_files = std::filesystem::path(FERNLICHT_SHARED_DATA) / "models";

std::string bytes_of(const std::filesystem::path& path) {
    std::ostringstream out;
    out << std::ifstream(path, std::ios::binary).rdbuf();
    return out.str();
}

std::string mutated(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
    for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
        // Half of the changes in the first 4 kB, where headers and JSON are.
        const std::size_t at = below(below(2) == 0 ? std::min<std::size_t>(bytes.size(), 4096) : bytes.size());
        switch (below(6)) {
        case 0:
            bytes[at] = static_cast<char>(random());
            break;
        case 1:
            bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1U << below(8)));
            break;
        case 2:
            bytes.erase(at, 1 + below(64));
            break;
        case 3:
            bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(64)));
            break;
        case 4: // a digit becomes many
            if (bytes[at] >= '0' && bytes[at] <= '9')
                bytes.insert(at, below(2) == 0 ? "99999999" : "-1e308");
            break;
        default:
            bytes.resize(at);
        }
    }
    return bytes;
}

class GltfMutation : public testing::Test {
  protected:
    GltfMutation() { std::filesystem::create_directories(folder_); }
    ~GltfMutation() override { std::filesystem::remove_all(folder_); }

    /// How many of the mutants were refused; the rest were read and are whole.
    std::size_t refused(const std::filesystem::path& file, std::size_t mutants, std::uint32_t seed) {
        std::mt19937 random(seed);
        const std::string bytes = bytes_of(file);
        std::size_t count = 0;
        for (std::size_t k = 0; k < mutants; ++k) {
            std::ofstream(folder_ / file.filename(), std::ios::binary | std::ios::trunc) << mutated(bytes, random);
            try {
                const Model model = read_model(folder_ / file.filename());
                for (const Mesh& mesh : model.meshes)
                    for (const std::uint32_t i : mesh.indices)
                        EXPECT_LT(i, mesh.vertices.size());
            } catch (const InputError& error) {
                const std::string text = error.what();
                EXPECT_EQ(text.find('\n'), std::string::npos) << text;
                EXPECT_LT(text.size(), 2000U);
                ++count;
            }
        }
        return count;
    }
    const std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("fernlicht-mutants-" + std::to_string(::getpid()));
};

TEST_F(GltfMutation, OurOwnFilesAreReadOrRefused) {
    const std::filesystem::path car = folder_ / "whole" / "car.glb";
    std::filesystem::create_directories(car.parent_path());
    write_file(car, glb_of(car_body({}), {}));
    EXPECT_EQ(refused(car, 0, 1), 0U);
    const std::size_t mutants = 300, count = refused(car, mutants, 1);
    EXPECT_GT(count, mutants / 4);
    EXPECT_LT(count, mutants) << "a changed coordinate is no error";
    EXPECT_GT(refused(FERNLICHT_SOURCE_DIR "/scenarios/library/models/shelter.gltf", mutants, 2), mutants / 4);
}

TEST_F(GltfMutation, RealFilesAreReadOrRefused) {
    if (!std::filesystem::exists(real_files))
        GTEST_SKIP() << "no real files at " << real_files;
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(real_files)) {
        const std::filesystem::path& path = entry.path();
        if (path.extension() != ".gltf" && path.extension() != ".glb")
            continue;
        for (const auto& beside : std::filesystem::directory_iterator(path.parent_path())) // what it names
            if (beside.is_regular_file() && beside.file_size() < (1U << 20))
                std::filesystem::copy_file(beside.path(), folder_ / beside.path().filename(),
                                           std::filesystem::copy_options::overwrite_existing);
        refused(path, 20, static_cast<std::uint32_t>(++files));
    }
    EXPECT_GT(files, 10U);
}

} // namespace
} // namespace fernlicht
