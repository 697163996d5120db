// What is known about how two pictures differ: numbers, a verdict where one was asked for, and the maps to be drawn. Plain values.
#pragma once

#include "metrics/strictness/strictness.h"
#include "runner/experiments/compare/picture_pair.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

/// A figure of a comparison.
struct ComparedFigure {
    std::string name;  ///< of its files below figures/, without extension
    std::string title; ///< for people
    decltype(Plot::figure) figure;
    std::string place() const { return "figures/" + name; }
    Plot plot() const { return {place(), figure, {}, 2.0}; }
};
JsonMembers compared_figure_members(ComparedFigure& figure);

struct ComparedValue {
    std::string name;                  ///< snake_case: rmse, psnr_db, flip_mean
    std::string unit;                  ///< "" for none
    std::optional<double> value;       ///< none: not measured
    std::string why_not = {};          ///< where there is none
    std::optional<int> x = {}, y = {}; ///< the pixel that it was found at
};

/// One quantity: the display colours, or one channel of a linear picture.
struct LayerComparison {
    std::string name, unit; ///< "display", "level"; "illuminance.lx", "lx"
    std::vector<ComparedValue> values = {};
    std::optional<StrictnessResult> strictness = {};
    ErrorHistogram histogram = {};
    Image<float> difference = {}; ///< tested - reference, signed; of a display picture that of the channel that differs most
    Image<float> flip = {};       ///< empty where FLIP does not apply
    Image<float> colours = {};    ///< CIEDE2000; display pictures alone
};

/// The layer's figure of this name; nullptr: it has none.
const ComparedValue* find_in(const LayerComparison& layer, const std::string& name);
/// Its value; nullopt where it was not measured.
std::optional<double> value_in(const LayerComparison& layer, const std::string& name);

/// What the steps of a comparison took, each since the one before; a step that comes again adds up.
class StepTimes {
  public:
    void step(const char* name);
    std::string text() const; ///< "SSIM 21 ms, FLIP 16 ms"

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    std::vector<std::pair<std::string, double>> ms_;
};

struct PictureComparison {
    double pixels_per_degree = 0.0;
    std::string strictness_name; ///< "" for none
    std::vector<LayerComparison> layers;
    bool passed() const; ///< true where no strictness was asked for
};

/// Two pictures, how they differ, and the names of the pictures that were drawn of it.
struct PicturesFound : Findings {
    PicturePair pair;
    PictureComparison comparison;
    std::vector<std::string> pictures;
};

Document document(const PicturesFound& found);
JsonMembers pictures_members(PicturesFound& found); ///< of compare.json
/// The part of it that the frames of runs have too. `place`: of this part in the schema, "#/properties/layers".
JsonPart layers_part(PictureComparison& comparison, const std::string& place);

/// A sentence a demand of the strictness that was not kept: channel, demand, found, limit, margin, and the pixel that is farthest off.
std::vector<std::string> strictness_failures(const PictureComparison& comparison);

/// Why FLIP is not measured at these pixels per degree, as "0.73 pixels per degree, and FLIP is taken at 1 to 1000"; "" where it is.
std::string why_no_flip_at(double pixels_per_degree);

/// Display pictures: levels, PSNR with peak 255, SSIM and MS-SSIM of luma (range 255), CIEDE2000, FLIP. Linear: in the unit, PSNR with the
/// reference's largest value as peak, SSIM and MS-SSIM over four decades of light (image_difference.h), and, of luminance, FLIP for high
/// dynamic range. What a picture cannot have (MS-SSIM of a small one, PSNR of two alike) is not measured, with the reason. Throws
/// InputError where a mask does not fit. Linear pictures that nobody looks at (maps) have 0 pixels per degree and no FLIP; where FLIP is
/// not taken at the pixels per degree of others, it is not measured.
PictureComparison compare_pictures(const PicturePair& pair, double pixels_per_degree, const StrictnessClass* strictness,
                                   StepTimes* times = nullptr);

/// Draws what shows the difference, for a folder of its own; the names of the files there.
std::vector<std::string> draw_difference(const PictureComparison& comparison, const PicturePair& pair, const TakePlot& take);

} // namespace fernlicht
