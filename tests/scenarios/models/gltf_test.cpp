#include "scenarios/models/model.h"
#include "scenarios/models/road_user_bodies.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/models/written_gltf.h"
#include "tests/trial.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <random>
#include <tuple>

namespace fernlicht {
namespace {

using test::Json, test::WrittenGltf;
using testing::HasSubstr;

class Gltf : public testing::Test {
  protected:
    Model read(const WrittenGltf& file) const {
        file.write_gltf(folder_ / "model.gltf");
        return read_model(folder_ / "model.gltf");
    }
    std::string refusal(const WrittenGltf& file) const {
        file.write_gltf(folder_ / "model.gltf");
        return refusal(folder_ / "model.gltf");
    }
    std::string refusal_of_text(const std::string& text, const std::string& name = "model.gltf") const {
        return refusal(tests::written(name, text, folder_));
    }
    static std::string refusal(const std::filesystem::path& path) {
        return tests::refusal_of([&] { read_model(path); });
    }
    const std::filesystem::path folder_ = tests::new_folder();
};

TEST_F(Gltf, AxesAndNormalsBecomeOurs) {
    const Model model = read(WrittenGltf::triangle());
    ASSERT_EQ(model.meshes.size(), 1U);
    const Mesh& mesh = model.meshes[0];
    ASSERT_EQ(mesh.vertices.size(), 3U);
    EXPECT_EQ(mesh.vertices[1].position_m, glm::vec3(1, 0, 0)); // glTF's z is forward
    EXPECT_EQ(mesh.vertices[2].position_m, glm::vec3(0, 1, 0)); // its x is to the left
    EXPECT_EQ(mesh.vertices[0].normal, glm::vec3(0, 0, 1));     // its y is up
    EXPECT_EQ(model.triangles(), 1U);
    EXPECT_EQ(model.high_m, glm::dvec3(1, 1, 0));
}

TEST_F(Gltf, PackedAndLooseFilesAreTheSame) {
    const WrittenGltf file = WrittenGltf::triangle();
    const Model loose = read(file);
    file.write_glb(folder_ / "model.glb");
    const Model packed = read_model(folder_ / "model.glb");
    ASSERT_EQ(packed.meshes.size(), 1U);
    EXPECT_EQ(packed.meshes[0].indices, loose.meshes[0].indices);
    EXPECT_EQ(packed.meshes[0].vertices[2].position_m, loose.meshes[0].vertices[2].position_m);
    EXPECT_EQ(loose.opened.size(), 2U);
    EXPECT_EQ(packed.opened.size(), 1U);
}

TEST_F(Gltf, NodesTurnMoveAndMirror) {
    WrittenGltf file = WrittenGltf::triangle();
    // A parent 5 m up and 10 m ahead; a child turned by 90 degrees about glTF's y (to the left) and twice as large.
    const double h = std::sqrt(0.5);
    file.json["nodes"] = {{{"translation", {0, 5, 10}}, {"children", {1}}},
                          {{"mesh", 0}, {"rotation", {0, h, 0, h}}, {"scale", {2, 2, 2}}}};
    const Model model = read(file);
    const auto& v = model.meshes.at(0).vertices;
    EXPECT_LT(glm::length(v[0].position_m - glm::vec3(10, 0, 5)), 1e-6F);
    EXPECT_LT(glm::length(v[1].position_m - glm::vec3(10, 2, 5)), 1e-6F); // was ahead, is to the left
    EXPECT_LT(glm::length(v[2].position_m - glm::vec3(8, 0, 5)), 1e-6F);

    file.json["nodes"] = {{{"mesh", 0}, {"scale", {-1, 1, 1}}}};
    file.json["scenes"] = {{{"nodes", {0}}}};
    const Model mirrored = read(file);
    const auto& m = mirrored.meshes.at(0);
    const glm::vec3 a = m.vertices[m.indices[0]].position_m, b = m.vertices[m.indices[1]].position_m,
                    c = m.vertices[m.indices[2]].position_m;
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), m.vertices[0].normal), 0.0F) << "a mirrored triangle is turned over";
    EXPECT_EQ(m.vertices[0].normal, glm::vec3(0, 0, 1));
}

TEST_F(Gltf, NodesNamedLampAreMounts) {
    WrittenGltf file = WrittenGltf::triangle();
    file.json["nodes"] = {{{"mesh", 0}}, {{"name", "lamp.low.left"}, {"translation", {0.7, 0.65, 3.6}}}, {{"name", "headlamp"}}};
    file.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
    const Model model = read(file);
    ASSERT_EQ(model.mounts.size(), 1U);
    EXPECT_EQ(model.mounts[0].name, "lamp.low.left");
    EXPECT_LT(glm::length(model.mounts[0].pose.position_m - glm::dvec3(3.6, 0.7, 0.65)), 1e-12);
    EXPECT_EQ(std::tuple(model.mounts[0].pose.forward(), model.mounts[0].pose.up()), std::tuple(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1)));
}

TEST_F(Gltf, BaseColourIsReflectanceAndTheRestIsNoted) {
    WrittenGltf file = WrittenGltf::triangle();
    file.json["meshes"][0]["primitives"][0]["material"] = 0;
    file.json["materials"] = {{{"name", "paint"},
                               {"doubleSided", true},
                               {"alphaMode", "BLEND"},
                               {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 0.125, 1.0}}, {"metallicFactor", 0.5}}},
                               {"extras", {{"retro_rl", 2.5}}}}};
    file.json["animations"] = {Json::object()};
    file.json["extensions"]["KHR_lights_punctual"] = Json::object();
    const Model model = read(file);
    ASSERT_EQ(model.materials.size(), 1U);
    EXPECT_EQ(std::tuple(model.materials[0].albedo, model.materials[0].retro_rl), std::tuple(glm::vec3(0.5, 0.25, 0.125), 2.5F));
    EXPECT_EQ(model.triangles(), 2U) << "a second sheet that faces down";
    const std::string notes = testing::PrintToString(model.notes);
    for (const char* word : {"metal and gloss", "animations left out: 1", "lights of the file", "both sides"})
        EXPECT_THAT(notes, HasSubstr(word));
}

TEST_F(Gltf, StripsAndFansAreTriangles) {
    for (const int mode : {5, 6}) {
        WrittenGltf file({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}},
                         mode == 5 ? std::vector<std::uint32_t>{0, 1, 2, 3} : std::vector<std::uint32_t>{0, 1, 3, 2});
        file.json["meshes"][0]["primitives"][0]["mode"] = mode;
        const Model model = read(file);
        ASSERT_EQ(model.triangles(), 2U);
        for (const Vertex& v : model.meshes[0].vertices)
            EXPECT_EQ(v.normal, glm::vec3(0, 0, 1)) << "mode " << mode;
    }
}

TEST_F(Gltf, LargeModelsAreCutIntoCells) {
    WrittenGltf file({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, 1000}, {0, 0, 1001}, {1, 0, 1000}}, {0, 1, 2, 3, 4, 5});
    const Model model = read(file);
    ASSERT_EQ(model.meshes.size(), 2U);
    const Mesh& far = model.meshes[1];
    EXPECT_EQ(far.origin_m + glm::dvec3(far.vertices[0].position_m), glm::dvec3(1000, 0, 0));
}

TEST_F(Gltf, BrokenFilesAreRefusedInOneSentence) {
    const auto with = [](auto change) {
        WrittenGltf file = WrittenGltf::triangle();
        change(file);
        return file;
    };
    EXPECT_THAT(refusal_of_text("{\"asset\": {\"version\": \"2.0\"},\n \"meshes\": ["), HasSubstr(":2: no JSON"));
    EXPECT_THAT(refusal_of_text("[1, 2]"), HasSubstr("no object"));
    EXPECT_THAT(refusal_of_text("{}"), HasSubstr("no version"));
    EXPECT_THAT(refusal_of_text("{\"asset\": {\"version\": \"3.0\"}}"), HasSubstr("version '3.0'"));
    EXPECT_THAT(refusal_of_text(std::string(100'000, '[')), HasSubstr("nested deeper"));
    EXPECT_THAT(refusal_of_text(std::string("glTF\2\0\0\0", 8)), HasSubstr("bytes"));
    EXPECT_THAT(refusal_of_text(std::string("glTF\2\0\0\0\xff\0\0\0\x10\0\0\0JSON", 20)), HasSubstr("header says 255"));
    EXPECT_THAT(refusal(with([](auto& f) {
                    f.json["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}};
                })),
                HasSubstr("nodes[2].children[0]: node 1, which has a parent already"));
    EXPECT_THAT(refusal(with([](auto& f) {
                    f.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
                    f.json["scenes"][0]["nodes"] = {0};
                })),
                HasSubstr("reached twice"));
    EXPECT_THAT(refusal(with([](auto& f) { f.json["accessors"][1]["count"] = 1e9; })), HasSubstr("accessors[1].count"));
    EXPECT_THAT(refusal(with([](auto& f) { f.json["accessors"][0]["count"] = 4; })), HasSubstr("48 bytes in a buffer view of 36"));
    EXPECT_THAT(refusal(with([](auto& f) { f.json["bufferViews"][1]["byteLength"] = 400; })), HasSubstr("a view within its buffer"));
    EXPECT_THAT(refusal(with([](auto& f) { f.json["bufferViews"][1]["byteOffset"] = -4; })), HasSubstr("byteOffset"));
    EXPECT_THAT(refusal(with([](auto& f) { f.buffer[40] = 7; })), HasSubstr("below 3, the number of vertices"));
    EXPECT_THAT(refusal(with([](auto& f) { f.json["meshes"][0]["primitives"][0]["indices"] = 9; })),
                HasSubstr("meshes[0].primitives[0].indices: found 9, expected 0 to 1"));
    EXPECT_THAT(refusal(with([](auto& f) { std::memset(f.buffer.data(), 0xFF, 4); })), HasSubstr("not finite"));
    EXPECT_THAT(refusal(with([](auto& f) { f.json["nodes"][0]["translation"] = {1e8, 0, 0}; })), HasSubstr("within 100000 m"));
    EXPECT_THAT(refusal(with([](auto& f) { f.json["extensionsRequired"] = {"KHR_texture_basisu"}; })), HasSubstr("KHR_texture_basisu"));
    const auto with_uri = [&](const std::string& uri) {
        WrittenGltf file = WrittenGltf::triangle();
        file.json["buffers"] = {{{"byteLength", 4}, {"uri", uri}}};
        return refusal_of_text(file.json.dump());
    };
    EXPECT_THAT(with_uri("../secret.bin"), HasSubstr("beside or below"));
    EXPECT_THAT(with_uri("/etc/passwd"), HasSubstr("beside or below"));
    EXPECT_THAT(with_uri("https://example.org/a.bin"), HasSubstr("beside or below"));
    EXPECT_THAT(with_uri("%2e%2e/a.bin"), HasSubstr("beside or below"));
    EXPECT_THAT(with_uri("absent.bin"), HasSubstr("there is no file"));
    EXPECT_THAT(with_uri("data:application/octet-stream;base64,AA=="), HasSubstr("1 bytes where byteLength says 4"));
}

TEST_F(Gltf, CopiesWithoutEndAreRefusedBeforeTheyAreMade) {
    // 2000 nodes that each show 3000 triangles: 6 million in a small file.
    std::vector<std::uint32_t> indices;
    for (int i = 0; i < 3000; ++i)
        indices.insert(indices.end(), {0, 1, 2});
    WrittenGltf file({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, indices);
    file.json["nodes"] = Json::array();
    file.json["scenes"][0]["nodes"] = Json::array();
    for (int i = 0; i < 2000; ++i) {
        file.json["nodes"].push_back({{"mesh", 0}});
        file.json["scenes"][0]["nodes"].push_back(i);
    }
    EXPECT_THAT(refusal(file), HasSubstr("nodes[1333]: with it the model has 4002000 triangles"));
}

const std::filesystem::path models_folder = std::filesystem::path(FERNLICHT_SHARED_DATA) / "models";

/// Models of others; none where there are no such files.
std::vector<std::filesystem::path> real_models() { return tests::files_below(models_folder, {".gltf", ".glb"}); }

/// What becomes of each file of others: read, or refused for this reason.
TEST_F(Gltf, FilesOfOthersAreReadOrRefusedPrecisely) {
    if (real_models().empty())
        GTEST_SKIP() << "no models at " << models_folder;
    int read = 0, refused = 0;
    for (const std::filesystem::path& path : real_models()) {
        try {
            const Model model = read_model(path);
            ++read;
            for (const Mesh& mesh : model.meshes)
                for (const std::uint32_t index : mesh.indices)
                    ASSERT_LT(index, mesh.vertices.size());
            for (const Material& material : model.materials)
                EXPECT_LT(material.texture, static_cast<int>(model.textures.size()));
        } catch (const InputError& error) {
            ++refused;
            const std::string what = error.what();
            EXPECT_THAT(what, HasSubstr("expected"));
            EXPECT_LT(what.size(), 700U) << what;
        }
        RecordProperty(path.filename().string(), read);
    }
    EXPECT_GE(read, 10);
    EXPECT_GE(refused, 9);
}

TEST_F(Gltf, ACarOfOthersHasItsSizeAndItsPicture) {
    const std::filesystem::path truck = models_folder / "assimp__assimp/test/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf";
    if (!std::filesystem::exists(truck))
        GTEST_SKIP() << "no " << truck;
    const Model model = read_model(truck);
    // From the minima and maxima that the file declares of its accessors, along glTF's x, y and z; wheels from the ground up.
    EXPECT_NEAR(model.high_m.y - model.low_m.y, 2.438 + 2.43091, 1e-4);
    EXPECT_NEAR(model.high_m.z, 2.58437, 1e-4);
    EXPECT_NEAR(model.low_m.z, 0.0, 2e-3);
    EXPECT_NEAR(model.high_m.x - model.low_m.x, 2 * 1.396, 1e-4);
    EXPECT_EQ(model.triangles(), (5232U + 168U + 864U + 2U * 2304U) / 3U);
    ASSERT_EQ(model.textures.size(), 1U);
    EXPECT_EQ(model.textures[0].width, 512);
}

// Files with bytes changed, cut out, doubled or swapped at random: each is read or refused in one sentence, and nothing else happens.
// Under AddressSanitizer (ci/sanitize) this is where the reader is tried.

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
    /// How many of the mutants were refused; the rest were read and are whole.
    std::size_t refused(const std::filesystem::path& file, std::size_t mutants, std::uint32_t seed) {
        std::mt19937 random(seed);
        FilesRead opened;
        const std::string bytes = read_file(file, opened);
        std::size_t count = 0;
        for (std::size_t k = 0; k < mutants; ++k) {
            tests::written(file.filename(), mutated(bytes, random), folder_);
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
    const std::filesystem::path folder_ = tests::new_folder();
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
    if (real_models().empty())
        GTEST_SKIP() << "no models at " << models_folder;
    std::size_t files = 0;
    for (const std::filesystem::path& path : real_models()) {
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
