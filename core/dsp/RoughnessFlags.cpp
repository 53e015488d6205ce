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

}  // namespace tacto
