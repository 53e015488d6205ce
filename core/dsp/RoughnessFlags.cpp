#include "core/dsp/RoughnessFlags.h"

#include <algorithm>
#include <fmt/format.h>

namespace tacto {

namespace {

/// In the order of RoughnessFlag.
struct FlagWords {
    const char* name;
    const char* sentence;  ///< without its count and full stop where it has a count
};
constexpr std::array<FlagWords, kRoughnessFlags> kFlags{
    {{"band truncated", "The signal's rate is too low for the whole band of R: the band is truncated."},
     {"no spectral feature", "R has no spectral feature: the fingertip measures no acceleration fast enough."},
     {"not force-normalised", "R is not normalised by the force: the fingertip measures none."},
     {"contact assumed", "Contact is assumed throughout: the fingertip measures no force that would tell it."},
     {"sliding assumed", "The finger is taken to slide whenever it touches: there is no rest to tell sliding from."},
     {"baseline assumed",
      "The taxels' baseline is taken from the first 250 ms: there is no rest before the first contact."},
     {"uncalibrated R", "R is not calibrated: no reference surface gives it its meaning."},
     {"uncalibrated units", "The units of the fingertip are not calibrated."},
     {"calibrated on another fingertip", "R was calibrated on another fingertip."},
     {"fingertip of the calibration not confirmed", "Whether R was calibrated on this fingertip is not confirmed."},
     {"scales for another unit left aside", "The profile's scales are left aside: they are for another unit."},
     {"force stale", "The force was stale"},
     {"not a number in force", "The force was not a number"},
     {"repeats or clock steps in force", "The force's time stamps repeated or stepped"},
     {"gaps in acceleration", "The acceleration had gaps"},
     {"repeats or clock steps in acceleration", "The acceleration's time stamps repeated or stepped"},
     {"not a number in acceleration", "The acceleration was not a number"},
     {"not a number in taxels", "The taxels were not a number"},
     {"repeats or clock steps in taxels", "The taxels' time stamps repeated or stepped"}}};
constexpr auto kFirstCounted = static_cast<std::size_t>(RoughnessFlag::ForceStale);

}  // namespace

std::string_view nameOf(RoughnessFlag flag) noexcept { return kFlags[static_cast<std::size_t>(flag)].name; }

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
        out.push_back(i < kFirstCounted ? kFlags[i].name : fmt::format("{}: {}", kFlags[i].name, times[i]));
    }
    return out;
}

std::string flagSentence(std::string_view text) {
    for (std::size_t i = 0; i < kFlags.size(); ++i) {
        const std::string_view name = kFlags[i].name;
        if (!text.starts_with(name)) continue;
        const auto count = text.substr(name.size());
        if (count.empty() && i < kFirstCounted) return kFlags[i].sentence;
        if (!count.starts_with(": ") || i < kFirstCounted) continue;
        return fmt::format("{}: {} {}.", kFlags[i].sentence, count.substr(2), count == ": 1" ? "time" : "times");
    }
    return std::string(text);
}

}  // namespace tacto
