// Draws scenes at night: (Moment, View) -> Frame. All GL state lives here.
// The device has no room for a shadow method's maps: other methods may still be drawn.
// Before a run draws anything: does this driver compute light rightly?
#pragma once

#include "renderer/device.h"
#include "renderer/technique.h"
#include "scenarios/drives/play/frame.h"
#include "scenarios/drives/shadow_settings.h"
#include "scenarios/packs/level.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/scene.h"

#include <glm/mat3x3.hpp>
#include <optional>

namespace fernlicht {

/// plain: the pixels are fetched at once. overlapped: they travel while the GPU and the caller go on.
enum class ReadBack { plain, overlapped };

/// Where `photometric` computes light. shader: in the fragment shader. cpu: GL draws what is visible, the CPU lights each pixel once
/// (light_pass/). automatic: as the device's class has it.
enum class LightPass { automatic, shader, cpu };
inline constexpr const char* light_pass_names = "auto, shader or cpu";
/// Throws InputError naming --light-pass.
LightPass light_pass_named(std::string_view name);
/// "auto", "shader", "cpu"
std::string_view light_pass_name(LightPass pass);
/// What automatic stands for; others are what they are.
LightPass light_pass_for(const DeviceInfo& device, LightPass wish);

struct RendererSettings {
    std::string technique = "photometric";
    ToneMapper tone_mapper;
    std::optional<glm::dmat3> white; ///< of an eye that is adapted to another light, for colours shown (light_adaptation); `ours` alone
    std::optional<BeamTexels> beams; ///< how fine beam textures are; nullopt: as fine as the technique takes them, in float
    ShadowSettings shadows;
    double target_height_m = 0.25;
    bool sources = true; ///< faces of lamps and surfaces that shine by themselves are seen; false: their light alone
    bool traffic_levels =
        true; ///< lamps of others are drawn as coarsely as their light allows (docs/traffic.md); false: each with its beam
    bool traffic_shadows =
        true; ///< lamps of others cast shadows where `shadows` has any method; false: their light goes through everything
    std::shared_ptr<const View>
        shadow_eye; ///< for measuring: maps that are fitted to a view are fitted to this one of the same moment,
                    ///< whatever view is drawn; beyond what it sees they may hold no shadow. nullptr: the view drawn
    ReadBack read_back = ReadBack::plain;
    bool profile = false;   ///< finish after each pass and time it; slower, so never together with frame times
    bool gpu_clock = false; ///< time passes by GL_TIME_ELAPSED; only where check_timer() has found it right
    LightPass light_pass = LightPass::automatic;
    packs::Level light_level = packs::widest_level(); ///< of the CPU's light; all levels give the same bytes
    int fog_samples = 32; ///< along a ray and for each lamp, where there is fog (docs/daylight.md: error and run time)
};

/// What lighting a picture of `photometric` takes on the CPU.
struct LightWork {
    long long pixels = 0; ///< that show a surface
    long long bytes = 0;  ///< read of what is visible, and written as results, of all pixels
    /// That the pixels ask for, each by itself, as the text of the light has it: additions, multiplications, comparisons and the like;
    /// divisions and square roots; look-ups of two neighbours in a beam or a shadow map.
    long long operations = 0, divisions = 0, look_ups = 0;
    long long beam_texels = 0; ///< of the largest beam
    double cpu_s = 0.0;        ///< CPU time of all threads without GL's part, the least of five times

    bool operator==(const LightWork&) const = default;
};

/// What drawing took, counted.
struct Work {
    int passes = 0;      ///< times geometry was drawn: shadow maps and views
    int draws = 0;       ///< pieces drawn, over all passes
    int calls = 0;       ///< draw calls, each of one shader variant
    int samplers = 0;    ///< most textures that one variant reads
    int shadow_maps = 0; ///< in use
    int lamps = 0;       ///< computed
    int features = 0;    ///< compiled into the variants used, summed: lamps, their shadows, sky, retroreflection, emission, textures
    std::uint64_t triangles = 0, fragments = 0; ///< over all passes; fragments: those shaded, where count() asked for them
    std::uint64_t texture_bytes = 0;            ///< beams, shadow and light maps, surface textures
    /// Lamps of others on pieces in view, by how they are drawn, and their faces seen.
    int traffic_full = 0, traffic_merged = 0, traffic_by_vertex = 0, traffic_point = 0, traffic_faces = 0;
    int shadow_maps_drawn = 0;           ///< of shadow_maps, those that did not stand already
    std::optional<LightWork> light = {}; ///< where count() was asked for it, and the CPU lit the picture

    bool operator==(const Work&) const = default;
};

/// Something a technique can do that a moment did not need.
struct PrunedFeature {
    std::string what, why; ///< "shadow maps", "nothing stands in a beam"

    bool operator==(const PrunedFeature&) const = default;
};

class Renderer {
  public:
    /// Uploads the scene. Device and scene must outlive the renderer. Throws DeviceError; InputError for an unknown technique.
    Renderer(Device& device, const Scene& scene, const RendererSettings& settings);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    const Technique& technique() const;
    /// What of `outputs` this technique has; the rest comes back empty.
    FrameOutputs available(FrameOutputs outputs) const;

    /// Draws and reads back what is wanted. Maps draw ground surfaces only. At most 8 lamps. Throws DeviceError.
    Frame draw(const Moment& moment, const View& view, const FrameOutputs& outputs) { return submit(moment, view, outputs)(); }
    /// The same in two steps, so that the caller can work meanwhile. Several frames may be on their way.
    Pending submit(const Moment& moment, const View& view, const FrameOutputs& outputs);
    /// Only draws, flushed as for a display: nothing is read back, nothing waited for. finish() waits.
    void render(const Moment& moment, const View& view, const FrameOutputs& outputs);
    void finish();

    /// Compiles all that drawing these moments so can need, wherever things stand in them; `here`: only what they need as they stand.
    /// Nothing compiles afterwards.
    void prepare(const std::vector<Moment>& moments, const View& view, const FrameOutputs& outputs, bool here = false);
    /// Drops the programs that lamps of these moments do not need; they compile anew where they are drawn with again. Where others have
    /// lamps, a lamp set's programs take some hundred MB on llvmpipe.
    void keep_programs_of(const std::vector<Moment>& moments);
    /// Draws once more and counts, fragments too; `light`: also what lighting took, which lights the picture five times more.
    Work count(const Moment& moment, const View& view, const FrameOutputs& outputs, bool light = false);
    /// What the moment drawn last did not need.
    std::vector<PrunedFeature> pruned() const;
    /// Worst error of a lamp's beam as it is drawn with against its table, relative to the peak; nullopt where no beam of one lamp is drawn
    /// with.
    std::optional<double> beam_error(const LampFile& lamp) const;
    int compiled_programs() const;
    /// Of all pictures drawn so far: shadow maps looked up, and those of them that were drawn for it.
    struct ShadowMapsUsed {
        long long used = 0, drawn = 0;
    };
    ShadowMapsUsed shadow_maps_used() const;
    /// Of all pictures of `photometric` drawn so far.
    struct LightPassesUsed {
        long long shader = 0, cpu = 0;
        std::string why_shader; ///< of the last that the CPU was meant to light
    };
    LightPassesUsed light_passes_used() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Which way of reading back is faster on this device, by trying both on frames of 1024 x 768.
struct ReadBackCheck {
    double plain_s = 0.0, overlapped_s = 0.0; ///< medians, submit to collected, with drawing
    ReadBack faster() const { return overlapped_s < 0.95 * plain_s ? ReadBack::overlapped : ReadBack::plain; }
};
ReadBackCheck check_read_back(Device& device);

/// Says what was asked for and which keys of `shadows` make it smaller. The device goes on drawing.
class ShadowMemoryError : public DeviceError {
  public:
    using DeviceError::DeviceError;
};

/// Draws a wall 25 m before a lamp of 6250 cd and compares every pixel with E = I cos^3(angle) / 625.
/// Throws DeviceError naming the worst pixel when the error is beyond `sanity_bound`. Returns the worst relative error; nothing of it is
/// what a pixel shows within `sanity_place_px` of its centre.
double check_sanity(Device& device);

/// float positions at 25 m are exact to 1e-7; bilinear, division and dot products add a few units in the last place each.
inline constexpr double sanity_bound = 5e-6;
/// GPUs put vertices on a grid of 1/256 pixel (GL_SUBPIXEL_BITS 8) and so show a place up to half of that beside; llvmpipe does not.
inline constexpr double sanity_place_px = 1.0 / 512.0;

} // namespace fernlicht
