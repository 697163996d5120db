// Linear least squares by singular values: steps, covariance, leverage, and which unknowns stand in for one another.
#pragma once

#include <cstddef>
#include <vector>

namespace fernlicht {

/// Row by row.
struct Matrix {
    std::size_t rows = 0, columns = 0;
    std::vector<double> values;

    Matrix() = default;
    Matrix(std::size_t r, std::size_t c) : rows(r), columns(c), values(r * c, 0.0) {}
    double& at(std::size_t row, std::size_t column) { return values[row * columns + column]; }
    double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
};

/// From this condition index on, unknowns are collinear to harm (Belsley, Kuh and Welsch 1980, Regression Diagnostics, section 3.2: 30
/// to 100 "moderate to strong").
inline constexpr double collinear_from = 30.0;

/// Of a Jacobian whose columns were brought to length 1 first, so that no unit matters. At least one row and one column.
class ScaledSvd {
  public:
    explicit ScaledSvd(const Matrix& jacobian);

    /// x that minimises |J x + r|^2 + damping |D x|^2, D the lengths of the columns (Levenberg 1944, Marquardt 1963). Directions without
    /// any weight stay 0.
    std::vector<double> step(const std::vector<double>& residuals, double damping) const;
    /// |J x|^2 of the undamped step: in multiples of its own standard error, squared, how far the minimum is.
    double decrement(const std::vector<double>& residuals) const;
    /// (J^T J)^-1. Infinite where the condition is.
    Matrix covariance() const;
    /// Diagonal of the projection onto J's columns, 0..1 a row: how far a point decides its own fit.
    std::vector<double> leverage() const;
    /// Largest over smallest singular value; infinite where an unknown or a combination changes nothing.
    double condition() const;
    /// The right singular vector of the smallest singular value: the combination known least, in the scaled unknowns.
    std::vector<double> weakest() const;

  private:
    std::vector<double> scale_, singular_; ///< lengths of the columns; descending
    Matrix u_, v_;                         ///< columns are singular vectors
};

} // namespace fernlicht
