#include "runner/flight/flight_model.h"

#include "scenarios/models/openflight_records.h"
#include "scenarios/models/triangle_soup.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <osg/ComputeBoundsVisitor>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/Material>
#include <osg/Notify>
#include <osg/Switch>
#include <osg/Texture2D>
#include <osg/TriangleIndexFunctor>
#include <osgDB/FileNameUtils>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgSim/LightPointNode>
#include <osgSim/MultiSwitch>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

namespace fernlicht {
namespace {

std::string lower(std::string text) {
    for (char& c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Whether the word stands in the text with no letters beside it.
bool has_word(const std::string& text, const std::string& word) {
    const auto letter = [&](std::size_t at) { return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0; };
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
        if ((at == 0 || !letter(at - 1)) && !letter(at + word.size()))
            return true;
    return false;
}

struct NamedLamp {
    std::string function; ///< "low", "high", "fog", "tail", "brake", "indicator-front", "indicator-rear", "reverse", "position"
    bool rear = false;
    std::optional<bool> left; ///< nullopt: the name does not say
};

/// nullopt for names that are no lamp's. Case does not matter; left and right are "left", "right", or l, r, lh, rh, lt, rt set apart by
/// anything but letters.
std::optional<NamedLamp> lamp_named(const std::string& given) {
    const std::string name = lower(given);
    const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
    NamedLamp lamp;
    const bool front = has("front") || has_word(name, "f"), light = has("lamp") || has("light") || has("lite");
    if (has("high") && (has("beam") || light))
        lamp.function = "high";
    else if (has("headl") || has("head_l") || has("low_beam") || has("lowbeam") || (has("low") && light))
        lamp.function = "low";
    else if (has("fog") && light)
        std::tie(lamp.function, lamp.rear) = std::pair("fog", has("rear"));
    else if (has("brake") || (has("stop") && light))
        std::tie(lamp.function, lamp.rear) = std::pair("brake", true);
    else if (has("taill") || has("tail_l") || (has("rear") && light))
        std::tie(lamp.function, lamp.rear) = std::pair("tail", true);
    else if (has("indicator") || has("blinker") || (has("turn") && (light || has("sig"))))
        std::tie(lamp.function, lamp.rear) = front ? std::pair("indicator-front", false) : std::pair("indicator-rear", true);
    else if (has("reverse") && light)
        std::tie(lamp.function, lamp.rear) = std::pair("reverse", true);
    else if ((has("parking") || has("position")) && light)
        lamp.function = "position";
    else
        return std::nullopt;
    for (const char* word : {"l", "lh", "lt"})
        if (has("left") || has_word(name, word))
            lamp.left = true;
    for (const char* word : {"r", "rh", "rt"})
        if (has("right") || has_word(name, word))
            lamp.left = false;
    return lamp;
}

void note_once(std::vector<std::string>& notes, std::string note) {
    if (notes.size() < 50 && std::ranges::find(notes, note) == notes.end())
        notes.push_back(std::move(note));
}

/// What OpenSceneGraph says becomes notes.
class Listening : public osg::NotifyHandler {
  public:
    explicit Listening(std::vector<std::string>& notes) : notes_(notes) {}
    void notify(osg::NotifySeverity severity, const char* message) override {
        std::string text = printable(message, 200);
        while (!text.empty() && (text.ends_with("\\n") || text.ends_with(" ")))
            text.resize(text.size() - (text.ends_with(" ") ? 1 : 2));
        if (severity <= osg::WARN && !text.empty())
            note_once(notes_, "OpenSceneGraph: " + text);
    }

  private:
    std::vector<std::string>& notes_;
};

float linear(double srgb) {
    const double c = std::clamp(srgb, 0.0, 1.0);
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

struct Indices {
    std::vector<unsigned> corners;
    void operator()(unsigned a, unsigned b, unsigned c) {
        if (a != b && b != c && a != c)
            corners.insert(corners.end(), {a, b, c});
    }
};

/// What a triangle's colour comes from.
struct Paint {
    const osg::Texture2D* texture = nullptr;
    osg::Vec4 material{1.0F, 1.0F, 1.0F, 1.0F};
    bool has_material = false;
};

class Gathering : public osg::NodeVisitor {
  public:
    Gathering(FlightModel& out, FlightForward forward) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), out_(out), forward_(forward) {}

    void apply(osg::Node& node) override {
        name(node);
        traverse(node);
    }

    void apply(osg::Group& group) override {
        if (const auto* switches = dynamic_cast<const osgSim::MultiSwitch*>(&group)) { // which the visitor does not know by name
            const osgSim::MultiSwitch::ValueList values = switches->getValueList(switches->getActiveSwitchSet());
            for (unsigned i = 0; i < group.getNumChildren(); ++i)
                on_or_off(*group.getChild(i), i >= values.size() || values[i]);
            return;
        }
        name(group);
        // Each level of detail is a node of its own beside the others: those that begin nearest to the eye are the finest.
        float nearest = HUGE_VALF;
        for (unsigned i = 0; i < group.getNumChildren(); ++i)
            if (const auto* lod = dynamic_cast<const osg::LOD*>(group.getChild(i)))
                nearest = std::min(nearest, begins(*lod));
        for (unsigned i = 0; i < group.getNumChildren(); ++i) {
            const auto* lod = dynamic_cast<const osg::LOD*>(group.getChild(i));
            if (!lod || begins(*lod) <= nearest)
                group.getChild(i)->accept(*this);
            else
                note_once(out_.model.notes, "coarser levels of detail are left out");
        }
    }

    void apply(osg::LOD& lod) override {
        name(lod);
        for (unsigned i = 0; i < lod.getNumChildren(); ++i)
            if (lod.getMinRange(i) <= begins(lod))
                lod.getChild(i)->accept(*this);
            else
                note_once(out_.model.notes, "coarser levels of detail are left out");
    }

    void apply(osg::Switch& node) override {
        name(node);
        for (unsigned i = 0; i < node.getNumChildren(); ++i)
            on_or_off(*node.getChild(i), node.getValue(i));
    }

    void apply(osg::Geode& geode) override {
        name(geode);
        for (unsigned i = 0; i < geode.getNumDrawables(); ++i)
            if (const osg::Geometry* geometry = geode.getDrawable(i)->asGeometry())
                add(*geometry, paint_of(*geometry, geode));
    }

    TriangleSoup& soup() { return soup_; }

  private:
    static float begins(const osg::LOD& lod) {
        float nearest = HUGE_VALF;
        for (unsigned i = 0; i < lod.getNumRanges(); ++i)
            nearest = std::min(nearest, lod.getMinRange(i));
        return nearest;
    }

    void on_or_off(osg::Node& child, bool on) {
        if (on)
            child.accept(*this);
        else
            note_once(out_.model.notes, "what a switch has off is left out");
    }

    glm::dvec3 ours(const osg::Vec3d& v) const {
        return forward_ == FlightForward::y ? glm::dvec3(v.y(), -v.x(), v.z()) : glm::dvec3(v.x(), v.y(), v.z());
    }

    osg::Matrixd world() const { return osg::computeLocalToWorld(getNodePath()); }

    /// Lamps by name: at the middle of what the node holds, or at its origin; light points at their own places.
    void name(osg::Node& node) {
        const auto lamp = lamp_named(node.getName());
        if (!lamp)
            return;
        std::vector<osg::Vec3d> places;
        if (const auto* points = dynamic_cast<const osgSim::LightPointNode*>(&node)) {
            for (const osgSim::LightPoint& point : points->getLightPointList())
                places.emplace_back(osg::Vec3d(point._position) * world());
        } else {
            osg::ComputeBoundsVisitor bounds;
            node.accept(bounds);
            // World transforms of the node itself are in its bounds already, those above it are not.
            osg::NodePath above = getNodePath();
            if (!above.empty())
                above.pop_back();
            const osg::Matrixd to_world = osg::computeLocalToWorld(above);
            if (bounds.getBoundingBox().valid())
                places.emplace_back(osg::Vec3d(bounds.getBoundingBox().center()) * to_world);
            else
                places.emplace_back(osg::Vec3d(0, 0, 0) * world());
        }
        for (const osg::Vec3d& place : places) {
            const glm::dvec3 at = ours(place);
            const bool left = lamp->left.value_or(at.y >= 0.0);
            std::string full = fmt::format("lamp.{}.{}", lamp->function,
                                           !lamp->left && std::abs(at.y) < 0.05 ? "centre"
                                           : left                               ? "left"
                                                                                : "right");
            for (int k = 2; std::ranges::any_of(out_.model.mounts, [&](const Mount& m) { return m.name == full; }); ++k)
                full = fmt::format("lamp.{}.{}.{}", lamp->function, left ? "left" : "right", k);
            out_.model.mounts.push_back({full, {at, axes_from_angles(lamp->rear ? pi : 0.0, 0.0, 0.0)}});
        }
    }

    Paint paint_of(const osg::Geometry& geometry, const osg::Geode& geode) const {
        Paint paint;
        const auto take = [&](const osg::StateSet* state) {
            if (!state)
                return;
            if (const auto* texture = dynamic_cast<const osg::Texture2D*>(state->getTextureAttribute(0, osg::StateAttribute::TEXTURE)))
                paint.texture = texture;
            if (const auto* material = dynamic_cast<const osg::Material*>(state->getAttribute(osg::StateAttribute::MATERIAL))) {
                paint.material = material->getDiffuse(osg::Material::FRONT);
                paint.has_material = material->getColorMode() == osg::Material::OFF;
            }
        };
        for (const osg::Node* node : getNodePath())
            take(node->getStateSet());
        take(geode.getStateSet());
        take(geometry.getStateSet());
        return paint;
    }

    void add(const osg::Geometry& geometry, const Paint& paint) {
        const auto* positions = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
        const auto* exact = dynamic_cast<const osg::Vec3dArray*>(geometry.getVertexArray());
        if (!positions && !exact)
            return;
        osg::TriangleIndexFunctor<Indices> triangles;
        geometry.accept(triangles);
        if (triangles.corners.empty()) {
            note_once(out_.model.notes, "points and lines are left out");
            return;
        }
        if (soup_.triangles.size() + triangles.corners.size() / 3 > max_model_triangles)
            throw InputError({}, fmt::format("more than {} triangles", max_model_triangles), "fewer");
        const std::size_t count = positions ? positions->size() : exact->size();
        const auto* normals = dynamic_cast<const osg::Vec3Array*>(geometry.getNormalArray());
        const bool by_vertex = normals && normals->getBinding() == osg::Array::BIND_PER_VERTEX && normals->size() >= count;
        const auto* uvs = dynamic_cast<const osg::Vec2Array*>(geometry.getTexCoordArray(0));
        const osg::Matrixd to_world = world();
        const auto place = [&](unsigned i) { return ours((positions ? osg::Vec3d((*positions)[i]) : (*exact)[i]) * to_world); };
        for (std::size_t k = 0; k + 2 < triangles.corners.size(); k += 3) {
            const unsigned* c = &triangles.corners[k];
            if (c[0] >= count || c[1] >= count || c[2] >= count)
                throw InputError({}, "a triangle with a vertex that is not there", "a whole model");
            const std::array<glm::dvec3, 3> at{place(c[0]), place(c[1]), place(c[2])};
            for (const glm::dvec3& p : at)
                if (!(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= farthest_model_m))
                    throw InputError({}, fmt::format("a vertex at {:.3g}, {:.3g}, {:.3g} m", p.x, p.y, p.z),
                                     fmt::format("coordinates within {:.0f} m", farthest_model_m));
            const std::size_t before = soup_.vertices.size();
            soup_.add(at, material(geometry, paint, c[0]));
            if (soup_.vertices.size() == before)
                continue;
            for (std::size_t i = 0; i < 3; ++i) {
                SoupVertex& vertex = soup_.vertices[before + i];
                if (by_vertex) {
                    const glm::dvec3 n = ours(osg::Matrixd::transform3x3(osg::Vec3d((*normals)[c[i]]), to_world));
                    if (glm::length(n) > 1e-9 && glm::dot(n, vertex.normal) > 0.0)
                        vertex.normal = glm::normalize(n);
                }
                if (uvs && c[i] < uvs->size())
                    vertex.uv = {(*uvs)[c[i]].x(), 1.0F - (*uvs)[c[i]].y()}; // glTF counts from the top
            }
        }
    }

    std::uint32_t material(const osg::Geometry& geometry, const Paint& paint, unsigned vertex) {
        osg::Vec4 colour(1, 1, 1, 1);
        const auto* colours = dynamic_cast<const osg::Vec4Array*>(geometry.getColorArray());
        if (paint.has_material)
            colour = paint.material;
        else if (colours && !colours->empty())
            colour = (*colours)[colours->getBinding() == osg::Array::BIND_PER_VERTEX && vertex < colours->size() ? vertex : 0];
        std::array<long, 4> key{picture(paint.texture)};
        for (unsigned i = 0; i < 3; ++i)
            key[i + 1] = std::lround(63.0 * std::clamp(static_cast<double>(colour[i]), 0.0, 1.0));
        const auto [it, fresh] = materials_.try_emplace(key, static_cast<std::uint32_t>(out_.model.materials.size()));
        if (fresh) {
            Material made;
            made.texture = static_cast<int>(key[0]);
            made.name =
                made.texture >= 0 ? out_.model.textures[static_cast<std::size_t>(made.texture)].name : fmt::format("colour {}", it->second);
            made.albedo = {linear(static_cast<double>(key[1]) / 63.0), linear(static_cast<double>(key[2]) / 63.0),
                           linear(static_cast<double>(key[3]) / 63.0)};
            out_.model.materials.push_back(std::move(made));
        }
        return it->second;
    }

    /// Index of the texture's picture, or -1.
    int picture(const osg::Texture2D* texture) {
        const osg::Image* image = texture ? texture->getImage() : nullptr;
        if (!image)
            return -1;
        const auto known = pictures_.find(image);
        if (known != pictures_.end())
            return known->second;
        std::ostringstream bytes;
        osgDB::ReaderWriter* png = osgDB::Registry::instance()->getReaderWriterForExtension("png");
        if (!png || !png->writeImage(*image, bytes, nullptr).success()) {
            note_once(out_.model.notes, fmt::format("picture {} cannot be written as PNG and is left out",
                                                    printable(osgDB::getSimpleFileName(image->getFileName()))));
            return pictures_[image] = -1;
        }
        out_.model.textures.push_back({printable(osgDB::getStrippedName(image->getFileName())), 1, 1, {}});
        out_.pictures.push_back(bytes.str());
        return pictures_[image] = static_cast<int>(out_.pictures.size()) - 1;
    }

    FlightModel& out_;
    FlightForward forward_;
    TriangleSoup soup_;
    std::map<std::array<long, 4>, std::uint32_t> materials_;
    std::map<const osg::Image*, int> pictures_;
};

} // namespace

FlightModel read_flight(const std::filesystem::path& path, FlightForward forward) {
    FlightModel out;
    out.model.name = printable(path.stem().string());
    FilesRead opened;
    check_openflight(path, read_file(path, opened));
    struct Listened { // to its end, however reading ends
        const osg::ref_ptr<osg::NotifyHandler> usual = new osg::StandardNotifyHandler, listening;
        explicit Listened(std::vector<std::string>& notes) : listening(new Listening(notes)) { osg::setNotifyHandler(listening); }
        ~Listened() { osg::setNotifyHandler(usual); }
    };
    const Listened listened(out.model.notes);
    osg::setNotifyLevel(osg::WARN);
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    options->getDatabasePathList().push_front(path.parent_path().empty() ? "." : path.parent_path().string());
    const osg::ref_ptr<osg::Node> root = osgDB::readRefNodeFile(path.string(), options);
    if (!root)
        throw InputError({path, 0, 0, {}},
                         out.model.notes.empty() ? "OpenSceneGraph cannot read it" : printable(out.model.notes.back(), 300),
                         "an OpenFlight file");
    Gathering walking(out, forward);
    try {
        root->accept(walking);
    } catch (const InputError& error) {
        throw InputError({path, 0, 0, {}}, error.what());
    }
    if (walking.soup().triangles.empty())
        throw InputError({path, 0, 0, {}}, "no triangles", "a model");
    add_meshes(out.model, walking.soup());
    std::ranges::sort(out.model.mounts, {}, &Mount::name);
    return out;
}

} // namespace fernlicht
