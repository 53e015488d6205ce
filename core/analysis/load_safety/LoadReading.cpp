#include "core/analysis/load_safety/LoadReading.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/load_safety/LoadFigures.h"
#include "core/measure/InstrumentStatement.h"

namespace tacto {

namespace {

Result<void> checked(std::span<const Capture> captures, const ExpectedTrain& expected) {
    if (captures.empty()) return fail(ErrorCode::InvalidArgument, "no capture to read a load from; one per train");
    if (expected.pulses < 1 || !(expected.rate_hz > 0)) {
        return fail(ErrorCode::InvalidArgument, "a train of {} pulses at {} Hz; at least 1 and above 0 are expected",
                    expected.pulses, expected.rate_hz);
    }
    if (!expected.programmed.empty() && expected.programmed.size() != captures.size()) {
        return fail(ErrorCode::InvalidArgument, "{} amplitudes programmed for {} captures; one for each is expected",
                    expected.programmed.size(), captures.size());
    }
    for (const auto needed : {std::string_view("voltage"), drivenBy(expected)}) {
        if (channelOf(captures.front(), needed) != nullptr) continue;
        return fail(ErrorCode::NotFound, "the capture has no channel \"{}\"", needed);
    }
    return {};
}

}  // namespace

bool Reading::measured() const noexcept { return std::isfinite(value) && std::isfinite(expanded); }

Reading readingOf(double value, std::vector<Contribution> rows, const BudgetOptions& budget) {
    if (!std::isfinite(value)) return {value, kNaN, kNaN};
    const auto combined = combine(std::move(rows), budget);
    if (!combined) return {value, kNaN, kNaN};
    return {value, combined->combined, combined->expanded};
}

Result<LoadReading> readLoad(std::span<const Capture> captures, const ExpectedTrain& expected,
                             std::span<const Capture> fine, const Capture* rhythm) {
    if (const auto sane = checked(captures, expected); !sane) return failure(sane);
    LoadReading out;
    LoadTrains trains;
    for (std::size_t k = 0; k < captures.size(); ++k) {
        const double programmed = expected.programmed.empty() ? kNaN : expected.programmed[k];
        if (auto train = readTrain(captures[k], expected, programmed, out.warnings)) trains.push_back(*train);
    }
    out.trains = trains.size();
    // A train that cannot be read may have been the one that exceeds a limit.
    if (trains.size() != captures.size()) return out;

    out.notStated = notStatedText(captures.front());
    const bool stamped = std::isfinite(captures.front().stampTolerance_s);
    if (out.notStated.empty() && !stamped && rhythm == nullptr) {
        out.notStated = "the oscilloscope does not state how good the time stamps of its records are";
    }
    const auto* current = channelOf(captures.front(), "current");
    out.biphasic = std::all_of(trains.begin(), trains.end(), [](const auto& train) { return train.biphasic; });
    out.currentLsb = current != nullptr ? current->lsb : 0;
    const LoadFigures figures(trains, expected, captures.front());
    figures.addVoltage(out);
    if (expected.pulses > 1) figures.addRate(out);
    figures.addInterval(out, stamped ? nullptr : rhythm);
    figures.addVoltageWindows(out);

    const double peak = largestOf(trains, &TrainFigures::peak_a);
    if (!std::isfinite(peak)) return out;
    if (!(out.currentLsb > 0) || !(peak >= kMinLsb * out.currentLsb)) {
        out.underTenLsb = true;
        out.warnings.push_back(fmt::format("the current of {:.3g} mA is below 10 LSB of {:.3g} mA: not evaluated",
                                           1e3 * peak, 1e3 * out.currentLsb));
        return out;
    }
    figures.addCurrent(out);
    if (!fine.empty()) addFineRange(out, figures, captures, fine, expected);
    return out;
}

}  // namespace tacto
