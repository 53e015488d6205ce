"""Statistics, intervals and distances by numpy and scipy. tests/base, tests/analysis and tests/cli read them.

What goes in stands beside each figure.
"""
import numpy as np
from scipy import integrate, optimize, special, stats

from figures import keep


def student(p, freedom):
    """The quantile for p above 0.5. scipy 1.10's own (stats.t.ppf) is right to 9 digits only."""
    x = special.betaincinv(freedom / 2, 0.5, 2 * (1 - p))
    return np.sqrt(freedom * (1 - x) / x)


def sample():
    x = [3.1, -2, 7.5, 0.25, 11]
    return {"readings": x, "mean": np.mean(x), "sd": np.std(x, ddof=1), "median": np.median(x)}


def wilson(k, n):
    interval = stats.binomtest(k, n).proportion_ci(0.95, method="wilson")
    return {"k": k, "n": n, "low": interval.low, "high": interval.high}


def variation_factors(n):
    """Of a coefficient of variation from n readings: bounds of 95 % confidence to each side."""
    low, high = np.sqrt((n - 1) / stats.chi2.ppf([0.95, 0.05], n - 1))
    return {"n": n, "low": low, "high": high}


def log_ratio(a, b):
    """|ln(mean / mean)| of two samples [mean, sd, n, the instrument's standard uncertainty], one-sided 95 % each."""
    scatter = [(sd / mean) ** 2 / n for mean, sd, n, _ in (a, b)]
    variance = sum(scatter) + sum((u / mean) ** 2 for mean, _, _, u in (a, b))
    ratio = abs(np.log(a[0] / b[0]))
    if sum(scatter) == 0:
        reach = stats.norm.ppf(0.95) * np.sqrt(variance)
    else:
        freedom = variance**2 / sum(s**2 / (sample[2] - 1) for s, sample in zip(scatter, (a, b)))
        reach = student(0.95, freedom) * np.sqrt(variance)
    return {"a": a, "b": b, "low": max(0, ratio - reach), "high": ratio + reach}


def normal_and_rectangle(half_width):
    """Half the width of the interval that holds 95 % of a standard normal value plus one even within ± half_width."""

    def within(u):
        inside = lambda e: stats.norm.cdf(u - e) - stats.norm.cdf(-u - e)
        return integrate.quad(inside, -half_width, half_width, epsabs=1e-13)[0] / (2 * half_width)

    return {"half_width": half_width, "expanded": optimize.brentq(lambda u: within(u) - 0.95, 0.1, 10, xtol=1e-13)}


def spearman(x, y):
    """Fisher's z with the variance of Bonett and Wright (Psychometrika 65, 2000, 23-28)."""
    rho = stats.spearmanr(x, y)[0]
    return {"x": x, "y": y, "rho": rho, **spearman_interval(rho, len(x))}


def spearman_interval(rho, n):
    reach = stats.norm.ppf(0.975) * np.sqrt((1 + rho**2 / 2) / (n - 3))
    return {"low": np.tanh(np.arctanh(rho) - reach), "high": np.tanh(np.arctanh(rho) + reach)}


def noncentral_t(t, nu, delta):
    return {"t": t, "nu": nu, "delta": delta, "p": stats.nct.cdf(t, nu, delta) if delta else stats.t.cdf(t, nu)}


def distance(a, b):
    """d' = difference of the means over the pooled sd; its interval by inverting the noncentral t."""
    na, nb = len(a), len(b)
    nu = na + nb - 2
    sd = np.sqrt(((na - 1) * np.var(a, ddof=1) + (nb - 1) * np.var(b, ddof=1)) / nu)
    d = (np.mean(b) - np.mean(a)) / sd
    scale = np.sqrt(na * nb / (na + nb))

    def bound(p):
        return optimize.brentq(lambda delta: stats.nct.cdf(d * scale, nu, delta) - p, -50, 50, xtol=1e-12) / scale

    return {"a": a, "b": b, "pooled_sd": sd, "d": d, "low": bound(0.975), "high": bound(0.025)}


def above_chance_from(n, chance):
    """The fewest right answers of n whose probability by chance is at most 5 %; n + 1: not even all."""
    return {"n": n, "chance": chance, "from": next(k for k in range(n + 2) if stats.binom.sf(k - 1, n, chance) <= 0.05)}


def figures():
    return {
        "sample": sample(),
        "wilson": [wilson(*kn) for kn in ((100, 100), (99, 100), (73, 73), (72, 72), (0, 10), (5, 10), (1, 1))],
        "normal_quantile": {"0.975": stats.norm.ppf(0.975)},
        "variation_factors": [variation_factors(n) for n in (2, 5, 25, 100)],
        "log_ratio": [
            log_ratio([10, 0.3, 25, 0], [40, 0.8, 25, 0]),
            log_ratio([10, 0.3, 4, 0.1], [12, 0.8, 7, 0.2]),
            log_ratio([10, 0, 25, 0.1], [40, 0, 25, 0]),
        ],
        "normal_and_rectangle": normal_and_rectangle(1.1),
        "spearman": {
            "ties": spearman([1.6, 3.0, 12.0, 24.0, 42.0, 91.0], [0.02, 0.3, 0.25, 0.8, 0.95, 0.95]),
            # Intelligence against hours of television, the worked example of Wikipedia's "Spearman's rank correlation
            # coefficient": 1 - 6 * 194 / (10 * 99).
            "worked_example": spearman(
                [106, 100, 86, 101, 99, 103, 97, 113, 112, 110], [7, 27, 2, 50, 28, 29, 20, 12, 6, 17]
            ),
            # Half-way to the next that five values can have: 1 - 6 * 2 / (5 * 24) = 0.9.
            "nearly_perfect_order": {"n": 5, "rho": 0.95, **spearman_interval(0.95, 5)},
        },
        "noncentral_t": [
            noncentral_t(*case)
            for case in ((2.0, 4, 1.0), (10, 8, 9), (-1.5, 5, 0.7), (50, 8, 45), (3, 18, 0))
        ],
        "distance": {
            "far": distance([1.1, 1.4, 0.9, 1.2, 1.3], [2.0, 2.3, 1.8, 2.2, 2.6]),
            "near": distance([1.0, 1.2, 0.8, 1.1], [1.1, 1.3, 0.9, 1.0, 1.25]),
        },
        "above_chance": [above_chance_from(80, 0.25), above_chance_from(1, 0.25)],
    }


keep(__file__, figures)
