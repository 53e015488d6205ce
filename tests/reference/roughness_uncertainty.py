"""U of R for one slide, computed with numpy another way than core/analysis/sensor_calibration/SensorCalibration.cpp does.

R of a slide is a function of the slide's log10 features and of the two references' mean log10 features (science.md
section 2, items 6 and 7). Here its partial derivatives are taken numerically, the covariance of the features within a
surface is a matrix, and u follows from the law of propagation of uncertainty (GUM 5.2.2). A Monte Carlo run says how
often the interval holds the truth. tests/analysis reads it.
"""
import numpy as np
from scipy import stats

from figures import keep

W = np.array([0.5, 0.5])


def r_of(slide, smooth, rough):
    return np.sum(W * (slide - smooth) / (rough - smooth), axis=-1) / W.sum()


def pooled(surfaces):
    freedom = sum(len(s) - 1 for s in surfaces)
    squares = sum((s - s.mean(axis=0)).T @ (s - s.mean(axis=0)) for s in surfaces)
    return squares / freedom, freedom


def expanded(surfaces, r):
    covariance, freedom = pooled(surfaces)
    smooth, rough = surfaces[0].mean(axis=0), surfaces[1].mean(axis=0)
    at = np.concatenate([smooth + r * (rough - smooth), smooth, rough])

    def f(x):
        return r_of(x[0:2], x[2:4], x[4:6])

    step = 1e-6
    jacobian = np.array([(f(at + step * e) - f(at - step * e)) / (2 * step) for e in np.eye(6)])
    joint = np.zeros((6, 6))
    for i, n in enumerate([1, len(surfaces[0]), len(surfaces[1])]):
        joint[2 * i:2 * i + 2, 2 * i:2 * i + 2] = covariance / n
    return stats.t.ppf(0.975, freedom) * np.sqrt(jacobian @ joint @ jacobian)


def draw(random, counts, centres, covariance):
    return [random.multivariate_normal(c, covariance, n) for n, c in zip(counts, centres)]


def coverage(runs=4000):
    random = np.random.default_rng(2)
    covariance = np.array([[4e-4, 1e-4], [1e-4, 9e-4]])
    smooth, rough = np.array([-1.6, -3.5]), np.array([-0.5, -1.3])
    held = 0
    for run in range(runs):
        truth = random.uniform()
        surfaces = draw(random, [5, 5, 5], [smooth, rough, (smooth + rough) / 2], covariance)
        slide = random.multivariate_normal(smooth + truth * (rough - smooth), covariance)
        seen = r_of(slide, surfaces[0].mean(axis=0), surfaces[1].mean(axis=0))
        held += abs(seen - truth) <= expanded(surfaces, seen)
    return held / runs


def figures():
    random = np.random.default_rng(1)
    covariance = np.array([[4e-4, -2e-4], [-2e-4, 2.5e-3]])
    surfaces = draw(random, [5, 7, 4], [[-1.6, -3.5], [-0.5, -1.3], [-1.0, -2.2]], covariance)
    freedom = pooled(surfaces)[1]
    return {
        "surfaces": [{"h": (10 ** s[:, 0]).tolist(), "v": (10 ** s[:, 1]).tolist()} for s in surfaces],
        "degrees_of_freedom": freedom,
        "expanded": [{"R": r, "U": float(expanded(surfaces, r))} for r in (0.0, 0.25, 0.5, 1.0)],
        "coverage": coverage(),
    }


keep(__file__, figures)
