// CoverageTable.h - how often the interval that is printed beside a figure holds the truth: a row for each figure.
//
// A source makes runs of known truth, one for each seed, and adds what the program says of it. A row is wrong where the
// counts cannot come from a coverage of 92 to 99 %, with a false alarm in one of 10 000 rows at most:
//   too narrow   fewer hits than so many runs at 92 % give,
//   too wide     more hits than at 99 %; and, since 200 runs at 99 % are all hits once in 8 times, more errors within
//   half
//                of U than an interval of 99 % has there: 0.80 of normal errors (Φ(2.576/2)), fewer of even ones.
// An interval may be justified in one sentence where a stated bound, or a prior, is wider than what the runs draw.
//
// Thread-safety: none; one owner.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/analysis/statistics/Estimate.h"

namespace tacto::test {

/// The promise of a row.
struct Promise {
    double least = 0.92, most = 0.99;
    double mostWithinHalf = 0.80;  ///< share of the errors, at most, within half of U
    std::string because{};         ///< why, in one sentence, where it is not the usual cause
};

class CoverageTable {
public:
    /// One run: U for 95 %, or the ends of an interval.
    void add(const std::string& figure, double truth, double value, double expanded);
    void add(const std::string& figure, double truth, const Estimate& estimate);
    /// Promises for an added figure, or for all that begin with `figure` and a space.
    void promise(const std::string& figure, const Promise& promise);
    /// Fails the test for each row that breaks its promise, prints all of them, and records their counts.
    void judge(const std::string& source) const;

private:
    struct Row {
        std::size_t runs = 0, held = 0, withinHalf = 0, unknown = 0;
        double largest = 0;  ///< error over U
        Promise promise{};
    };
    std::map<std::string, Row> rows_;
};

/// Seeds of a source: 40 on the way, 200 before a change lands, 2 000 on demand.
[[nodiscard]] std::uint64_t coverageRuns();

}  // namespace tacto::test
