// How strictly two pictures must agree: a tree of leaves, each a statement about pixels, joined by `all` and `any`. A class of strictness
// is such a tree with a name. What comes back tells how near to its threshold everything came, not only whether it passed.
// How many pixels differ by how much: bins of a third of a decade, and apart from them those that do not differ at all.
// The classes of strictness that have a name, from the strictest on.
// Classes of strictness by name, or from a file of the user's.
#pragma once

#include "scenarios/values/image.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// A pixel keeps it with a difference |tested - reference| of at most absolute + relative * |reference|, in the picture's unit (levels
/// 0..255, lx, cd/m2). Of several channels all must.
struct PixelBound {
    double absolute = 0.0, relative = 0.0;
};

/// Pixels that are not 0 are looked at.
using PixelMask = Image<std::uint8_t>;

struct StrictnessNode {
    enum class Kind {
        every,      ///< every pixel keeps `bound`
        percentage, ///< at most `percent` of the pixels do not keep `bound`
        hard_limit, ///< no pixel of the picture breaks `bound`, under the mask or not, shifted or not
        mean_flip,  ///< the picture's mean FLIP is at most `figure`; of a quantity that has no FLIP it asks nothing
        ssim,       ///< the picture's SSIM is at least `figure`
        all,        ///< every child passes
        any,        ///< at least one child passes
    };
    Kind kind = Kind::all;
    PixelBound bound = {};
    double percent = 0.0; ///< 0..100
    double figure = 0.0;  ///< 0..1, of mean_flip and ssim
    /// A pixel is compared with the nearest value among the reference's 3 x 3 pixels around its place: what moved by one pixel has not
    /// changed.
    bool one_pixel_shift = false;
    std::optional<PixelMask> mask = {}; ///< none: all pixels
    std::string mask_name = {};
    std::vector<StrictnessNode> children = {};
};

struct StrictnessResult {
    std::string statement; ///< "at most 0.1 % of the pixels differ by more than 1 level"
    bool passed = false;
    // Of a leaf. What its statement limits: the difference of the pixel that is farthest from keeping its bound, a percentage, the mean
    // FLIP, or what SSIM lacks to 1.
    double found = 0.0;
    double threshold = 0.0; ///< it passes up to here, included
    std::string unit;
    std::size_t pixels = 0;       ///< looked at
    int worst_x = 0, worst_y = 0; ///< the pixel that is farthest from keeping its bound
    /// (threshold - found) / threshold: 1 no difference, 0 just passed, below 0 failed. Of `all` the least of the children, of `any` the
    /// largest. With a threshold of 0 it is 0 where that passes, and none where it does not: nothing is a share of it.
    std::optional<double> margin;
    std::vector<StrictnessResult> children; ///< of all and any
};

/// What whole pictures are judged by.
struct WholeFigures {
    std::optional<double> mean_flip, ssim;
    std::string no_flip, no_ssim; ///< why there is none; no_flip empty where the quantity has no FLIP
};

/// Channels in pairs, one for a linear picture, three for a display picture, all of one size. Throws std::invalid_argument for sizes that
/// differ (masks too), empty pictures, values that are not finite, bounds below 0, a percentage outside 0..100, a figure outside 0..1, an
/// all or any without children, and a mask that looks at no pixel.
StrictnessResult judge_strictness(const StrictnessNode& tree, const std::vector<Image<float>>& tested,
                                  const std::vector<Image<float>>& reference, const std::string& unit, const WholeFigures& whole = {});

/// Whether a tree has a leaf of this kind.
bool has_leaf(const StrictnessNode& tree, StrictnessNode::Kind kind);

struct ErrorHistogram {
    /// Bin i holds differences from edge(i) up to below edge(i + 1); what is smaller or larger than all of them is in the end bins.
    static constexpr double lowest = 1e-6;
    static constexpr int bins_per_decade = 3, bins = 36;
    static double edge(int i); ///< lowest * 10^(i / 3); 0 <= i <= bins

    std::size_t equal = 0;           ///< pixels that do not differ
    std::vector<std::size_t> counts; ///< `bins` of them
    std::size_t pixels() const;      ///< all together
};

/// Of |tested - reference|; of several channels that of the worst. Throws std::invalid_argument for sizes or numbers of channels that
/// differ, and values that are not finite.
ErrorHistogram error_histogram(const std::vector<Image<float>>& tested, const std::vector<Image<float>>& reference);

struct StrictnessClass {
    std::string name;
    std::string meaning;    ///< one sentence: who needs it, and why its numbers are what they are
    StrictnessNode display; ///< for 8-bit pictures, in levels
    StrictnessNode linear;  ///< for lx, cd/m2, m
};

/// identical, same-driver, same-light, same-picture.
const std::vector<StrictnessClass>& strictness_classes();

/// The class of this name; else the YAML file of this name (docs/comparing.md has its keys), whose masks are read too. Throws InputError:
/// neither a class nor a file; unknown keys, numbers out of range, with file and line; masks that cannot be read.
StrictnessClass read_strictness(const std::string& name_or_file);

} // namespace fernlicht
