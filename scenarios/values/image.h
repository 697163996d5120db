// A picture in memory: rows from the top, tightly packed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace fernlicht {

/// width x height pixels of T, origin top left. T is a plain value: float, glm::vec3, std::uint32_t ...
template <class T> class Image {
  public:
    Image() = default;
    Image(int width, int height, T fill = T{}) : width_(width), height_(height), pixels_(checked_size(width, height), fill) {}

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return pixels_.empty(); }
    std::size_t size() const { return pixels_.size(); }

    T& at(int x, int y) { return pixels_[index(x, y)]; }
    const T& at(int x, int y) const { return pixels_[index(x, y)]; }
    T* data() { return pixels_.data(); }
    const T* data() const { return pixels_.data(); }
    std::vector<T>& pixels() { return pixels_; }
    const std::vector<T>& pixels() const { return pixels_; }

    bool operator==(const Image&) const = default;

  private:
    static std::size_t checked_size(int width, int height) {
        if (width < 0 || height < 0)
            throw std::invalid_argument("Image: negative size");
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<T> pixels_;
};

/// The picture of what `of` makes of each pixel.
template <class T, class Of> auto mapped(const Image<T>& picture, Of of) {
    Image<std::decay_t<std::invoke_result_t<Of, const T&>>> out(picture.width(), picture.height());
    std::ranges::transform(picture.pixels(), out.pixels().begin(), of);
    return out;
}

/// What lies within the picture from a pixel on.
template <class T> Image<T> part_of(const Image<T>& picture, int left, int top, int width, int height) {
    Image<T> out(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            out.at(x, y) = picture.at(left + x, top + y);
    return out;
}

} // namespace fernlicht
