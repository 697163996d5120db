// A picture in memory: rows from the top, tightly packed.
#pragma once

#include <cstddef>
#include <stdexcept>
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

} // namespace fernlicht
