#include "core/analysis/separability/LinearDiscriminant.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tacto {

LinearDiscriminant::LinearDiscriminant(const std::vector<LabelledPoint>& points, std::size_t classes,
                                       const Eigen::Vector2d& floor)
    : means_(classes, Eigen::Vector2d::Zero()), counts_(classes, 0) {
    for (const auto& point : points) {
        means_[point.label] += point.x;
        ++counts_[point.label];
    }
    std::size_t used = 0;
    for (std::size_t c = 0; c < classes; ++c) {
        if (counts_[c] == 0) continue;
        means_[c] /= static_cast<double>(counts_[c]);
        ++used;
    }
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
    for (const auto& point : points) {
        const Eigen::Vector2d deviation = point.x - means_[point.label];
        covariance += deviation * deviation.transpose();
    }
    if (points.size() > used) covariance /= static_cast<double>(points.size() - used);
    for (int i = 0; i < 2; ++i) covariance(i, i) = std::max(covariance(i, i), floor(i) * floor(i));
    // Perfectly correlated readings would make the matrix singular, so the correlation stays slightly below one.
    constexpr double kLargestCorrelation = 1 - 1e-9;
    const double bound = kLargestCorrelation * std::sqrt(covariance(0, 0) * covariance(1, 1));
    covariance(0, 1) = covariance(1, 0) = std::clamp(covariance(0, 1), -bound, bound);
    precision_ = covariance.inverse();
}

double LinearDiscriminant::norm(const Eigen::Vector2d& difference) const {
    return std::sqrt(std::max(0.0, difference.dot(precision_ * difference)));
}

std::size_t LinearDiscriminant::classify(const Eigen::Vector2d& x) const {
    std::size_t best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < means_.size(); ++c) {
        if (counts_[c] == 0) continue;
        const double d = norm(x - means_[c]);
        if (d < nearest) {
            nearest = d;
            best = c;
        }
    }
    return best;
}

double LinearDiscriminant::distance(std::size_t a, std::size_t b) const {
    if (counts_[a] == 0 || counts_[b] == 0) return std::numeric_limits<double>::quiet_NaN();
    return norm(means_[a] - means_[b]);
}

}  // namespace tacto
