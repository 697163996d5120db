// fernlicht-gltf.so: compressed meshes and pictures of glTF files, each bounded before it is decoded.
#include "scenarios/models/gltf_codecs.h"

#include <algorithm>
#include <memory>
#include <meshoptimizer.h>
#include <stdexcept>
#include <type_traits>
#include <webp/decode.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#pragma GCC diagnostic pop

namespace fernlicht {
namespace {

constexpr std::size_t max_draco_attributes = 16, max_draco_bytes = std::size_t{1} << 30;

[[noreturn]] void refuse(const std::string& reason) { throw std::invalid_argument(reason); }

/// What a mesh's head says it is, before there is memory for it. `vertices` is 0 where connectivity decides.
struct DracoHead {
    std::uint32_t triangles = 0, vertices = 0, seams = 0;
    bool whole = false;
};

DracoHead edgebreaker_head(draco::DecoderBuffer buffer) { // a copy: reading it moves nothing
    DracoHead head;
    std::uint32_t corners = 0, symbols = 0, splits = 0;
    std::int8_t seams = 0;
    head.whole = draco::DecodeVarint(&corners, &buffer) && draco::DecodeVarint(&head.triangles, &buffer) && buffer.Decode(&seams) &&
                 draco::DecodeVarint(&symbols, &buffer) && draco::DecodeVarint(&splits, &buffer) && seams >= 0 &&
                 corners <= 3 * std::uint64_t{head.triangles} && symbols <= head.triangles && splits <= symbols;
    head.seams = static_cast<std::uint32_t>(std::max<int>(seams, 0));
    return head;
}

DracoHead sequential_head(draco::DecoderBuffer buffer) {
    DracoHead head;
    head.whole = draco::DecodeVarint(&head.triangles, &buffer) && draco::DecodeVarint(&head.vertices, &buffer);
    return head;
}

/// A decoder of Draco that asks before it takes memory: for connectivity by its head, for attributes when they are known and still empty.
template <class Decoder> class Bounded : public Decoder {
  public:
    explicit Bounded(const DracoMesh& wanted) : wanted_(wanted) {}

  protected:
    bool DecodeConnectivity() override {
        constexpr bool edgebreaker = std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>;
        const DracoHead head = edgebreaker ? edgebreaker_head(*this->buffer()) : sequential_head(*this->buffer());
        if (!head.whole)
            refuse("a damaged head");
        if (head.triangles > wanted_.most_triangles || head.vertices > wanted_.most_vertices)
            refuse(std::to_string(head.triangles) + " triangles and " + std::to_string(head.vertices) +
                   " vertices, more than its accessors say");
        if (head.seams > max_draco_attributes)
            refuse("more than " + std::to_string(max_draco_attributes) + " attributes");
        return Decoder::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override {
        const draco::PointCloud& cloud = *this->point_cloud();
        if (cloud.num_points() > wanted_.most_vertices)
            refuse(std::to_string(cloud.num_points()) + " vertices, more than its accessors say");
        if (cloud.num_attributes() < 0 || static_cast<std::size_t>(cloud.num_attributes()) > max_draco_attributes)
            refuse("more than " + std::to_string(max_draco_attributes) + " attributes");
        std::size_t bytes = 0;
        for (int i = 0; i < cloud.num_attributes(); ++i) // as it is stored and, while it is decoded, as integers of 32 bits
            bytes += cloud.num_points() * (static_cast<std::size_t>(cloud.attribute(i)->byte_stride()) +
                                           4 * static_cast<std::size_t>(cloud.attribute(i)->num_components()));
        if (bytes > max_draco_bytes)
            refuse("attributes of " + std::to_string(bytes) + " bytes");
        return Decoder::DecodeAllAttributes();
    }

  private:
    const DracoMesh& wanted_;
};

std::unique_ptr<draco::MeshDecoder> decoder_for(draco::DecoderBuffer buffer, const DracoMesh& wanted) {
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok() || header.encoder_type != draco::TRIANGULAR_MESH)
        refuse("no mesh in Draco's format");
    if (header.version_major != 2 || header.version_minor != 2)
        refuse("version " + std::to_string(header.version_major) + "." + std::to_string(header.version_minor) + " of Draco's format");
    if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING)
        return std::make_unique<Bounded<draco::MeshEdgebreakerDecoder>>(wanted);
    return std::make_unique<Bounded<draco::MeshSequentialDecoder>>(wanted);
}

void take(const draco::Mesh& mesh, DracoMesh::Attribute& attribute) {
    const draco::PointAttribute* const given = mesh.GetAttributeByUniqueId(attribute.id);
    if (!given)
        refuse("no attribute " + std::to_string(attribute.id));
    if (static_cast<std::size_t>(given->num_components()) != attribute.width)
        refuse("an attribute of " + std::to_string(given->num_components()) + " numbers where its accessor has " +
               std::to_string(attribute.width));
    draco::PointAttribute values;
    values.CopyFrom(*given);
    values.set_normalized(attribute.normalized);
    attribute.values.resize(mesh.num_points() * attribute.width);
    for (std::uint32_t i = 0; i < mesh.num_points(); ++i)
        if (const draco::AttributeValueIndex value = values.mapped_index(draco::PointIndex(i));
            value.value() >= values.size() ||
            !values.ConvertValue<float>(value, static_cast<std::int8_t>(attribute.width), &attribute.values[i * attribute.width]))
            refuse("an attribute that is no list of numbers");
}

} // namespace

extern "C" __attribute__((visibility("default"))) void fernlicht_decode_draco(std::string_view bytes, DracoMesh& wanted) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    const std::unique_ptr<draco::MeshDecoder> decoder = decoder_for(buffer, wanted);
    draco::Mesh mesh;
    const draco::DecoderOptions options;
    if (const draco::Status status = decoder->Decode(options, &buffer, &mesh); !status.ok())
        refuse(status.error_msg_string());
    wanted.vertices = mesh.num_points();
    for (DracoMesh::Attribute& attribute : wanted.attributes)
        take(mesh, attribute);
    wanted.indices.clear();
    for (std::uint32_t i = 0; i < mesh.num_faces(); ++i)
        for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(i)))
            if (corner.value() < mesh.num_points())
                wanted.indices.push_back(corner.value());
            else // Draco lets it pass
                refuse("a corner at vertex " + std::to_string(corner.value()) + " of " + std::to_string(mesh.num_points()));
}

extern "C" __attribute__((visibility("default"))) void fernlicht_decode_meshopt(const MeshoptView& view, std::string& decoded) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(view.bytes.data());
    const std::size_t size = view.bytes.size(), count = view.count, stride = view.stride;
    if (view.mode == "ATTRIBUTES" ? stride % 4 != 0 || stride == 0 || stride > 256 : stride != 2 && stride != 4)
        refuse("a stride of " + std::to_string(stride));
    if (view.mode == "TRIANGLES" && count % 3 != 0)
        refuse(std::to_string(count) + " corners of triangles");
    // Least that the codecs write: 16 vertices take 2 bits a byte of theirs, a triangle one byte, an index of a sequence one.
    const bool possible = view.mode == "ATTRIBUTES" ? size >= count / 64 * stride : size >= count / (view.mode == "TRIANGLES" ? 3 : 1);
    if (!possible)
        refuse(std::to_string(size) + " bytes for " + std::to_string(count) + " elements");
    decoded.resize(count * stride);
    const int failed = view.mode == "ATTRIBUTES"  ? meshopt_decodeVertexBuffer(decoded.data(), count, stride, bytes, size)
                       : view.mode == "TRIANGLES" ? meshopt_decodeIndexBuffer(decoded.data(), count, stride, bytes, size)
                       : view.mode == "INDICES"   ? meshopt_decodeIndexSequence(decoded.data(), count, stride, bytes, size)
                                                  : -100;
    if (failed != 0)
        refuse(failed == -100 ? "an unknown mode" : "damaged bytes");
    if (view.filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
        meshopt_decodeFilterOct(decoded.data(), count, stride);
    else if (view.filter == "QUATERNION" && stride == 8)
        meshopt_decodeFilterQuat(decoded.data(), count, stride);
    else if (view.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(decoded.data(), count, stride);
    else if (view.filter != "NONE")
        refuse("an unknown filter, or one for another stride");
}

extern "C" __attribute__((visibility("default"))) void fernlicht_decode_webp(std::string_view bytes, WebpPicture& picture) {
    const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
        refuse("a damaged head");
    if (features.has_animation)
        refuse("an animation");
    const auto width = static_cast<std::size_t>(features.width), height = static_cast<std::size_t>(features.height);
    if (width * height > picture.most_pixels)
        refuse(std::to_string(width) + " x " + std::to_string(height) + " pixels, more than " + std::to_string(picture.most_pixels));
    picture.width = features.width;
    picture.height = features.height;
    picture.rgba.resize(4 * width * height);
    if (!WebPDecodeRGBAInto(data, bytes.size(), picture.rgba.data(), picture.rgba.size(), 4 * features.width))
        refuse("damaged bytes");
}

static_assert(std::is_same_v<decltype(fernlicht_decode_draco), DecodeDraco> &&
              std::is_same_v<decltype(fernlicht_decode_meshopt), DecodeMeshopt> &&
              std::is_same_v<decltype(fernlicht_decode_webp), DecodeWebp>);

} // namespace fernlicht
