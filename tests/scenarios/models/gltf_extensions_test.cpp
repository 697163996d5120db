// Extensions that towns and other large models come with. Each file is made here, by the library that the reader decodes with or by hand.
#include "scenarios/models/cut_outs.h"
#include "scenarios/models/material_doubts.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/models/written_gltf.h"
#include "tests/trial.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <meshoptimizer.h>
#include <webp/encode.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#pragma GCC diagnostic pop

namespace fernlicht {
namespace {

using test::add_accessor, test::add_view, test::attributes, test::bytes_of, test::give_picture, test::Json, test::square, test::WrittenGltf;
using testing::HasSubstr;

/// `pixel(x, y)` as red, green, blue, opacity.
template <class Pixel> std::string webp(int side, Pixel pixel) {
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (const int value : pixel(x, y))
                rgba.push_back(static_cast<std::uint8_t>(value));
    std::uint8_t* out = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), side, side, 4 * side, &out);
    std::string bytes(reinterpret_cast<const char*>(out), size);
    WebPFree(out);
    return bytes;
}

/// A square of n x n vertices 1 m apart as KHR_draco_mesh_compression has it; heights of a saddle.
WrittenGltf draco_hills(int n, int method) {
    const auto at = [&](int x, int y) {
        return std::array{static_cast<float>(x), 0.1F * static_cast<float>(x * y % 7), static_cast<float>(y)};
    };
    draco::TriangleSoupMeshBuilder builder;
    const int faces = 2 * (n - 1) * (n - 1);
    builder.Start(faces);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const auto corner_uv = [](const std::array<float, 3>& p) { return std::array{p[0] * 0.125F, p[2] * 0.125F}; };
    int face = 0;
    for (int y = 0; y + 1 < n; ++y)
        for (int x = 0; x + 1 < n; ++x)
            for (const auto& t :
                 {std::array{at(x, y), at(x, y + 1), at(x + 1, y + 1)}, std::array{at(x, y), at(x + 1, y + 1), at(x + 1, y)}}) {
                const std::array uvs{corner_uv(t[0]), corner_uv(t[1]), corner_uv(t[2])};
                builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(face)), t[0].data(), t[1].data(),
                                                  t[2].data());
                builder.SetAttributeValuesForFace(uv, draco::FaceIndex(static_cast<std::uint32_t>(face)), uvs[0].data(), uvs[1].data(),
                                                  uvs[2].data());
                ++face;
            }
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
    draco::EncoderBuffer encoded;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &encoded).ok());
    WrittenGltf file({}, {});
    const std::size_t vertices = mesh->num_points();
    file.json["accessors"] = {{{"componentType", 5126}, {"count", vertices}, {"type", "VEC3"}},
                              {{"componentType", 5125}, {"count", 3 * faces}, {"type", "SCALAR"}},
                              {{"componentType", 5126}, {"count", vertices}, {"type", "VEC2"}}};
    attributes(file)["TEXCOORD_0"] = 2;
    file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", add_view(file, std::string(encoded.data(), encoded.size()))},
        {"attributes", {{"POSITION", mesh->attribute(position)->unique_id()}, {"TEXCOORD_0", mesh->attribute(uv)->unique_id()}}}};
    file.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return file;
}

Json& draco_of(WrittenGltf& file) { return file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]; }

/// These elements as EXT_meshopt_compression, in place of a view's bytes; the view stands on a buffer that is not there.
void compress_view(WrittenGltf& file, std::size_t view, const std::string& encoded, std::size_t count, std::size_t stride, const char* mode,
                   const char* filter = "NONE") {
    const std::size_t compressed = add_view(file, encoded);
    Json& there = file.json["bufferViews"][compressed];
    Json extension = {{"buffer", 0},
                      {"byteOffset", there["byteOffset"]},
                      {"byteLength", encoded.size()},
                      {"byteStride", stride},
                      {"count", count},
                      {"mode", mode},
                      {"filter", filter}};
    file.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"] = extension;
    file.json["bufferViews"][view]["byteLength"] = count * stride;
}

template <class T> std::string encoded_vertices(const std::vector<T>& values, std::size_t stride) {
    const std::size_t count = values.size() * sizeof(T) / stride;
    std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
    meshopt_encodeVertexVersion(0);
    out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), values.data(), count, stride));
    return out;
}

std::string encoded_triangles(const std::vector<unsigned>& indices, std::size_t vertices) {
    std::string out(meshopt_encodeIndexBufferBound(indices.size(), vertices), '\0');
    meshopt_encodeIndexVersion(1);
    out.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(), indices.data(), indices.size()));
    return out;
}

/// The triangle of WrittenGltf, its positions and indices compressed by meshoptimizer.
WrittenGltf meshopt_triangle() {
    WrittenGltf file = WrittenGltf::triangle();
    compress_view(file, 0, encoded_vertices<float>({0, 0, 0, 0, 0, 1, 1, 0, 0}, 12), 3, 12, "ATTRIBUTES");
    compress_view(file, 1, encoded_triangles({0, 1, 2}, 3), 3, 4, "TRIANGLES");
    file.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    return file;
}

double area_of(const Model& model) {
    double sum = 0.0;
    for (const Mesh& mesh : model.meshes)
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) { return glm::dvec3(mesh.vertices[mesh.indices[i + k]].position_m); };
            sum += 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
        }
    return sum;
}

class GltfExtensions : public testing::Test {
  protected:
    Model read(const WrittenGltf& file) const {
        file.write_glb(folder_ / "model.glb");
        return read_model(folder_ / "model.glb");
    }
    std::string refusal(const WrittenGltf& file) const {
        return tests::refusal_of([&] { read(file); });
    }
    const std::filesystem::path folder_ = tests::new_folder();
};

TEST_F(GltfExtensions, QuantisedPositionsNormalsAndTextureCoordinates) {
    WrittenGltf file = WrittenGltf::triangle();
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    // 16-bit positions as they are; 8-bit normals and 16-bit texture coordinates as shares. Rows of three 16-bit numbers take 8 bytes.
    attributes(file)["POSITION"] = add_accessor(file, bytes_of<std::int16_t>({0, 0, 0, 0, 0, 0, 400, 0, -300, 0, 0, 0}), 5122, 3, "VEC3");
    file.json["bufferViews"].back()["byteStride"] = 8;
    attributes(file)["NORMAL"] =
        add_accessor(file, bytes_of<std::int8_t>({0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0}), 5120, 3, "VEC3", true);
    file.json["bufferViews"].back()["byteStride"] = 4;
    attributes(file)["TEXCOORD_0"] = add_accessor(file, bytes_of<std::uint16_t>({0, 65535, 32768, 0, 65535, 65535}), 5123, 3, "VEC2", true);
    file.json["nodes"][0]["scale"] = {0.01, 0.01, 0.01};
    const Model model = read(file);
    const auto& v = model.meshes.at(0).vertices;
    EXPECT_LT(glm::length(v[1].position_m - glm::vec3(4, 0, 0)), 1e-6F);
    EXPECT_LT(glm::length(v[2].position_m - glm::vec3(0, -3, 0)), 1e-6F);
    EXPECT_LT(glm::length(v[1].normal - glm::vec3(0, 0, 1)), 1e-6F);
    EXPECT_NEAR(v[1].uv.x, 32768.0 / 65535.0, 1e-6);
    EXPECT_EQ(v[2].uv, glm::vec2(1, 1));
    // The same as bytes and as shares of 16 bits.
    attributes(file).erase("TEXCOORD_0");
    attributes(file)["POSITION"] = add_accessor(file, bytes_of<std::int8_t>({0, 0, 0, 0, 0, 0, 4, 0, -3, 0, 0, 0}), 5120, 3, "VEC3");
    file.json["bufferViews"].back()["byteStride"] = 4;
    attributes(file)["NORMAL"] =
        add_accessor(file, bytes_of<std::int16_t>({0, 32767, 0, 0, 0, 32767, 0, 0, 0, 32767, 0, 0}), 5122, 3, "VEC3", true);
    file.json["bufferViews"].back()["byteStride"] = 8;
    file.json["nodes"][0]["scale"] = {1, 1, 1};
    const Model bytes = read(file);
    EXPECT_EQ(bytes.meshes.at(0).vertices[1].position_m, glm::vec3(4, 0, 0));
    EXPECT_EQ(bytes.meshes.at(0).vertices[1].normal, glm::vec3(0, 0, 1));
}

TEST_F(GltfExtensions, InstancesStandWhereTheirNumbersSay) {
    WrittenGltf file = WrittenGltf::triangle();
    const std::size_t moves = add_accessor(file, bytes_of<float>({10, 0, 0, 0, 0, 20}), 5126, 2, "VEC3");
    // Of bytes as shares: not turned, and by 90 degrees about glTF's y.
    const std::size_t turns = add_accessor(file, bytes_of<std::int8_t>({0, 0, 0, 127, 0, 90, 0, 90}), 5120, 2, "VEC4", true);
    const std::size_t scales = add_accessor(file, bytes_of<float>({1, 1, 1, 2, 2, 2}), 5126, 2, "VEC3");
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", moves}, {"ROTATION", turns}, {"SCALE", scales}};
    file.json["nodes"][0]["translation"] = {0, 5, 0};
    file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Model model = read(file);
    ASSERT_EQ(model.triangles(), 2U);
    const auto& v = model.meshes.at(0).vertices;
    EXPECT_LT(glm::length(v[0].position_m - glm::vec3(0, 10, 5)), 1e-6F);
    EXPECT_LT(glm::length(v[1].position_m - glm::vec3(1, 10, 5)), 1e-6F);
    EXPECT_LT(glm::length(v[3].position_m - glm::vec3(20, 0, 5)), 1e-6F);
    EXPECT_LT(glm::length(v[4].position_m - glm::vec3(20, 2, 5)), 1e-5F) << "turned to the left, twice as large";

    WrittenGltf uneven = file;
    uneven.json["accessors"][scales]["count"] = 1;
    EXPECT_THAT(refusal(uneven), HasSubstr("instances"));
    WrittenGltf still = file;
    std::memset(
        still.buffer.data() +
            still.json["bufferViews"][still.json["accessors"][turns]["bufferView"].get<std::size_t>()]["byteOffset"].get<std::size_t>(),
        0, 4);
    EXPECT_THAT(refusal(still), HasSubstr("instance 0 has a quaternion without direction"));
    WrittenGltf many = file; // 5 million places of one triangle
    for (const std::size_t i : {moves, scales}) {
        many.json["accessors"][i].erase("bufferView");
        many.json["accessors"][i]["count"] = 5'000'000;
    }
    many.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"].erase("ROTATION");
    EXPECT_THAT(refusal(many), HasSubstr("at most"));
}

TEST_F(GltfExtensions, DracoMeshesAreThoseThatWereEncoded) {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const Model model = read(draco_hills(9, method));
        EXPECT_EQ(model.triangles(), 128U);
        EXPECT_LT(glm::length(model.high_m - glm::dvec3(8, 8, 0.6)), 1e-3) << "16 bits of 8 m";
        EXPECT_LT(glm::length(model.low_m), 1e-3);
        for (const Vertex& v : model.meshes.at(0).vertices) {
            EXPECT_NEAR(v.uv.x, 0.125F * v.position_m.y, 1e-3);
            EXPECT_NEAR(v.uv.y, 0.125F * v.position_m.x, 1e-3);
            const long x = std::lround(v.position_m.y), y = std::lround(v.position_m.x);
            EXPECT_NEAR(v.position_m.z, 0.1 * static_cast<double>(x * y % 7), 1e-3);
        }
    }
}

TEST_F(GltfExtensions, DracoClaimsAreHeldAgainstTheAccessors) {
    WrittenGltf few = draco_hills(9, draco::MESH_EDGEBREAKER_ENCODING);
    few.json["accessors"][1]["count"] = 3;
    EXPECT_THAT(refusal(few), HasSubstr("128 triangles"));
    WrittenGltf vertices = draco_hills(9, draco::MESH_SEQUENTIAL_ENCODING);
    vertices.json["accessors"][0]["count"] = 80;
    EXPECT_THAT(refusal(vertices), HasSubstr("81 vertices, more than its accessors say"));
    WrittenGltf other = draco_hills(9, draco::MESH_EDGEBREAKER_ENCODING);
    draco_of(other)["attributes"]["POSITION"] = 77;
    EXPECT_THAT(refusal(other), HasSubstr("no attribute 77"));
    WrittenGltf swapped = draco_hills(9, draco::MESH_EDGEBREAKER_ENCODING);
    draco_of(swapped)["attributes"]["TEXCOORD_0"] = draco_of(swapped)["attributes"]["POSITION"];
    EXPECT_THAT(refusal(swapped), HasSubstr("an attribute of 3 numbers where its accessor has 2"));
    WrittenGltf none = draco_hills(9, draco::MESH_EDGEBREAKER_ENCODING);
    draco_of(none)["bufferView"] = 0;
    EXPECT_THAT(refusal(none), HasSubstr("expected a mesh compressed by Draco"));
}

TEST_F(GltfExtensions, MeshoptimizersViewsAreThoseThatWereEncoded) {
    const Model model = read(meshopt_triangle());
    EXPECT_EQ(model.triangles(), 1U);
    EXPECT_EQ(model.high_m, glm::dvec3(1, 1, 0));
    // Octahedral normals: x and y of 8 bits, one in the third, nothing in the fourth.
    WrittenGltf file = meshopt_triangle();
    std::vector<std::int8_t> normals(12);
    const std::vector<float> up{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
    meshopt_encodeFilterOct(normals.data(), 3, 4, 8, up.data());
    attributes(file)["NORMAL"] = add_accessor(file, std::string(12, '\0'), 5120, 3, "VEC3", true);
    const std::size_t view = file.json["bufferViews"].size() - 1;
    file.json["bufferViews"][view]["byteStride"] = 4;
    compress_view(file, view, encoded_vertices(normals, 4), 3, 4, "ATTRIBUTES", "OCTAHEDRAL");
    file.json["bufferViews"][view]["byteStride"] = 4;
    const Model with_normals = read(file);
    for (const Vertex& v : with_normals.meshes.at(0).vertices)
        EXPECT_LT(glm::length(v.normal - glm::vec3(0, 0, 1)), 1e-2F);
    const auto with = [&](auto change) {
        WrittenGltf changed = meshopt_triangle();
        change(changed.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]);
        return refusal(changed);
    };
    EXPECT_THAT(with([](Json& e) { e["mode"] = "STRIPS"; }), HasSubstr("stride"));
    EXPECT_THAT(with([](Json& e) { e["byteStride"] = 8; }), HasSubstr("the 36 bytes of its view"));
    EXPECT_THAT(with([](Json& e) { e["count"] = 12'000'000; }), HasSubstr("bytes for 12000000 elements"));
    EXPECT_THAT(with([](Json& e) { e["count"] = 12'000'000, e["byteStride"] = 256; }), HasSubstr("at most 268435456"));
    EXPECT_THAT(with([](Json& e) { e["filter"] = "OCTAHEDRAL"; }), HasSubstr("filter"));
    EXPECT_THAT(with([](Json& e) { e["byteLength"] = 5; }), HasSubstr("damaged bytes"));
}

TEST_F(GltfExtensions, ABufferThatStandsInNeedsNoFile) {
    WrittenGltf file = meshopt_triangle();
    for (const std::size_t i : {0U, 1U}) {
        file.json["bufferViews"][i]["buffer"] = 1;
        file.json["bufferViews"][i]["byteOffset"] = 0;
    }
    file.write_gltf(folder_ / "model.gltf");
    FilesRead opened;
    Json whole = Json::parse(read_file(folder_ / "model.gltf", opened));
    whole["buffers"].push_back({{"byteLength", 100}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    tests::written("model.gltf", whole.dump(), folder_);
    EXPECT_EQ(read_model(folder_ / "model.gltf").triangles(), 1U);
}

TEST_F(GltfExtensions, WebpIsLinearReflectanceAsPngIs) {
    WrittenGltf file = square();
    give_picture(file, webp(4, [](int, int) { return std::array{188, 188, 188, 255}; }), "EXT_texture_webp");
    file.json["extensionsRequired"] = {"EXT_texture_webp"};
    const Model model = read(file);
    ASSERT_EQ(model.textures.size(), 1U);
    EXPECT_EQ(model.textures[0].width, 4);
    EXPECT_EQ(model.textures[0].rgba[0], 128) << "sRGB 188 is 0.503";
    EXPECT_NEAR(mean_reflectance(model, model.materials[0]), 0.502, 1e-3);
    WrittenGltf cut = file;
    cut.json["bufferViews"].back()["byteLength"] = 20;
    EXPECT_THAT(refusal(cut), HasSubstr("expected a picture in WebP"));
    WrittenGltf large = square(); // its head says 16384 x 16384: 14 bits each
    std::string head = webp(4, [](int, int) { return std::array{1, 2, 3, 255}; });
    for (const std::size_t at : {21U, 22U, 23U})
        head[at] = '\xff';
    head[24] = '\x0f';
    give_picture(large, head, "EXT_texture_webp");
    EXPECT_THAT(refusal(large), HasSubstr("pixels, more than 16777216"));
}

TEST_F(GltfExtensions, WhatIsClearIsCutOutOfItsTriangles) {
    // A disc of 0.4 m radius in a picture of 64 x 64, red on clear green.
    WrittenGltf file = square();
    give_picture(file, webp(64, [](int x, int y) {
                     const bool opaque = std::hypot(x - 31.5, y - 31.5) < 0.4 * 64;
                     return std::array{opaque ? 255 : 0, opaque ? 0 : 255, 0, opaque ? 255 : 0};
                 }));
    EXPECT_NEAR(area_of(read(file)), 1.0, 1e-9) << "opaque";
    for (const char* mode : {"MASK", "BLEND"}) {
        file.json["materials"][0]["alphaMode"] = mode;
        const Model model = read(file);
        EXPECT_NEAR(area_of(model), 3.14159 * 0.16, 0.01) << mode;
        for (const Vertex& v : model.meshes.at(0).vertices)
            EXPECT_LT(std::hypot(v.position_m.x - 0.5F, v.position_m.y - 0.5F), 0.42F);
        const std::vector<std::uint8_t>& texels = model.textures.at(0).rgba;
        EXPECT_EQ(texels[0], 255) << "clear texels have the colour of the others";
        EXPECT_EQ(texels[1], 0);
        EXPECT_THAT(testing::PrintToString(model.notes), HasSubstr("cut out"));
    }
    // Repeated four times in each direction, and on both sides.
    for (std::size_t i = 0; i < 8; ++i) {
        float uv = 0.0F;
        char* const at = file.buffer.data() + file.json["bufferViews"][2]["byteOffset"].get<std::size_t>() + 4 * i;
        std::memcpy(&uv, at, 4);
        uv *= -4.0F;
        std::memcpy(at, &uv, 4);
    }
    file.json["materials"][0]["doubleSided"] = true;
    EXPECT_NEAR(area_of(read(file)), 2 * 3.14159 * 0.16, 0.06);
    // Opacity of the material alone: there, or not.
    WrittenGltf glass = square();
    glass.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    glass.json["materials"][0] = {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.3}}}}};
    EXPECT_EQ(read(glass).triangles(), 2U);
    glass.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.6;
    EXPECT_EQ(read(glass).triangles(), 4U);
    glass.json["materials"][0] = {{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.9}}}}}};
    EXPECT_EQ(read(glass).triangles(), 2U);
}

TEST_F(GltfExtensions, ColoursOfVerticesAreMeansOfFaces) {
    WrittenGltf file = square();
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 1, 1};
    // One face from black to white over its corners, the other grey: means 1/3 and 0.5.
    attributes(file)["COLOR_0"] = add_accessor(
        file, bytes_of<std::uint8_t>({0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255, 255}), 5121, 4, "VEC4", true);
    const Model model = read(file);
    ASSERT_EQ(model.materials.size(), 2U);
    EXPECT_LT(glm::length(model.materials[0].albedo - glm::vec3(0.5F, 1, 1) / 3.0F), 1e-6F);
    EXPECT_LT(glm::length(model.materials[1].albedo - glm::vec3(0.5F, 1, 1) * (2.0F / 3.0F)), 1e-6F);
    EXPECT_EQ(model.meshes.at(0).batches.size(), 2U);
    // White ones change nothing.
    attributes(file)["COLOR_0"] = add_accessor(file, bytes_of<float>(std::vector<float>(12, 1.0F)), 5126, 4, "VEC3");
    EXPECT_EQ(read(file).materials.size(), 1U);
}

TEST_F(GltfExtensions, ManyColoursKeepTheirMean) {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::uint32_t> indices;
    std::vector<float> colours;
    glm::dvec3 mean(0.0);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const float x = static_cast<float>(i);
        positions.insert(positions.end(), {{x, 0, 0}, {x, 0, 1}, {x + 1, 0, 0}});
        indices.insert(indices.end(), {3 * i, 3 * i + 1, 3 * i + 2});
        const glm::vec3 colour = glm::vec3(glm::uvec3(i % 10, i / 10 % 10, i / 100)) / 9.0F;
        for (int k = 0; k < 3; ++k)
            colours.insert(colours.end(), {colour.r, colour.g, colour.b});
        mean += glm::dvec3(colour) / 1000.0;
    }
    WrittenGltf file(positions, indices);
    attributes(file)["COLOR_0"] = add_accessor(file, bytes_of(colours), 5126, 3000, "VEC3");
    const Model model = read(file);
    EXPECT_LE(model.materials.size(), 64U);
    EXPECT_GT(model.materials.size(), 16U);
    glm::dvec3 found(0.0);
    for (const Mesh& mesh : model.meshes)
        for (const Batch& batch : mesh.batches)
            found += glm::dvec3(model.materials[batch.material].albedo) * (batch.count / 3000.0);
    EXPECT_LT(glm::length(found - mean), 1e-5);
}

TEST_F(GltfExtensions, SparseAccessorsReplaceWhatTheyName) {
    WrittenGltf file = WrittenGltf::triangle();
    file.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", add_view(file, bytes_of<std::uint16_t>({2}))}, {"componentType", 5123}}},
        {"values", {{"bufferView", add_view(file, bytes_of<float>({5, 0, 0}))}}}};
    EXPECT_EQ(read(file).high_m, glm::dvec3(1, 5, 0));
}

/// Each file cut off at every step and with bits flipped all over: read, or refused in one sentence.
TEST_F(GltfExtensions, DamagedFilesAreReadOrRefused) {
    WrittenGltf leaves = square();
    give_picture(leaves, webp(32, [](int x, int y) { return std::array{x, y, 100, (x * y) % 256}; }), "EXT_texture_webp");
    leaves.json["materials"][0]["alphaMode"] = "MASK";
    const std::vector<WrittenGltf> files{draco_hills(6, draco::MESH_EDGEBREAKER_ENCODING), draco_hills(6, draco::MESH_SEQUENTIAL_ENCODING),
                                         meshopt_triangle(), leaves};
    std::size_t refused = 0, whole = 0;
    const auto attempt = [&](const std::string& bytes) {
        try {
            read_model(tests::written("model.glb", bytes, folder_));
            ++whole;
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            EXPECT_LT(std::string(error.what()).size(), 2000U);
            ++refused;
        }
    };
    for (const WrittenGltf& file : files) {
        file.write_glb(folder_ / "whole.glb");
        FilesRead opened;
        const std::string bytes = read_file(folder_ / "whole.glb", opened);
        for (std::size_t end = 0; end < bytes.size(); end += 64)
            attempt(bytes.substr(0, end));
        const std::size_t payload = bytes.size() - file.buffer.size();
        for (std::size_t at = payload; at < bytes.size(); ++at)
            for (const std::size_t bit : {at % 8, (at + 3) % 8}) {
                std::string flipped = bytes;
                flipped[at] = static_cast<char>(static_cast<unsigned char>(flipped[at]) ^ (1U << bit));
                attempt(flipped);
            }
    }
    EXPECT_GT(refused, 100U);
    EXPECT_GT(whole, 100U);
}

} // namespace
} // namespace fernlicht
