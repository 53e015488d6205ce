#include "core/formats/CsvTimes.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/formats/CsvRows.h"

namespace tacto {

namespace {

constexpr double kTolerance = 0.5 + 1e-9;  // of a step: accepted; the rest is rounding
constexpr double kCalm = 0.26;             // not worth a word: what rounding to half a step's digits does

/// The stamps once more, for what is only asked of tables that do not fit.
Result<void> eachStep(TextBlocks& blocks, const CsvHead& head, const CsvLayout& layout, std::size_t rows,
                      const ReadWatch& watch,
                      const std::function<void(std::size_t row, double t, double step, std::size_t line)>& visit) {
    if (auto back = blocks.rewind(); !back) return back;
    CsvRows again(layout, head.separator, head.point, blocks);
    std::size_t row = 0;
    double before = 0;
    while (row < rows) {
        const auto batch = again.next({{}, watch.stop});
        if (!batch) return failure(batch);
        if ((*batch)->rows == 0) break;
        for (std::size_t i = 0; i < (*batch)->rows && row < rows; ++i, ++row) {
            const double t = (*batch)->times[i] * layout.timeFactor;
            if (row > 0) visit(row, t, t - before, (*batch)->lines[i]);
            before = t;
        }
    }
    return {};
}

/// What the steps are like, as far as a message needs it.
struct Steps {
    double usual = 0;      ///< the median of a sample of them
    double worst = 0;      ///< farthest from it
    std::size_t line = 0;  ///< of the worst
    bool everDown = false;
    bool everZero = false;
    double least = std::numeric_limits<double>::infinity();  ///< above 0
    double farthest = 0;  ///< of any stamp from the straight line between first and last
    double fromStated = std::numeric_limits<double>::infinity();  ///< likewise from a line of the header's interval
};

Result<Steps> stepsOf(TextBlocks& blocks, const CsvHead& head, const CsvLayout& layout, std::size_t rows,
                      const EvenSteps& even, const ReadWatch& watch) {
    constexpr std::size_t kSampled = 65536;
    const std::size_t every = rows / kSampled + 1;
    const double interval_s = layout.interval_s.value_or(0);
    double fromStated = 0;
    Steps steps;
    std::vector<double> sampled;
    auto read =
        eachStep(blocks, head, layout, rows, watch, [&](std::size_t row, double t, double step, std::size_t /*line*/) {
            if (row % every == 0) sampled.push_back(step);
            steps.everDown = steps.everDown || step < 0;
            steps.everZero = steps.everZero || step == 0;
            if (step > 0) steps.least = std::min(steps.least, step);
            const double straight = even.first() + static_cast<double>(row) * even.step();
            steps.farthest = std::max(steps.farthest, std::abs(t - straight));
            const double stated = even.first() + static_cast<double>(row) * interval_s;
            fromStated = std::max(fromStated, std::abs(t - stated));
        });
    if (!read) return failure(read);
    if (layout.interval_s) steps.fromStated = fromStated;
    const auto middle = sampled.begin() + static_cast<std::ptrdiff_t>(sampled.size() / 2);
    std::nth_element(sampled.begin(), middle, sampled.end());
    steps.usual = *middle;
    read = eachStep(blocks, head, layout, rows, watch,
                    [&](std::size_t /*row*/, double /*t*/, double step, std::size_t line) {
                        if (steps.line == 0 || std::abs(step - steps.usual) > std::abs(steps.worst - steps.usual)) {
                            steps.worst = step;
                            steps.line = line;
                        }
                    });
    if (!read) return failure(read);
    return steps;
}

/// Stamps written with too few digits repeat and jump by the last digit, but keep to a straight line.
bool areOnlyCoarse(const Steps& steps) {
    return steps.everZero && !steps.everDown && std::isfinite(steps.least) && steps.farthest <= 1.01 * steps.least;
}

}  // namespace

void CsvTimes::add(std::span<const double> stamps, std::span<const std::size_t> lines) {
    even_.add(stamps, factor_);
    if (missingLine_ != 0) return;
    // Zero unless one is infinite or not a number.
    double sum = 0;
    for (const double stamp : stamps) sum += stamp * factor_ * 0;
    for (std::size_t i = 0; i < stamps.size() && !(sum == 0) && missingLine_ == 0; ++i) {
        if (!std::isfinite(stamps[i] * factor_)) missingLine_ = lines[i];
    }
}

Result<void> CsvTimes::into(CaptureReading& reading, TextBlocks& blocks, const CsvHead& head, const CsvLayout& layout,
                            std::size_t rows, const ReadWatch& watch) const {
    if (auto set = setTimes(reading, blocks, head, layout, rows, watch); !set) return set;
    const auto& capture = reading.capture;
    if (!(capture.rate_hz > 0) || !std::isfinite(capture.rate_hz) || !std::isfinite(capture.start_s)) {
        return fail(ErrorCode::ParseError,
                    "{}: times give {} samples per second from {} s on; finite ones were expected", blocks.name(),
                    capture.rate_hz, capture.start_s);
    }
    return {};
}

Result<void> CsvTimes::setTimes(CaptureReading& reading, TextBlocks& blocks, const CsvHead& head,
                                const CsvLayout& layout, std::size_t rows, const ReadWatch& watch) const {
    auto& capture = reading.capture;
    if (layout.times == RowTimes::Counted) {
        capture.rate_hz = layout.givenRate_hz ? *layout.givenRate_hz : 1 / *layout.interval_s;
        capture.start_s = layout.start_s;
        return {};
    }
    if (missingLine_ != 0) {
        return fail(ErrorCode::ParseError, "{}:{}: the time is missing; every row needs one", blocks.name(),
                    missingLine_);
    }
    // An index counts samples, a column of times seconds.
    const double unit_s = layout.times == RowTimes::Index ? *layout.interval_s : 1;
    capture.start_s = layout.start_s + even_.first() * unit_s;
    if (layout.givenRate_hz) {
        capture.rate_hz = *layout.givenRate_hz;
        return {};
    }
    const bool stated = layout.times == RowTimes::Column && layout.interval_s && *layout.interval_s > 0;
    if (stated && even_.surelyFits(*layout.interval_s, kTolerance)) {
        capture.rate_hz = 1 / *layout.interval_s;
        return {};
    }
    const double step = even_.step();
    double step_s = step * unit_s;
    if (!stated && even_.surelyFits(step, kCalm)) {
        capture.rate_hz = 1 / step_s;
        return {};
    }
    const auto steps = stepsOf(blocks, head, layout, rows, even_, watch);
    if (!steps) return failure(steps);
    if (stated && steps->fromStated <= kTolerance * *layout.interval_s) {
        capture.rate_hz = 1 / *layout.interval_s;
        return {};
    }
    if (!(step > 0) || steps->farthest > kTolerance * step) {
        if (!areOnlyCoarse(*steps)) {
            return fail(ErrorCode::ParseError,
                        "{}:{}: time moves by {:.6g} s here; it must rise in even steps (most are {:.6g} s)",
                        blocks.name(), steps->line, steps->worst * unit_s, steps->usual * unit_s);
        }
        // The last digit may hide up to this much of the duration at either end.
        const double doubt = steps->least / (even_.last() - even_.first());
        if (stated && std::abs(*layout.interval_s / step_s - 1) <= 2 * doubt) step_s = *layout.interval_s;
        reading.warnings.push_back(
            fmt::format("{}: time stamps move by {:.6g} s at the least, but samples are {:.6g} s apart; {}",
                        blocks.name(), steps->least * unit_s, step_s,
                        stated && step_s == *layout.interval_s
                            ? std::string("the header's interval was taken")
                            : fmt::format("the rate is known to {:.2g} % from the first and the last", 100 * doubt)));
    } else if (stated) {
        reading.warnings.push_back(
            fmt::format("{}: the header states {:.6g} s between samples, the time stamps rise by {:.6g} s; the stamps "
                        "were taken",
                        blocks.name(), *layout.interval_s, step_s));
    } else if (steps->farthest > kCalm * step) {
        reading.warnings.push_back(fmt::format(
            "{}: time stamps stray by up to {:.2g} of a step of {:.6g} s; samples were taken as evenly spaced",
            blocks.name(), steps->farthest / step, step_s));
    }
    capture.rate_hz = 1 / step_s;
    return {};
}

}  // namespace tacto
