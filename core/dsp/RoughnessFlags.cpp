#include "core/dsp/RoughnessFlags.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/LocaleFreeText.h"

namespace tacto {

namespace {

/// Names and sentences of the flags, in the order of RoughnessFlag.
struct FlagWords {
    const char* name;
    const char* sentence;  ///< for people; if the flag has a count, without count and full stop
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
     {"no frame in contact",
      "No frame is in contact: what the force or the recording gives as contact lies where there is no frame, or where "
      "the force is stale."},
     {"force below contact", "The force never reaches 0.1"},
     {"force at other times", "No force belongs to the frames, whose times it does not overlap"},
     {"taxels at other times", "No taxel sample belongs to the frames, whose times the taxels do not overlap"},
     {"force stale", "The force was stale"},
     {"not a number in force", "The force was not a number"},
     {"out of all proportion in force",
      "The force was out of all proportion (beyond 200 N, or far from all other counts) and left out"},
     {"repeats or clock steps in force", "The force's time stamps repeated or stepped"},
     {"gaps in acceleration", "The acceleration had gaps"},
     {"repeats or clock steps in acceleration", "The acceleration's time stamps repeated or stepped"},
     {"not a number in acceleration", "The acceleration was not a number"},
     {"out of all proportion in acceleration",
      "The acceleration was out of all proportion (beyond 5000 m/s², or far from all other counts) and left out"},
     {"not a number in taxels", "The taxels were not a number"},
     {"out of all proportion in taxels",
      "The taxels were out of all proportion (beyond 10 MPa, or far from all other counts) and left out"},
     {"repeats or clock steps in taxels", "The taxels' time stamps repeated or stepped"}}};
constexpr auto kFirstCounted = static_cast<std::size_t>(RoughnessFlag::ForceElsewhere);
constexpr auto kBelowContact = static_cast<std::size_t>(RoughnessFlag::ForceBelowContact);

/// Returns the sentence for a range such as "-1.2 to -0.8 N".
std::string belowContactSentence(std::string_view range) {
    const auto low = takeNumber(range);
    if (!low || !range.starts_with(" to ")) return {};
    range.remove_prefix(4);
    const auto high = takeNumber(range);
    if (!high) return {};
    const bool reversed = *high <= 0 || *low <= -0.1;
    return fmt::format("{}{}, where contact begins: it lies between {} and {}{}; {}", kFlags[kBelowContact].sentence,
                       range, *low, *high, range,
                       reversed ? "is the sign of the normal force reversed? (\"factor\": -1 turns it in a recording.)"
                                : "nothing was touched, or its unit is another one.");
}

}  // namespace

std::string_view nameOf(RoughnessFlag flag) noexcept { return kFlags[static_cast<std::size_t>(flag)].name; }

void RoughnessFlags::dropCalibration() noexcept {
    using enum RoughnessFlag;
    for (const auto flag : {UncalibratedR, UncalibratedUnits, AnotherFingertip, FingertipNotNamed, ScalesLeftAside})
        raise(flag, false);
}

void RoughnessFlags::dropAbsence() noexcept {
    using enum RoughnessFlag;
    for (const auto flag : {NoFrameInContact, ForceBelowContact, ForceElsewhere, TaxelsElsewhere}) raise(flag, false);
}

void RoughnessFlags::include(const RoughnessFlags& other) noexcept {
    if (other.has(RoughnessFlag::ForceBelowContact)) {
        leastForce = other.leastForce;
        mostForce = other.mostForce;
        forceUnit = other.forceUnit;
    }
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = std::max(times[i], other.times[i]);
}

std::vector<std::string> RoughnessFlags::texts() const {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] == 0) continue;
        if (i == kBelowContact) {
            out.push_back(
                fmt::format("{}: {:.3g} to {:.3g} {}", kFlags[i].name, leastForce, mostForce, symbolOf(forceUnit)));
            continue;
        }
        out.push_back(i < kFirstCounted ? kFlags[i].name : fmt::format("{}: {}", kFlags[i].name, times[i]));
    }
    return out;
}

std::string flagSentence(std::string_view text) {
    for (std::size_t i = 0; i < kFlags.size(); ++i) {
        const std::string_view name = kFlags[i].name;
        if (!text.starts_with(name)) continue;
        const auto count = text.substr(name.size());
        if (i == kBelowContact && count.starts_with(": ")) {
            if (auto sentence = belowContactSentence(count.substr(2)); !sentence.empty()) return sentence;
        }
        if (count.empty() && i < kFirstCounted) return kFlags[i].sentence;
        if (!count.starts_with(": ") || i < kFirstCounted) continue;
        return fmt::format("{}: {} {}.", kFlags[i].sentence, count.substr(2), count == ": 1" ? "time" : "times");
    }
    return std::string(text);
}

}  // namespace tacto
