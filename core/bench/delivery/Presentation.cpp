#include "core/bench/delivery/Presentation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/base/Words.h"

namespace tacto {

namespace {

constexpr double kRounding = 1e-9;  // covers the rounding of decimal times in binary
constexpr Seconds kDetectionInterval{0.8};
constexpr Seconds kDetectionPause{0.6};
constexpr int kAscendingTrains = 3;

constexpr Word<PresentationEnd> kPresentationEnds[] = {
    {"complete", PresentationEnd::Complete}, {"refused", PresentationEnd::Refused},
    {"stopped", PresentationEnd::Stopped},   {"paused", PresentationEnd::Paused},
    {"faulted", PresentationEnd::Faulted},   {"late", PresentationEnd::Late}};

bool isTime(Seconds time, Seconds least, Seconds most) noexcept { return time >= least && time <= most; }

Result<void> checkLevel(const StimulusLevel& level) {
    if (const auto* current = std::get_if<Milliamps>(&level)) {
        if (std::isfinite(current->value()) && current->value() >= 0) return {};
        return invalid("level {} mA: must be finite and not negative", current->value());
    }
    const double intensity = std::get<VibrationIntensity>(level).value;
    if (intensity >= 0 && intensity <= 1) return {};
    return invalid("level at intensity {}: must be 0 to 1", intensity);
}

double numberOf(const StimulusLevel& level) noexcept {
    const auto* current = std::get_if<Milliamps>(&level);
    return current != nullptr ? current->value() : std::get<VibrationIntensity>(level).value;
}

/// Checks the level of each train if the presentation has `levels`.
Result<void> checkLevels(const Presentation& presentation) {
    const auto& levels = presentation.levels;
    if (levels.empty()) return {};
    if (levels.size() != presentation.onsets.size()) {
        return invalid("{} levels for {} onsets; one for each is expected", levels.size(), presentation.onsets.size());
    }
    double highest = 0;
    for (const auto& level : levels) {
        if (auto fine = checkLevel(level); !fine) return fine;
        if (level.index() != presentation.level.index() || isEmpty(level)) {
            return invalid(
                "a train of {} in a presentation of {}; a level above 0 of the "
                "same kind is expected",
                textOf(level), textOf(presentation.level));
        }
        highest = std::max(highest, numberOf(level));
    }
    if (highest == numberOf(presentation.level)) return {};
    return invalid(
        "the highest level of the trains is {:g}; that of the presentation, {}, is "
        "expected",
        highest, textOf(presentation.level));
}

Result<void> checkOnsets(const Presentation& presentation) {
    const auto& onsets = presentation.onsets;
    if (onsets.empty() || onsets.size() > Presentation::kMaxTrains) {
        return invalid("a presentation with {} onsets; 1 to {} are accepted", onsets.size(), Presentation::kMaxTrains);
    }
    if (!isTime(onsets.front(), Seconds(0), Presentation::kLongest)) {
        return invalid("a first onset at {} s; 0 to {} s is accepted", onsets.front().count(),
                       Presentation::kLongest.count());
    }
    for (std::size_t i = 1; i < onsets.size(); ++i) {
        const Seconds apart = onsets[i] - onsets[i - 1];
        if (apart >= presentation.interval * (1 - kRounding)) continue;
        return invalid("onsets {} s apart; at least the interval of {} s is accepted", apart.count(),
                       presentation.interval.count());
    }
    return {};
}

}  // namespace

bool isEmpty(const StimulusLevel& level) noexcept {
    const auto* current = std::get_if<Milliamps>(&level);
    return current != nullptr ? current->value() == 0 : std::get<VibrationIntensity>(level).value == 0;
}

std::string textOf(const StimulusLevel& level) {
    if (const auto* current = std::get_if<Milliamps>(&level)) return fmt::format("{:g} mA", current->value());
    return fmt::format("intensity {:g}", std::get<VibrationIntensity>(level).value);
}

std::string_view nameOf(PresentationEnd end) noexcept { return wordFor(kPresentationEnds, end); }

Presentation testPresentation(StimulusLevel level, Seconds interval, Seconds window) {
    Presentation made{.level = level, .interval = interval, .duration = window + Presentation::kTail};
    // Makes one train more than allowed at most: validate() then rejects it, and a wrong interval cannot loop forever.
    for (std::size_t k = 0; k <= Presentation::kMaxTrains; ++k) {
        const Seconds onset = static_cast<double>(k) * interval;
        if (!(onset <= window * (1 + kRounding))) break;
        made.onsets.push_back(onset);
    }
    return made;
}

Presentation ascendingPresentation(StimulusLevel level, Seconds interval) {
    Presentation made{.level = level, .interval = interval};
    for (int k = 0; k < kAscendingTrains; ++k) made.onsets.push_back(k * interval);
    made.duration = made.onsets.back() + Presentation::kTail;
    return made;
}

Presentation detectionPresentation(StimulusLevel level, bool inSecond, Seconds trainLength, Seconds interval) {
    const Seconds begin = inSecond ? kDetectionInterval + kDetectionPause : Seconds(0);
    return {.level = level,
            .onsets = {begin + (kDetectionInterval - trainLength) / 2},
            .interval = interval,
            .duration = 2 * kDetectionInterval + kDetectionPause};
}

Presentation comparisonPresentation(StimulusLevel first, StimulusLevel second, Seconds trainLength, Seconds interval) {
    auto made =
        detectionPresentation(numberOf(first) < numberOf(second) ? second : first, false, trainLength, interval);
    made.onsets.push_back(made.onsets.front() + kDetectionInterval + kDetectionPause);
    made.levels = {first, second};
    return made;
}

int detectionIntervalAt(Seconds since) noexcept {
    if (since >= kDetectionInterval + kDetectionPause) return 2;
    return since >= Seconds(0) && since < kDetectionInterval ? 1 : 0;
}

Result<void> validate(const Presentation& presentation) {
    if (auto fine = checkLevel(presentation.level); !fine) return fine;
    if (!(presentation.interval.count() > 0 && presentation.interval <= Presentation::kLongest)) {
        return invalid("an interval of {} s; above 0 to {} s is accepted", presentation.interval.count(),
                       Presentation::kLongest.count());
    }
    if (auto fine = checkOnsets(presentation); !fine) return fine;
    if (auto fine = checkLevels(presentation); !fine) return fine;
    const Seconds least = presentation.onsets.back() + Presentation::kTail;
    if (isTime(presentation.duration, least * (1 - kRounding), Presentation::kLongest)) return {};
    return invalid("a presentation of {} s whose last train begins at {} s; {} to {} s is accepted",
                   presentation.duration.count(), presentation.onsets.back().count(), least.count(),
                   Presentation::kLongest.count());
}

}  // namespace tacto
