#include "tests/coverage/CoverageTable.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/analysis/statistics/Estimate.h"
#include "tests/support/Trials.h"

namespace tacto::test {

namespace {

constexpr double kFalseAlarm = 1e-4;

bool tooFew(std::size_t hits, std::size_t runs, double share) {
    return 1 - binomialAtLeast(hits + 1, runs, share) < kFalseAlarm;
}
bool tooMany(std::size_t hits, std::size_t runs, double share) {
    return binomialAtLeast(hits, runs, share) < kFalseAlarm;
}

}  // namespace

std::uint64_t coverageRuns() { return trials<std::uint64_t>({.local = 40, .ci = 200, .campaign = 2000}); }

void CoverageTable::add(const std::string& figure, double truth, double value, double expanded) {
    Row& row = rows_[figure];
    ++row.runs;
    const double used = std::abs(value - truth) / expanded;
    if (!std::isfinite(used)) {
        ++row.unknown;
        return;
    }
    row.held += used <= 1 ? 1 : 0;
    row.withinHalf += used <= 0.5 ? 1 : 0;
    row.largest = std::max(row.largest, used);
}

void CoverageTable::add(const std::string& figure, double truth, const Estimate& estimate) {
    const double end = truth > estimate.value ? estimate.high : estimate.low;
    add(figure, truth, estimate.value, std::abs(end - estimate.value));
}

void CoverageTable::promise(const std::string& figure, const Promise& promise) {
    for (auto& [name, row] : rows_) {
        if (name == figure || name.starts_with(figure + " ")) row.promise = promise;
    }
}

void CoverageTable::judge(const std::string& source) const {
    for (const auto& [name, row] : rows_) {
        const auto share = [&row](std::size_t count) {
            return 100 * static_cast<double>(count) / static_cast<double>(row.runs);
        };
        const auto text = fmt::format("{} | {} | {} | {:.1f} % | within U/2: {:.0f} % | largest {:.2f} U{}{}", source,
                                      name, row.runs, share(row.held), share(row.withinHalf), row.largest,
                                      row.promise.because.empty() ? "" : " | ", row.promise.because);
        fmt::print("{}\n", text);
        testing::Test::RecordProperty(source + ", " + name, text);
        EXPECT_EQ(row.unknown, 0U) << text << ": without a value or a U";
        EXPECT_FALSE(tooFew(row.held, row.runs, row.promise.least)) << text << ": too narrow";
        EXPECT_FALSE(tooMany(row.held, row.runs, row.promise.most)) << text << ": too wide";
        EXPECT_FALSE(tooMany(row.withinHalf, row.runs, row.promise.mostWithinHalf)) << text << ": too wide";
    }
}

}  // namespace tacto::test
