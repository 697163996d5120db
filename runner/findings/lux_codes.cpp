#include "runner/findings/lux_codes.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double code_steps = 252.0;
const double code_span = std::log(most_code_lx / least_code_lx);

} // namespace

std::uint8_t lux_code(double lx) {
    if (std::isnan(lx))
        return 0;
    if (lx < least_code_lx)
        return 1;
    return lx > most_code_lx ? std::uint8_t{255}
                             : static_cast<std::uint8_t>(2 + std::lround(code_steps * std::log(lx / least_code_lx) / code_span));
}

double lux_of(std::uint8_t code) {
    return code < 2 ? 0.0 : std::min(most_code_lx, least_code_lx * std::exp(code_span * (code - 2) / code_steps));
}

Image<std::uint8_t> lux_codes(const Image<float>& lx, int most_px) {
    const int step = std::max(1, (std::max(lx.width(), lx.height()) + most_px - 1) / most_px);
    const auto blocks = [step](int side) { return side < 1 ? 0 : std::max(1, side / step); };
    Image<std::uint8_t> codes(blocks(lx.width()), blocks(lx.height()));
    for (int y = 0; y < codes.height(); ++y)
        for (int x = 0; x < codes.width(); ++x)
            codes.at(x, y) = lux_code(
                static_cast<double>(lx.at(std::min(x * step + step / 2, lx.width() - 1), std::min(y * step + step / 2, lx.height() - 1))));
    return codes;
}

} // namespace fernlicht
