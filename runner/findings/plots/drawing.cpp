#include "runner/findings/plots/drawing.h"

namespace fernlicht::plots {

double text_width(const std::string& text, double size_px) {
    double em = 0.0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xc0u) == 0x80u)
            continue; // inside a UTF-8 sequence
        em += c == ' ' || c == '.' || c == ',' || c == 'i' || c == 'l' ? 0.33 : byte >= 'A' && byte <= 'Z' ? 0.7 : 0.6;
    }
    return em * size_px;
}

} // namespace fernlicht::plots
