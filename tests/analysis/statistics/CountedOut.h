// CountedOut.h - the binomial distribution by summing all outcomes, to check the exact tests.
//
// Thread-safety: a pure function.
#pragma once

#include <cmath>
#include <cstddef>

namespace tacto::test {

/// Returns P(X ≥ k) for `n` trials with success probability `p`, between 0 and 1 exclusive.
[[nodiscard]] inline double countedOut(std::size_t k, std::size_t n, double p) {
    const auto log = [](std::size_t x) { return std::lgamma(static_cast<double>(x) + 1); };
    double sum = 0;
    for (std::size_t i = k; i <= n; ++i) {
        sum += std::exp(log(n) - log(i) - log(n - i) + static_cast<double>(i) * std::log(p) +
                        static_cast<double>(n - i) * std::log1p(-p));
    }
    return sum;
}

}  // namespace tacto::test
