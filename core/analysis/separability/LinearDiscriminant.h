// LinearDiscriminant.h - separates classes of points in the plane with one shared covariance. Private to core/analysis.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace tacto {

/// A trial as a point: amplitude and interval.
struct LabelledPoint {
    Eigen::Vector2d x;
    std::size_t label = 0;  // below the number of classes
};

class LinearDiscriminant {
public:
    /// Computes the means per class and the covariance pooled over all classes (degrees of freedom: points minus
    /// classes). No variance is less than the square of `floor`, which is positive. Classes without points are ignored.
    LinearDiscriminant(const std::vector<LabelledPoint>& points, std::size_t classes, const Eigen::Vector2d& floor);

    /// Returns the class with the nearest mean in Mahalanobis distance (LDA with equal priors); the first one on a tie.
    [[nodiscard]] std::size_t classify(const Eigen::Vector2d& x) const;

    /// Mahalanobis distance between the means of two classes; NaN if one of them has no points.
    [[nodiscard]] double distance(std::size_t a, std::size_t b) const;

private:
    [[nodiscard]] double norm(const Eigen::Vector2d& difference) const;

    std::vector<Eigen::Vector2d> means_;
    std::vector<std::size_t> counts_;
    Eigen::Matrix2d precision_;
};

}  // namespace tacto
