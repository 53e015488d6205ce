// Presentation.h - one presentation of a pilot session: trains of the profile's kind at given onsets, all at one level
// or, for a comparison, each at its own; and its result. Bench::present() carries it out.
//
// An empty presentation has the level 0: its onsets pass and nothing is delivered. It takes as long, needs the same of
// the bench and is recorded like any other, except that it has no rows of trains.
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

/// Strength of a massager that replaces the electrodes, 0..1.
struct VibrationIntensity {
    double value = 0;
    bool operator==(const VibrationIntensity&) const = default;
};
/// A level; 0 means an empty presentation. A current must lie on the device's grid.
using StimulusLevel = std::variant<Milliamps, VibrationIntensity>;
[[nodiscard]] bool isEmpty(const StimulusLevel& level) noexcept;
[[nodiscard]] std::string textOf(const StimulusLevel& level);  // "4.5 mA", "intensity 0.4"

struct Presentation {
    StimulusLevel level = Milliamps(0);  ///< level of every train; with `levels`, the highest of them
    std::vector<Seconds> onsets{};       ///< from the beginning, ascending, at least `interval` apart; 1 to kMaxTrains
    Seconds interval{0};                 ///< > 0; the shortest time to the next train, used to judge each train
    Seconds duration{0};   ///< the whole presentation, at least kTail after the last onset, at most kLongest
    Instant notBefore{0};  ///< on the bench's clock: begins then, or later once the bench is ready
    std::vector<StimulusLevel> levels{};  ///< one per onset, none of them 0; if empty, all trains use `level`
    /// Requires `train` < onsets.size().
    [[nodiscard]] const StimulusLevel& levelOf(std::size_t train) const noexcept {
        return levels.empty() ? level : levels[train];
    }

    static constexpr std::size_t kMaxTrains = 64;
    static constexpr Seconds kLongest{60};
    static constexpr Seconds kTail{0.2};  ///< room for the last train and its status
    bool operator==(const Presentation&) const = default;
};

/// Trains at every `interval` from 0 to the end of `window`. The presentation ends kTail after the window, whatever the
/// interval.
[[nodiscard]] Presentation testPresentation(StimulusLevel level, Seconds interval, Seconds window = Seconds(4));
/// Three trains, one every `interval`, which is the shortest of the study.
[[nodiscard]] Presentation ascendingPresentation(StimulusLevel level, Seconds interval);
/// Two intervals of 0.8 s, 0.6 s apart, and one train of length `trainLength` in the middle of the first or second. The
/// gate judges the train with `interval`.
[[nodiscard]] Presentation detectionPresentation(StimulusLevel level, bool inSecond, Seconds trainLength,
                                                 Seconds interval);
/// Two intervals with one train in each, for a comparison: `first` in the first, `second` in the second. Both levels
/// are above 0 and of the same kind.
[[nodiscard]] Presentation comparisonPresentation(StimulusLevel first, StimulusLevel second, Seconds trainLength,
                                                  Seconds interval);
/// Returns which of the two intervals is passing at `since` after the beginning: 1 or 2; 0 before the first and between
/// them. The second lasts until the presentation has ended.
[[nodiscard]] int detectionIntervalAt(Seconds since) noexcept;

/// Errors: InvalidArgument naming the value and what is accepted, for a NaN or negative level, an intensity above 1,
/// onsets that do not ascend or are closer than the interval, a too short or long duration, `levels` of a wrong kind or
/// number, a 0 among them, or a highest that is not `level`. The bench checks the device's grid.
[[nodiscard]] Result<void> validate(const Presentation& presentation);

/// How a presentation ended. Every end except Complete makes the presentation void.
enum class PresentationEnd {
    Complete,  ///< every train was delivered and judged good, or none was to be delivered
    Refused,   ///< the gate refused a train; nothing more was delivered
    Stopped,   ///< a stop came, or the output was disarmed
    Paused,    ///< the output was paused
    Faulted,   ///< the device, the electrodes or the loop failed
    Late,      ///< a train could not begin within kLatest of its onset
};
[[nodiscard]] std::string_view nameOf(PresentationEnd end) noexcept;  // "complete", "refused", ...

struct PresentedTrain {
    Instant onset{0};                       ///< when the train was written to the device, on the bench's clock
    StimulusLevel approved = Milliamps(0);  ///< the level as programmed
    std::optional<Milliamps> readBack{};    ///< nothing if the device does not read back
    Seconds interval{0};                    ///< the interval for which it was approved
    std::optional<Ohms> impedance{};        ///< |Z|, read back with the train
    bool operator==(const PresentedTrain&) const = default;
};

struct Presented {
    /// A train is not sent later than this after its onset: a tenth of the paper's shortest interval (choice).
    static constexpr Instant kLatest = std::chrono::milliseconds(50);

    PresentationEnd end = PresentationEnd::Stopped;
    std::string reason;  ///< one sentence; empty if complete
    Instant began{0};    ///< time 0 of the onsets; never before `notBefore`; meaningless if it never began
    Instant ended{0};
    std::vector<PresentedTrain> trains;  ///< trains delivered and read before the end, even if void
    std::optional<Ohms> impedance;       ///< last reading of |Z|, even from before the beginning; nothing without one
    [[nodiscard]] bool isVoid() const noexcept { return end != PresentationEnd::Complete; }
};

}  // namespace tacto
