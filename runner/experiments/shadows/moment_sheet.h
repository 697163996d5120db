// One moment of a drive with every shadow method, beside the reference: the shadow part of its contact sheets.
#pragma once

#include "runner/experiments/shadows/shadow_result.h"
#include "runner/play/stage.h"

namespace fernlicht {

/// The driver's view, drawn small; errors in the view, no times. A method that refuses the scene has a row that says why. Throws
/// DeviceError. The drive has a perspective view.
ShadowSceneResult shadow_moment(const Stage& stage, const LampSet& lamp_set, const Moment& moment, Device& device,
                                const RendererSettings& settings);

/// The picture drawn without shadows in those of the rays: each pixel's luminance times 1 - degree, so that it differs from a drawn picture
/// by shadows alone (rays see textures unfiltered and edges as steps). `degree`: of the same size, 0..1; below 0 where none counts, there
/// all light stays.
Image<float> shaded_by_rays(const Image<float>& unshadowed_cdm2, const Image<float>& degree);

/// Luminance that one in a hundred of the pixels showing ground exceeds, of all pixels where none shows any; at least 1e-3. `ids`: mesh
/// index + 1 by pixel, 0 for none.
double white_of_ground(const Image<float>& luminance_cdm2, const Image<std::uint32_t>& ids, const Scene& scene);

} // namespace fernlicht
