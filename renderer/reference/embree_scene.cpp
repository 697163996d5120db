#include "renderer/reference/embree_scene.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <tbb/parallel_for.h>
#if __has_include(<embree4/rtcore.h>) // CMake, too, takes 4 before 3
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace fernlicht::reference {
namespace {

constexpr unsigned ground_mask = 1, stands_mask = 2, casters_mask = 3, no_caster_mask = 4, all_mask = 7, measured_alone_mask = 8,
                   measured_mask = ground_mask | measured_alone_mask; ///< what maps show

constexpr double raise_share = 8.0 / 16777216.0; // eight units of 2^-24
constexpr double min_extent_m = 100.0;           // triangles of ours are up to so long, and rounding follows the larger of both

/// Segments end this share before the point that they look at: a lamp's own glass, if it were there, casts no shadow on the light.
constexpr float segment_end = 1.0F - 1e-6F;

bool stands_on_ground(const Scene& scene, const Mesh& mesh) {
    return std::ranges::any_of(mesh.batches, [&](const Batch& batch) { return !is_ground(scene.materials[batch.material].kind); });
}

std::size_t triangle_count(const Mesh& mesh) {
    std::size_t count = 0;
    for (const Batch& batch : mesh.batches)
        count += batch.count / 3;
    return count;
}

/// oneTBB gives all loops to come the floating-point settings that it met first. Embree's builders, which are loops of oneTBB, flush
/// denormals to zero while they run; were they the first, every loop after them would, the reference's own in double among them.
void meet_tbb_first() {
    tbb::parallel_for(0, 1, [](int) {});
}

// How rays are asked for in Embree 4, and in 3. Those of a packet lie side by side: "coherent".
#if RTC_VERSION_MAJOR >= 4
void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray); }
void occlude(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }
void intersect(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    RTCIntersectArguments coherent;
    rtcInitIntersectArguments(&coherent);
    coherent.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &rays, &coherent);
}
void occlude(RTCScene scene, const int* valid, RTCRay16& rays) {
    RTCOccludedArguments coherent;
    rtcInitOccludedArguments(&coherent);
    coherent.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded16(valid, scene, &rays, &coherent);
}
#else
RTCIntersectContext context(RTCIntersectContextFlags flags) {
    RTCIntersectContext made;
    rtcInitIntersectContext(&made);
    made.flags = flags;
    return made;
}
void intersect(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext alone = context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcIntersect1(scene, &alone, &ray);
}
void occlude(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext alone = context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcOccluded1(scene, &alone, &ray);
}
void intersect(RTCScene scene, const int* valid, RTCRayHit16& rays) {
    RTCIntersectContext coherent = context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcIntersect16(valid, scene, &coherent, &rays);
}
void occlude(RTCScene scene, const int* valid, RTCRay16& rays) {
    RTCIntersectContext coherent = context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcOccluded16(valid, scene, &coherent, &rays);
}
#endif

RTCRay ray_of(const glm::dvec3& from_m, const glm::dvec3& way, float end, unsigned mask) {
    const glm::vec3 o(from_m), d(way);
    return {o.x, o.y, o.z, 0.0F, d.x, d.y, d.z, 0.0F, end, mask, 0, 0};
}

void set_lane(RTCRay16& rays, std::size_t i, const RTCRay& ray) {
    rays.org_x[i] = ray.org_x, rays.org_y[i] = ray.org_y, rays.org_z[i] = ray.org_z;
    rays.dir_x[i] = ray.dir_x, rays.dir_y[i] = ray.dir_y, rays.dir_z[i] = ray.dir_z;
    rays.tnear[i] = ray.tnear, rays.tfar[i] = ray.tfar, rays.time[i] = ray.time;
    rays.mask[i] = ray.mask, rays.id[i] = ray.id, rays.flags[i] = ray.flags;
}

constexpr float no_end = std::numeric_limits<float>::infinity();

RTCDevice new_device() {
    if (const RTCDevice device = rtcNewDevice(nullptr))
        return device;
    throw DeviceError("Embree cannot start on this machine, or with the memory that it may take");
}

} // namespace

std::string embree_version() {
    const RTCDevice device = new_device();
    const long version = static_cast<long>(rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION));
    rtcReleaseDevice(device);
    return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." + std::to_string(version % 100);
}

struct EmbreeScene::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    void check(const char* doing) const {
        if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
            throw DeviceError(std::string("Embree: ") + doing + ": error " + std::to_string(static_cast<int>(error)));
    }
    Embree() = default;
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;
    ~Embree() {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }
};

EmbreeScene::EmbreeScene(const Scene& scene, const glm::dvec3& origin_m)
    : scene_(scene), origin_m_(origin_m), embree_(std::make_unique<Embree>()) {
    meet_tbb_first();
    embree_->device = new_device();
    if (rtcGetDeviceProperty(embree_->device, RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) == 0)
        throw DeviceError("this Embree was built without ray masks (EMBREE_RAY_MASK), which maps need");
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST); // no leaks along the edges between triangles
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const Mesh& mesh = scene.meshes[m];
        const std::size_t count = triangle_count(mesh);
        add_facets(mesh);
        if (count == 0)
            continue;
        const RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
        auto* indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), count));
        embree_->check("memory for a mesh");
        for (const Vertex& vertex : mesh.vertices) {
            const glm::vec3 p(mesh.origin_m - origin_m + glm::dvec3(vertex.position_m));
            vertices = std::copy_n(&p.x, 3, vertices);
        }
        for (const Batch& batch : mesh.batches)
            indices = std::copy_n(mesh.indices.begin() + batch.first, batch.count / 3 * 3, indices);
        rtcSetGeometryMask(geometry, mesh.measured_alone             ? measured_alone_mask
                                     : !mesh.casts                   ? no_caster_mask
                                     : stands_on_ground(scene, mesh) ? stands_mask
                                                                     : ground_mask);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(embree_->scene, geometry, static_cast<unsigned>(m));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(embree_->scene);
    embree_->check("building the scene");
}

EmbreeScene::~EmbreeScene() = default;

glm::dvec3 EmbreeScene::raised(const SurfaceHit& hit) {
    const glm::dvec3 extent = glm::abs(hit.point_m);
    return hit.point_m + hit.facet_normal * (raise_share * std::max({extent.x, extent.y, extent.z, min_extent_m}));
}

void EmbreeScene::add_facets(const Mesh& mesh) {
    first_facet_.push_back(facets_.size());
    for (const Batch& batch : mesh.batches)
        for (std::uint32_t k = batch.first; k + 2 < batch.first + batch.count; k += 3) {
            const Vertex &a = mesh.vertices[mesh.indices[k]], &b = mesh.vertices[mesh.indices[k + 1]],
                         &c = mesh.vertices[mesh.indices[k + 2]];
            Facet facet;
            facet.corner_m = mesh.origin_m - origin_m_ + glm::dvec3(a.position_m);
            facet.ab_m = glm::dvec3(b.position_m) - glm::dvec3(a.position_m);
            facet.ac_m = glm::dvec3(c.position_m) - glm::dvec3(a.position_m);
            facet.normal = glm::normalize(glm::cross(facet.ab_m, facet.ac_m));
            if (glm::dot(facet.normal, glm::dvec3(a.normal) + glm::dvec3(b.normal) + glm::dvec3(c.normal)) < 0.0)
                facet.normal = -facet.normal;
            facet.first = k;
            facet.material = batch.material;
            facets_.push_back(facet);
        }
}

SurfaceHit EmbreeScene::hit_on(const Ray& ray, std::uint32_t mesh_index, std::uint32_t triangle) const {
    const Facet& facet = facets_[first_facet_[mesh_index] + triangle];
    const Mesh& mesh = scene_.meshes[mesh_index];
    const std::uint32_t* const index = &mesh.indices[facet.first];
    const Vertex &a = mesh.vertices[index[0]], &b = mesh.vertices[index[1]], &c = mesh.vertices[index[2]];
    // Moeller and Trumbore 1997, without the test for inside, which Embree has made.
    const glm::dvec3 p = glm::cross(ray.direction, facet.ac_m), s = ray.origin_m - facet.corner_m, q = glm::cross(s, facet.ab_m);
    const double inverse = 1.0 / glm::dot(facet.ab_m, p), u = glm::dot(s, p) * inverse, v = glm::dot(ray.direction, q) * inverse,
                 w = 1.0 - u - v;
    SurfaceHit hit;
    hit.distance_m = glm::dot(facet.ac_m, q) * inverse;
    hit.mesh = mesh_index;
    hit.material = facet.material;
    hit.triangle = triangle;
    hit.point_m = ray.origin_m + ray.direction * hit.distance_m;
    hit.normal = glm::normalize(glm::dvec3(a.normal) * w + glm::dvec3(b.normal) * u + glm::dvec3(c.normal) * v);
    hit.facet_normal = facet.normal;
    hit.uv = glm::dvec2(a.uv) * w + glm::dvec2(b.uv) * u + glm::dvec2(c.uv) * v;
    hit.from_behind = glm::dot(ray.direction, hit.facet_normal) > 0.0;
    return hit;
}

std::optional<SurfaceHit> EmbreeScene::cast(const Ray& ray, bool ground_only) const {
    RTCRayHit found{};
    found.ray = ray_of(ray.origin_m, ray.direction, no_end, ground_only ? measured_mask : all_mask);
    found.hit.geomID = found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(embree_->scene, found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return std::nullopt;
    return hit_on(ray, found.hit.geomID, found.hit.primID);
}

LaneMask EmbreeScene::cast(const std::array<Ray, packet_size>& rays, LaneMask lanes, bool ground_only,
                           std::array<SurfaceHit, packet_size>& hits) const {
    alignas(64) RTCRayHit16 found{}; // idle lanes, too, must hold finite rays
    alignas(64) std::array<int, packet_size> valid{};
    for (const std::size_t i : lanes_of(lanes)) {
        valid[i] = -1;
        set_lane(found.ray, i, ray_of(rays[i].origin_m, rays[i].direction, no_end, ground_only ? measured_mask : all_mask));
        found.hit.geomID[i] = found.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(embree_->scene, valid.data(), found);
    LaneMask hit_lanes = 0;
    for (const std::size_t i : lanes_of(lanes))
        if (found.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) {
            hits[i] = hit_on(rays[i], found.hit.geomID[i], found.hit.primID[i]);
            hit_lanes |= 1U << i;
        }
    return hit_lanes;
}

bool EmbreeScene::visible(const SurfaceHit& from, const glm::dvec3& to_m) const {
    return glm::dot(to_m - from.point_m, from.facet_normal) > 0.0 && visible(raised(from), to_m);
}

bool EmbreeScene::visible(const glm::dvec3& from_m, const glm::dvec3& to_m) const {
    RTCRay ray = ray_of(from_m, to_m - from_m, segment_end, casters_mask);
    occlude(embree_->scene, ray);
    return ray.tfar >= 0.0F; // Embree makes it negative where something was met
}

LaneMask EmbreeScene::visible(const std::array<glm::dvec3, packet_size>& from_m, const std::array<glm::dvec3, packet_size>& to_m,
                              LaneMask lanes) const {
    alignas(64) RTCRay16 ray{};
    alignas(64) std::array<int, packet_size> valid{};
    for (const std::size_t i : lanes_of(lanes)) {
        valid[i] = -1;
        set_lane(ray, i, ray_of(from_m[i], to_m[i] - from_m[i], segment_end, casters_mask));
    }
    occlude(embree_->scene, valid.data(), ray);
    LaneMask seen = 0;
    for (const std::size_t i : lanes_of(lanes))
        if (ray.tfar[i] >= 0.0F)
            seen |= 1U << i;
    return seen;
}

} // namespace fernlicht::reference
