#include "metrics/fit/scaled_svd.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

namespace fernlicht {
namespace {

/// Smaller singular values against the largest are rounding.
constexpr double svd_rounding = 1e-13;

} // namespace

ScaledSvd::ScaledSvd(const Matrix& jacobian) : scale_(jacobian.columns), u_(jacobian.rows, jacobian.columns) {
    const std::size_t columns = jacobian.columns;
    for (std::size_t k = 0; k < columns; ++k) {
        double squares = 0.0;
        for (std::size_t i = 0; i < jacobian.rows; ++i)
            squares += jacobian.at(i, k) * jacobian.at(i, k);
        scale_[k] = std::sqrt(squares);
    }
    const int rows = static_cast<int>(std::max(jacobian.rows, columns)); // rows of 0 below change nothing
    cv::Mat scaled = cv::Mat::zeros(rows, static_cast<int>(columns), CV_64F), w, u, vt;
    for (std::size_t i = 0; i < jacobian.rows; ++i)
        for (std::size_t k = 0; k < columns; ++k)
            scaled.at<double>(static_cast<int>(i), static_cast<int>(k)) = scale_[k] > 0.0 ? jacobian.at(i, k) / scale_[k] : 0.0;
    cv::SVD::compute(scaled, w, u, vt);
    v_ = Matrix(columns, columns);
    for (std::size_t j = 0; j < columns; ++j) {
        singular_.push_back(w.at<double>(static_cast<int>(j)));
        for (std::size_t k = 0; k < columns; ++k)
            v_.at(k, j) = vt.at<double>(static_cast<int>(j), static_cast<int>(k));
        for (std::size_t i = 0; i < jacobian.rows; ++i)
            u_.at(i, j) = u.at<double>(static_cast<int>(i), static_cast<int>(j));
    }
    for (double& s : singular_)
        s = s > svd_rounding * singular_.front() ? s : 0.0;
}

std::vector<double> ScaledSvd::step(const std::vector<double>& residuals, double damping) const {
    std::vector<double> x(scale_.size(), 0.0);
    for (std::size_t j = 0; j < singular_.size(); ++j) {
        if (singular_[j] == 0.0)
            continue;
        double along = 0.0;
        for (std::size_t i = 0; i < residuals.size(); ++i)
            along += u_.at(i, j) * residuals[i];
        const double share = -along * singular_[j] / (singular_[j] * singular_[j] + damping);
        for (std::size_t k = 0; k < x.size(); ++k)
            x[k] += v_.at(k, j) * share;
    }
    for (std::size_t k = 0; k < x.size(); ++k)
        x[k] = scale_[k] > 0.0 ? x[k] / scale_[k] : 0.0;
    return x;
}

double ScaledSvd::decrement(const std::vector<double>& residuals) const {
    double squares = 0.0;
    for (std::size_t j = 0; j < singular_.size(); ++j) {
        double along = 0.0;
        for (std::size_t i = 0; singular_[j] > 0.0 && i < residuals.size(); ++i)
            along += u_.at(i, j) * residuals[i];
        squares += along * along;
    }
    return squares;
}

Matrix ScaledSvd::covariance() const {
    Matrix covariance(scale_.size(), scale_.size());
    for (std::size_t a = 0; a < scale_.size(); ++a)
        for (std::size_t b = 0; b < scale_.size(); ++b) {
            double sum = 0.0;
            for (std::size_t j = 0; j < singular_.size(); ++j)
                sum += v_.at(a, j) * v_.at(b, j) / (singular_[j] * singular_[j]);
            covariance.at(a, b) = condition() < std::numeric_limits<double>::infinity() ? sum / (scale_[a] * scale_[b])
                                                                                        : std::numeric_limits<double>::infinity();
        }
    return covariance;
}

std::vector<double> ScaledSvd::leverage() const {
    std::vector<double> leverage(u_.rows, 0.0);
    for (std::size_t i = 0; i < u_.rows; ++i)
        for (std::size_t j = 0; j < singular_.size(); ++j)
            leverage[i] += singular_[j] > 0.0 ? u_.at(i, j) * u_.at(i, j) : 0.0;
    return leverage;
}

double ScaledSvd::condition() const {
    return singular_.back() > 0.0 ? singular_.front() / singular_.back() : std::numeric_limits<double>::infinity();
}

std::vector<double> ScaledSvd::weakest() const {
    std::vector<double> weakest;
    for (std::size_t k = 0; k < v_.rows; ++k)
        weakest.push_back(v_.at(k, v_.columns - 1));
    return weakest;
}

} // namespace fernlicht
