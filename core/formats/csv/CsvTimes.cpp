#include "core/formats/csv/CsvTimes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

#include "core/formats/csv/CsvAdvice.h"

namespace tacto {

namespace {

constexpr double kTolerance = 0.5 + 1e-9;  // share of a step that is accepted, with a margin for rounding
constexpr double kCalm = 0.26;             // share of a step: rounding of stamps explains this much; no warning

/// Properties of the time steps that messages need.
struct Steps {
    double usual = 0;       ///< median of the steps
    std::size_t worst = 0;  ///< row after the step that differs most
    bool everDown = false;
    bool everZero = false;
    double least = std::numeric_limits<double>::infinity();  ///< smallest step above 0
};

Steps stepsOf(std::span<const double> stamps) {
    std::vector<double> steps;
    steps.reserve(stamps.size());
    Steps found;
    for (std::size_t row = 1; row < stamps.size(); ++row) {
        const double step = stamps[row] - stamps[row - 1];
        found.everDown = found.everDown || step < 0;
        found.everZero = found.everZero || step == 0;
        if (step > 0) found.least = std::min(found.least, step);
        steps.push_back(step);
    }
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::ranges::nth_element(steps, middle);  // reorders the steps
    found.usual = *middle;
    double farthest = -1;
    for (std::size_t row = 1; row < stamps.size(); ++row) {
        const double off = std::abs(stamps[row] - stamps[row - 1] - found.usual);
        if (!(off > farthest)) continue;
        farthest = off;
        found.worst = row;
    }
    return found;
}

/// Returns the largest distance of a stamp from the straight line that begins at the first stamp. NaN stays NaN.
double farthestFrom(std::span<const double> stamps, double step) {
    double farthest = 0;
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        const double off = std::abs(stamps[i] - stamps.front() - static_cast<double>(i) * step);
        farthest = off <= farthest ? farthest : off;
    }
    return farthest;
}

/// Returns whether stamps repeat and jump only because they have too few digits, and keep to a straight line.
bool areOnlyCoarse(const Steps& steps, double farthest) {
    return steps.everZero && !steps.everDown && std::isfinite(steps.least) && farthest <= 1.01 * steps.least;
}

/// Returns whether every stamp occurs twice, as in pairs of minimum and maximum (Rohde & Schwarz) or peak detection.
bool arePairs(std::span<const double> stamps) {
    if (stamps.size() < 4 || stamps.size() % 2 != 0) return false;
    for (std::size_t i = 0; i < stamps.size(); i += 2) {
        if (stamps[i] != stamps[i + 1] || (i > 0 && stamps[i] == stamps[i - 1])) return false;
    }
    return true;
}

/// Returns the advice to use a rate, for samples that are even although their times are not.
std::string rateInstead(double step_s) {
    return fmt::format("{}{} reads them{}", kRateInstead,
                       step_s > 0 && std::isfinite(1 / step_s) ? fmt::format("{:.10g}", 1 / step_s) : "HZ",
                       step_s > 0 && std::isfinite(1 / step_s) ? "" : ", where HZ is the instrument's rate");
}

}  // namespace

void LineOfStamps::add(std::size_t index, double stamp) {
    const double off = stamp - first_ - static_cast<double>(index) * step_;
    const double above = std::isfinite(off) ? off : std::numeric_limits<double>::infinity();
    if (ended_ || index - runs_.back().from >= kRun) {
        runs_.push_back({index, index, above, above});
        ended_ = false;
        return;
    }
    auto& run = runs_.back();
    run.to = index;
    run.low = std::min(run.low, above);
    run.high = std::max(run.high, above);
}

double LineOfStamps::farthestAtMost(double step) const noexcept {
    const double steeper = step_ - step;
    double farthest = 0;
    for (const auto& run : runs_) {
        for (const auto index : {run.from, run.to}) {
            const double turned = static_cast<double>(index) * steeper;
            for (const double above : {run.low, run.high}) {
                const double off = std::abs(above + turned);
                if (!std::isfinite(off)) return std::numeric_limits<double>::infinity();
                farthest = std::max(farthest, off);
            }
        }
    }
    return farthest;
}

std::size_t LineOfStamps::mark() noexcept {
    ended_ = true;
    return runs_.size();
}

void CsvTimes::add(std::span<const double> stamps, std::span<const std::size_t> lines) {
    const auto statedStep = stated();
    double sum = 0;  // not zero if a value is infinite or not a number
    for (const double given : stamps) {
        const double stamp = given * layout_.timeFactor;
        const std::size_t row = seen_.rows++;
        seen_.last = stamp;
        sum += stamp * 0;
        if (row < kKept)
            stamps_.push_back(stamp);
        else
            line_->add(row, stamp);
        if (statedStep) {
            const double off = std::abs(stamp - stamps_.front() - static_cast<double>(row) * *statedStep);
            seen_.farthestStated = off <= seen_.farthestStated ? seen_.farthestStated : off;
        }
        if (row + 1 == kKept) line_.emplace(stamps_.front(), step());
    }
    const std::size_t first = seen_.rows - stamps.size();
    if (!(sum == 0)) {
        const auto isFinite = [&](double stamp) { return std::isfinite(stamp * layout_.timeFactor); };
        const auto missing = std::ranges::find_if_not(stamps, isFinite) - stamps.begin();
        missingRow_ = std::min(missingRow_, first + static_cast<std::size_t>(missing));
    }
    // Line numbers rise, so in most batches they are consecutive.
    const bool gapless = lines.back() - lines.front() == lines.size() - 1;
    for (std::size_t i = 0; i < (gapless ? 1 : lines.size()); ++i) {
        if (lines[i] != nextLine_) jumps_.emplace_back(first + i, lines[i]);
        nextLine_ = lines[i] + 1;
    }
    nextLine_ = lines.back() + 1;
}

void CsvTimes::keep() noexcept {
    if (line_) seen_.mark = line_->mark();
    kept_ = seen_;
}

void CsvTimes::dropBehindKept() {
    seen_ = kept_;
    stamps_.resize(std::min(stamps_.size(), seen_.rows));
    if (line_) line_->dropBehind(seen_.mark);
    if (missingRow_ >= seen_.rows) missingRow_ = kNone;
}

std::optional<double> CsvTimes::stated() const noexcept {
    const bool holds = layout_.times == RowTimes::Column && layout_.interval_s && *layout_.interval_s > 0;
    return holds ? layout_.interval_s : std::nullopt;
}

bool CsvTimes::keepToStated() const noexcept { return stated() && seen_.farthestStated <= kTolerance * *stated(); }

bool CsvTimes::needsAll() const {
    constexpr double kSurely = 0.99;  // share of the limit: a certain result, whatever the rounding of the line
    if (hasAll() || layout_.givenRate_hz || missingRow_ != kNone || keepToStated()) return false;
    const double even = step();
    const double atMost = std::max(farthestFrom(stamps_, even), line_->farthestAtMost(even));
    return !(even > 0 && atMost <= kSurely * kCalm * even);
}

void CsvTimes::startAgain() {
    stamps_.clear();
    stamps_.reserve(seen_.rows);
}

void CsvTimes::addAgain(std::span<const double> stamps) {
    const auto counting = std::min(stamps.size(), seen_.rows - stamps_.size());
    for (const double stamp : stamps.first(counting)) stamps_.push_back(stamp * layout_.timeFactor);
}

std::size_t CsvTimes::lineOf(std::size_t row) const {
    const auto& [from, line] =
        *std::prev(std::ranges::upper_bound(jumps_, row, {}, &std::pair<std::size_t, std::size_t>::first));
    return line + (row - from);
}

Result<void> CsvTimes::into(CaptureReading& reading, const std::string& file) const {
    if (auto set = setTimes(reading, file); !set) return set;
    const auto& capture = reading.capture;
    if (!(capture.rate_hz > 0) || !std::isfinite(capture.rate_hz) || !std::isfinite(capture.start_s)) {
        return fail(ErrorCode::ParseError,
                    "{}: times give {} samples per second from {} s on; finite ones were expected", file,
                    capture.rate_hz, capture.start_s);
    }
    return {};
}

Result<void> CsvTimes::setTimes(CaptureReading& reading, const std::string& file) const {
    auto& capture = reading.capture;
    if (layout_.times == RowTimes::Counted) {
        capture.rate_hz = layout_.givenRate_hz ? *layout_.givenRate_hz : 1 / *layout_.interval_s;
        capture.start_s = layout_.start_s;
        return {};
    }
    // An index counts samples; a time column counts seconds.
    const double unit_s = layout_.times != RowTimes::Index ? 1
                          : layout_.interval_s             ? *layout_.interval_s
                                                           : 1 / layout_.givenRate_hz.value_or(1);
    if (layout_.givenRate_hz) {
        capture.rate_hz = *layout_.givenRate_hz;
        capture.start_s = layout_.start_s + (std::isfinite(stamps_.front()) ? stamps_.front() * unit_s : 0);
        return {};
    }
    if (missingRow_ != kNone) {
        const double usual = missingRow_ > 1 && stamps_.size() > 1 ? stamps_[1] - stamps_[0] : 0;
        return fail(ErrorCode::ParseError, "{}:{}: the time is missing; every row needs one{}", file,
                    lineOf(missingRow_), rateInstead(usual * unit_s));
    }
    capture.start_s = layout_.start_s + stamps_.front() * unit_s;
    if (keepToStated()) {
        capture.rate_hz = 1 / *layout_.interval_s;
        return {};
    }
    const bool hasStated = stated().has_value();
    const double even = step();
    const double farthest = hasAll() ? farthestFrom(stamps_, even) : 0;  // missing stamps: known to be even
    double step_s = even * unit_s;
    if (!(even > 0 && farthest <= kTolerance * even)) {
        const auto steps = stepsOf(stamps_);
        if (!areOnlyCoarse(steps, farthest)) {
            return fail(ErrorCode::ParseError,
                        "{}:{}: time moves by {:.6g} s here; it must rise in even steps (most are {:.6g} s){}", file,
                        lineOf(steps.worst), (stamps_[steps.worst] - stamps_[steps.worst - 1]) * unit_s,
                        steps.usual * unit_s, rateInstead(steps.usual * unit_s));
        }
        if (!hasStated && arePairs(stamps_)) {
            return fail(
                ErrorCode::ParseError,
                "{}: every time stands twice, as where the minimum and the maximum of each interval are saved; one "
                "value for each time was expected{}",
                file, rateInstead(step_s));
        }
        // The last digit may hide up to this share of the duration at each end.
        const double doubt = steps.least / (stamps_.back() - stamps_.front());
        if (hasStated && std::abs(*layout_.interval_s / step_s - 1) <= 2 * doubt) step_s = *layout_.interval_s;
        reading.warnings.push_back(
            fmt::format("{}: time stamps move by at least {:.6g} s, but samples are {:.6g} s apart; {}", file,
                        steps.least * unit_s, step_s,
                        hasStated && step_s == *layout_.interval_s
                            ? std::string("the header's interval was taken")
                            : fmt::format("the rate is known to {:.2g} % from the first and the last", 100 * doubt)));
    } else if (hasStated) {
        reading.warnings.push_back(
            fmt::format("{}: the header states {:.6g} s between samples, the time stamps rise by {:.6g} s; the stamps "
                        "were taken",
                        file, *layout_.interval_s, step_s));
    } else if (farthest > kCalm * even) {
        reading.warnings.push_back(fmt::format(
            "{}: time stamps stray by up to {:.2g} of a step of {:.6g} s; samples were taken as evenly spaced", file,
            farthest / even, step_s));
    }
    capture.rate_hz = 1 / step_s;
    return {};
}

}  // namespace tacto
