// LinearDiscriminant.h - classes of points in the plane with one shared covariance. Private to core/analysis.
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
    /// Means per class and the covariance pooled over all of them, with points minus classes degrees of freedom. No
    /// variance is taken below the square of `floor`, which is above zero. Classes without points stay unused.
    LinearDiscriminant(const std::vector<LabelledPoint>& points, std::size_t classes, const Eigen::Vector2d& floor);

    /// The class with the nearest mean in Mahalanobis distance: LDA with equal priors. The first one on a tie.
    [[nodiscard]] std::size_t classify(const Eigen::Vector2d& x) const;

    /// Mahalanobis distance between two classes' means; NaN when one has no points.
    [[nodiscard]] double distance(std::size_t a, std::size_t b) const;

private:
    [[nodiscard]] double norm(const Eigen::Vector2d& difference) const;

    std::vector<Eigen::Vector2d> means_;
    std::vector<std::size_t> counts_;
    Eigen::Matrix2d precision_;
};

}  // namespace tacto
