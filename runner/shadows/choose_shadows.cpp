#include "runner/shadows/choose_shadows.h"

#include "runner/shadows/shadow_truth.h"
#include "scenarios/drives/advance.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_compared = 8;
constexpr int scan_width_px = 16, scan_height_px = 12, scan_texels = 16;

/// Of one lamp set.
struct ShadowedMoments {
    const Variant* variant = nullptr;
    std::vector<Moment> moments; ///< at most most_compared, evenly spread over all that have a caster in a beam
    int ticks = 0, shadowed = 0;
};

template <class One> std::vector<One> evenly_spread(const std::vector<One>& all, std::size_t most) {
    if (all.size() <= most)
        return all;
    std::vector<One> some;
    for (std::size_t i = 0; i < most; ++i)
        some.push_back(all[i * (all.size() - 1) / (most - 1)]);
    return some;
}

/// Whether the moment drawn last has shadows of the own lamps or of others'; those of sun and moon are looked for where these shine.
bool is_shadowed(const Moment& moment, const Renderer& renderer) {
    const std::vector<LeftOut> left_out = renderer.left_out();
    const auto needed = [&](std::string_view what) { return std::ranges::find(left_out, what, &LeftOut::what) == left_out.end(); };
    return needed("shadow maps") || (!moment.other_lamps.empty() && needed("shadow maps of lamps of others")) ||
           moment.daylight.direct() != nullptr;
}

/// Maps are drawn where anything casts: the smallest ones of the smallest picture tell.
ShadowedMoments shadowed_moments(const Stage& stage, Device& device, const View& view, RendererSettings settings, const Variant& variant) {
    settings.shadows = {};
    settings.shadows.width = settings.shadows.height = scan_texels;
    Renderer renderer(device, stage.scene, settings);
    std::vector<int> all(static_cast<std::size_t>(tick_count(stage.drive)));
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = static_cast<int>(i);
    const View small = at_size(view, scan_width_px, scan_height_px);
    std::vector<int> shadowed;
    for (const Moment& moment : moments_at(all, stage, variant)) {
        renderer.render(moment, small, {.illuminance = true});
        if (is_shadowed(moment, renderer))
            shadowed.push_back(moment.tick);
    }
    renderer.finish();
    return {&variant, moments_at(evenly_spread(shadowed, most_compared), stage, variant), static_cast<int>(all.size()),
            static_cast<int>(shadowed.size())};
}

/// The lamp sets' moments with the rays that tell the truth about them.
class Trial {
  public:
    Trial(const Stage& stage, Device& device, const View& view, const RendererSettings& settings, std::vector<ShadowedMoments> sets)
        : stage_(stage), device_(device), settings_(settings), rays_(stage.scene),
          unshadowed_(device, stage.scene, without_shadows(settings)), sets_(std::move(sets)) {
        const View small = at_size(view, shadow_error_width_px, std::max(1, view.height_px * shadow_error_width_px / view.width_px));
        for (const ShadowedMoments& set : sets_)
            truths_.emplace_back(rays_, unshadowed_, set.moments, small);
    }

    TriedShadows tried(ShadowMethod method) {
        TriedShadows found{.method = method, .error = {}, .worst_s = 0.0, .worst_set = {}, .refused = {}};
        RendererSettings own = settings_;
        own.shadows.method = method;
        try {
            Renderer renderer(device_, stage_.scene, own);
            for (std::size_t s = 0; s < sets_.size(); ++s)
                for (std::size_t m = 0; m < sets_[s].moments.size(); ++m)
                    if (const double share = shadow_area(truths_[s].images(renderer, m)).wrong_share();
                        !found.error || share > *found.error) {
                        found.error = share;
                        found.worst_s = sets_[s].moments[m].time_s;
                        found.worst_set = sets_[s].variant->name;
                    }
        } catch (const InputError& refusal) {
            found.error.reset();
            found.refused = refusal.what();
        }
        return found;
    }

  private:
    const Stage& stage_;
    Device& device_;
    RendererSettings settings_;
    Reference rays_;
    Renderer unshadowed_;
    std::vector<ShadowedMoments> sets_;
    std::vector<ShadowTruth> truths_;
};

std::string percent_text(double share) { return fmt::format("{:.{}g} %", 100.0 * share, share < 0.995 ? 2 : 3); }

void try_methods(ShadowChoice& choice, Trial& trial) {
    for (const ShadowMethod method : shadow_methods_by_cost()) {
        const TriedShadows& tried = choice.tried.emplace_back(trial.tried(method));
        if (!tried.error || *tried.error > choice.bound)
            continue;
        choice.chosen = method;
        choice.why = fmt::format("the cheapest whose error stays within {}: {} in the worst of {} moments", percent_text(choice.bound),
                                 percent_text(*tried.error), choice.compared);
        return;
    }
    const auto least = std::ranges::min_element(choice.tried, {}, [](const TriedShadows& t) { return t.error.value_or(2.0); });
    choice.chosen = least->method;
    choice.why = fmt::format("no method stays within {}; {} errs least: {} in the worst of {} moments", percent_text(choice.bound),
                             name(choice.chosen), percent_text(least->error.value_or(1.0)), choice.compared);
}

} // namespace

std::vector<ShadowMethod> shadow_methods_by_cost() {
    using enum ShadowMethod;
    return {none, under_car, planar, one_map, map, light_space_map, perspective_map, volumes, soft_map};
}

std::optional<ShadowChoice> choose_shadows(Stage& stage, Device& device, const RendererSettings& settings) {
    Drive& drive = stage.drive;
    if (drive.shadows.method != ShadowMethod::automatic)
        return std::nullopt;
    const Technique& technique = technique_named(drive.technique);
    if (technique.kind != TechniqueKind::ours || technique.name == "photometric-naive") {
        drive.shadows.method = ShadowMethod::map; // all that these know, or more
        return std::nullopt;
    }
    const View* const view = driver_view(drive);
    if (view == nullptr)
        throw InputError({drive.file, 0, 0, "shadows"}, "'auto' in a drive without a driver's view",
                         "a view that is no map, or a method by its name");
    ShadowChoice choice;
    choice.bound = drive.shadows.error_bound;
    RendererSettings light = settings;
    light.shadows = drive.shadows;
    light.profile = false;
    std::vector<ShadowedMoments> sets;
    for (const Variant& variant : drive.variants) {
        ShadowedMoments set = shadowed_moments(stage, device, *view, light, variant);
        choice.ticks += set.ticks;
        choice.ticks_shadowed += set.shadowed;
        choice.compared += static_cast<int>(set.moments.size());
        if (!set.moments.empty())
            sets.push_back(std::move(set));
    }
    if (sets.empty()) {
        choice.why = fmt::format("nothing stands in a beam in any of {} moments", choice.ticks);
    } else {
        Trial trial(stage, device, *view, light, std::move(sets));
        try_methods(choice, trial);
    }
    drive.shadows.method = choice.chosen;
    drive.notes.push_back(fmt::format("shadows: auto chose {}: {}", name(choice.chosen), choice.why));
    return choice;
}

void refuse_open_shadows(const Drive& drive) {
    if (drive.shadows.method == ShadowMethod::automatic)
        throw InputError({drive.file, 0, 0, "shadows"}, "'auto', which is chosen on the drive's pictures, by `fernlicht run` for one",
                         "a method by its name, as the resolved drive of a run has it");
}

} // namespace fernlicht
