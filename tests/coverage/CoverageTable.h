// CoverageTable.h - how often the interval printed next to a figure contains the true value, with a row for each
// figure.
//
// A source makes runs with known truth, one for each seed, and adds the program's results. A row fails if its counts
// cannot come from a coverage of 92 to 99 %, with a false alarm in at most one of 10 000 rows. Too narrow: fewer hits
// than 92 % would give. Too wide: more hits than 99 % would give, or (since 200 runs at 99 % are all hits once in 8
// times) more errors within half of U than a 99 % interval has: 0.80 for normal errors (Φ(2.576/2)), fewer for uniform
// ones. U is the expanded uncertainty (95 %).
// An interval may be wider, with a reason in one sentence, if a stated bound or a prior is wider than the runs draw.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/analysis/statistics/Estimate.h"

namespace tacto::test {

/// What a row must fulfil.
struct Promise {
    double least = 0.92, most = 0.99;
    double mostWithinHalf = 0.80;  ///< highest accepted share of errors within half of U
    std::string because{};         ///< the reason in one sentence, if this differs from the usual values
};

class CoverageTable {
public:
    /// Adds one run, with U for 95 %, or with the ends of an interval.
    void add(const std::string& figure, double truth, double value, double expanded);
    void add(const std::string& figure, double truth, const Estimate& estimate);
    /// Sets the promise for an added figure, or for all figures that begin with `figure` and a space.
    void promise(const std::string& figure, const Promise& promise);
    /// Prints all rows and records their counts; fails the test for each row that breaks its promise.
    void judge(const std::string& source) const;

private:
    struct Row {
        std::size_t runs = 0, held = 0, withinHalf = 0, unknown = 0;
        double largest = 0;  ///< the error divided by U
        Promise promise{};
    };
    std::map<std::string, Row> rows_;
};

/// Number of seeds for each source: 40 in local runs, 200 in CI, 2 000 on demand.
[[nodiscard]] std::uint64_t coverageRuns();

}  // namespace tacto::test
