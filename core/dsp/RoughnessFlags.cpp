#include "core/dsp/RoughnessFlags.h"

#include <algorithm>
#include <fmt/format.h>

namespace tacto {

namespace {

constexpr std::array<const char*, kRoughnessFlags> kTexts{"band truncated",
                                                          "no spectral feature",
                                                          "not force-normalised",
                                                          "contact assumed",
                                                          "sliding assumed",
                                                          "baseline assumed",
                                                          "uncalibrated R",
                                                          "uncalibrated units",
                                                          "calibrated on another fingertip",
                                                          "fingertip of the calibration not confirmed",
                                                          "scales for another unit left aside",
                                                          "force stale",
                                                          "not a number in force",
                                                          "repeats or clock steps in force",
                                                          "gaps in acceleration",
                                                          "repeats or clock steps in acceleration",
                                                          "not a number in acceleration",
                                                          "not a number in taxels",
                                                          "repeats or clock steps in taxels"};
constexpr std::array<const char*, kRoughnessFlags> kSentences{
    "The signal's rate is too low for the whole band of R: the band is truncated.",
    "R has no spectral feature: the fingertip measures no acceleration fast enough.",
    "R is not normalised by the force: the fingertip measures none.",
    "Contact is assumed throughout: the fingertip measures no force that would tell it.",
    "The finger is taken to slide whenever it touches: there is no rest to tell sliding from.",
    "The taxels' baseline is taken from the first 250 ms: there is no rest before the first contact.",
    "R is not calibrated: no reference surface gives it its meaning.",
    "The units of the fingertip are not calibrated.",
    "R was calibrated on another fingertip.",
    "Whether R was calibrated on this fingertip is not confirmed.",
    "The profile's scales are left aside: they are for another unit.",
    "The force was stale",
    "The force was not a number",
    "The force's time stamps repeated or stepped",
    "The acceleration had gaps",
    "The acceleration's time stamps repeated or stepped",
    "The acceleration was not a number",
    "The taxels were not a number",
    "The taxels' time stamps repeated or stepped"};
constexpr auto kFirstCounted = static_cast<std::size_t>(RoughnessFlag::ForceStale);

}  // namespace

std::string_view nameOf(RoughnessFlag flag) noexcept { return kTexts[static_cast<std::size_t>(flag)]; }

void RoughnessFlags::dropCalibration() noexcept {
    using enum RoughnessFlag;
    for (const auto flag : {UncalibratedR, UncalibratedUnits, AnotherFingertip, FingertipNotNamed, ScalesLeftAside})
        raise(flag, false);
}

void RoughnessFlags::include(const RoughnessFlags& other) noexcept {
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = std::max(times[i], other.times[i]);
}

std::vector<std::string> RoughnessFlags::texts() const {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] == 0) continue;
        out.push_back(i < kFirstCounted ? kTexts[i] : fmt::format("{}: {}", kTexts[i], times[i]));
    }
    return out;
}

std::string flagSentence(std::string_view text) {
    for (std::size_t i = 0; i < kTexts.size(); ++i) {
        const std::string_view name = kTexts[i];
        if (!text.starts_with(name)) continue;
        const auto count = text.substr(name.size());
        if (count.empty() && i < kFirstCounted) return kSentences[i];
        if (!count.starts_with(": ") || i < kFirstCounted) continue;
        return fmt::format("{}: {} {}.", kSentences[i], count.substr(2), count == ": 1" ? "time" : "times");
    }
    return std::string(text);
}

}  // namespace tacto
