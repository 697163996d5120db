// One way to find out which lamps a surface sees: what PhotometricLighting asks of a shadow method.
#pragma once

#include "renderer/gl/device/program.h"
#include "renderer/gl/scene/lighting.h"
#include "renderer/gl/shadows/shadow_casters.h"

#include <memory>

namespace fernlicht::gl {

/// Of a lamp's own shadow texture: 15 is the surfaces'.
inline GLuint shadow_unit(std::size_t lamp) { return lamp < 7 ? 8 + static_cast<GLuint>(lamp) : 16; }

/// Of a lamp's map that targets above surfaces are looked up in.
inline GLuint target_shadow_unit(std::size_t lamp) { return 24 + static_cast<GLuint>(lamp); }

class Shadows {
  public:
    Shadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings)
        : context_(context), scene_(scene), settings_(settings), casters_(scene, settings) {}
    virtual ~Shadows() = default;

    /// Chooses the casters of each lamp.
    virtual void set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
        casters_.set(lamps, beams, ego_m);
    }
    /// Whether anything casts a shadow.
    virtual bool needed() const { return casters_.any(); }
    /// Whether a shadow of any lamp may fall on the piece, or on targets so high above it. Errs towards yes.
    virtual bool reach(const Piece& piece, double raised_m) const { return casters_.reach(piece, raised_m); }
    /// Draws what the look-ups read, before the view's targets are begun, and binds it. Calls shot.clock for each pass.
    virtual void draw(const Shot& shot) = 0;
    /// Makes the driver compile what draw() needs.
    virtual void compile(const Shot& shot) = 0;
    /// What a variant of the view's shaders with SHADOWS is compiled with; `beams`: one a lamp.
    virtual std::vector<Program::Define> defines(const std::vector<const Beam*>& beams) const = 0;
    /// Of such a variant, once it is in use.
    virtual void set_uniforms(const Program&) const {}
    /// What draw() drew, read back for the CPU: one a lamp, until the next draw(). Empty: the method is looked up by shaders alone.
    virtual std::span<const ShadowLookUp> look_ups() { return {}; }
    virtual bool has_look_ups() const { return false; }
    virtual std::size_t texture_bytes() const = 0;
    /// What a report calls it where a moment does not need it: "shadow maps".
    virtual const char* title() const = 0;

  protected:
    Context& context_;
    const SceneBuffers& scene_;
    ShadowSettings settings_;
    ShadowCasters casters_;
};

/// What a method may want to know of the view's drawing.
struct ShadowUse {
    double target_height_m = 0.25;             ///< of targets above surfaces (Wanted::target)
    bool pruned = true;                        ///< only pieces that reach() names are looked up
    std::shared_ptr<const View> eye = nullptr; ///< whose view maps are fitted to (RendererSettings::shadow_eye); nullptr: the one drawn
};
/// nullptr for ShadowMethod::none.
std::unique_ptr<Shadows> make_shadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use);

} // namespace fernlicht::gl
