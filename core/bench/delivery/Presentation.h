// Presentation.h - one presentation of a pilot session: trains of the profile's own kind at given onsets, all at one
// level or, to be compared, each at its own; and what became of it. Bench::present() carries it out.
//
// An empty presentation has the level 0: its onsets pass and nothing is delivered at them. It takes the same time, asks
// the same of the bench and is recorded as any other, but for the rows of trains.
//
// Thread-safety: values; pure functions.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/Result.h"
#include "core/encoding/PulseTrain.h"

namespace tacto {

/// Strength of a massager in place of the electrodes, 0..1.
struct VibrationIntensity {
    double value = 0;
    bool operator==(const VibrationIntensity&) const = default;
};
/// 0 of either is an empty presentation. A current lies on the device's grid.
using StimulusLevel = std::variant<Milliamps, VibrationIntensity>;
[[nodiscard]] bool isEmpty(const StimulusLevel& level) noexcept;
[[nodiscard]] std::string textOf(const StimulusLevel& level);  // "4.5 mA", "intensity 0.4"

struct Presentation {
    StimulusLevel level = Milliamps(0);  ///< every train's level; where `levels` says otherwise, the highest of those
    std::vector<Seconds> onsets{};       ///< from the beginning, ascending, at least `interval` apart; 1 to kMaxTrains
    Seconds interval{0};   ///< > 0, that each train is judged at: the shortest at which another may follow
    Seconds duration{0};   ///< the whole presentation, at least kTail after the last onset, at most kLongest
    Instant notBefore{0};  ///< by the bench's clock: it begins then, or as soon after as the bench is ready
    std::vector<StimulusLevel> levels{};  ///< one for each onset, none of them empty; empty: all at `level`
    /// `train` < onsets.size().
    [[nodiscard]] const StimulusLevel& levelOf(std::size_t train) const noexcept {
        return levels.empty() ? level : levels[train];
    }

    static constexpr std::size_t kMaxTrains = 64;
    static constexpr Seconds kLongest{60};
    static constexpr Seconds kTail{0.2};  ///< room for the last train and its status
    bool operator==(const Presentation&) const = default;
};

/// Trains every `interval` from 0 as long as they fall into `window`; ends kTail after the window, whatever the
/// interval.
[[nodiscard]] Presentation testPresentation(StimulusLevel level, Seconds interval, Seconds window = Seconds(4));
/// Three trains at `interval`, the shortest of the study.
[[nodiscard]] Presentation ascendingPresentation(StimulusLevel level, Seconds interval);
/// Two intervals of 0.8 s, 0.6 s apart; one train, of `trainLength`, in the middle of the first or the second. It is
/// judged at `interval`.
[[nodiscard]] Presentation detectionPresentation(StimulusLevel level, bool inSecond, Seconds trainLength,
                                                 Seconds interval);
/// Two intervals with a train in each, to be compared: `first` in the first, `second` in the second. Both are above 0
/// and of one kind.
[[nodiscard]] Presentation comparisonPresentation(StimulusLevel first, StimulusLevel second, Seconds trainLength,
                                                  Seconds interval);
/// Which of its two intervals passes that long after its beginning: 1 or 2; 0 before the first and between them. The
/// second lasts until the presentation has ended.
[[nodiscard]] int detectionIntervalAt(Seconds since) noexcept;

/// Errors: InvalidArgument naming the value and what is accepted: NaN and negative levels, an intensity above 1, onsets
/// that do not ascend or come nearer than the interval, a duration that is too short or too long; levels of another
/// kind or number, an empty one among them, and a highest that is not `level`. The device's grid is the bench's matter.
[[nodiscard]] Result<void> validate(const Presentation& presentation);

/// How a presentation ended. Every end but Complete makes it void.
enum class PresentationEnd {
    Complete,  ///< every train was delivered and judged good, or there was none to deliver
    Refused,   ///< the gate refused a train; nothing more was delivered
    Stopped,   ///< a stop came, or the output was disarmed
    Paused,    ///< the output was paused
    Faulted,   ///< the device, the electrodes or the loop failed
    Late,      ///< a train could not begin within kLatest of its onset
};
[[nodiscard]] std::string_view nameOf(PresentationEnd end) noexcept;  // "complete", "refused", ...

struct PresentedTrain {
    Instant onset{0};                       ///< when it was written to the device, on the bench's clock
    StimulusLevel approved = Milliamps(0);  ///< as programmed
    std::optional<Milliamps> readBack{};    ///< nothing where the device does not read back
    Seconds interval{0};                    ///< the interval that it was approved for
    std::optional<Ohms> impedance{};        ///< |Z|, read back with it
    bool operator==(const PresentedTrain&) const = default;
};

struct Presented {
    /// Later than that after its onset a train is not sent: a tenth of the shortest interval of the paper (choice).
    static constexpr Instant kLatest = std::chrono::milliseconds(50);

    PresentationEnd end = PresentationEnd::Stopped;
    std::string reason;  ///< one sentence; empty when complete
    Instant began{0};    ///< its onsets count from here; never before `notBefore`; meaningless if it never began
    Instant ended{0};
    std::vector<PresentedTrain> trains;  ///< trains delivered and read before its end, those of a void one included
    std::optional<Ohms> impedance;       ///< the last reading of |Z|, even from before it; nothing without one
    [[nodiscard]] bool isVoid() const noexcept { return end != PresentationEnd::Complete; }
};

}  // namespace tacto
