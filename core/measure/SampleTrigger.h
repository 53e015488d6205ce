// SampleTrigger.h - triggers that are searched for in the samples of a record, by software: an edge, the width of a
// pulse, a runt; and a hold-off. They see what the oscilloscope recorded, and nothing between two records.
//
// Definitions. A signal *exceeds* a level from the sample at which it reaches the level, after a sample below level -
// hysteresis, until its next sample below level - hysteresis. Begin and end are where the straight line between two
// samples crosses the level: the first such place, and the last one before the end. A missing sample (not finite) ends
// what was going on, unjudged, and the signal must be seen below again. Falling edges and negative pulses are those of
// the signal turned upside down.
//
// Thread-safety: pure functions; SampleTriggerSearch has one owner.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Words.h"
#include "core/measure/Capture.h"

namespace tacto {

enum class TriggerKind {
    Magnitude,  ///< the oscilloscope's own trigger: |signal| rises through the level
    Slope,      ///< the signal crosses the level
    Width,      ///< a pulse beyond the level ends, and its width is one that triggers
    Runt        ///< a pulse beyond the first threshold ends without having reached the second
};
/// For pulses Rising means positive and Falling negative.
enum class TriggerEdge { Rising, Falling, Either };
/// Which widths trigger: those within both limits, beyond either, up to the longer, or from the shorter one on.
enum class WidthRule { Inside, Outside, Less, Greater };
inline constexpr Word<WidthRule> kWidthRules[] = {{"inside", WidthRule::Inside},
                                                  {"outside", WidthRule::Outside},
                                                  {"less", WidthRule::Less},
                                                  {"greater", WidthRule::Greater}};

struct SampleTrigger {
    TriggerKind kind = TriggerKind::Magnitude;
    TriggerEdge edge = TriggerEdge::Rising;
    double level = 0.5;     ///< V or A; for a runt the lower threshold
    double upper = 1;       ///< V or A; for a runt the upper threshold
    double hysteresis = 0;  ///< V or A, 0 or more
    WidthRule widths = WidthRule::Inside;
    double shortest_s = 0;    ///< width of a pulse; both limits are inside
    double longest_s = 1e-3;  ///< may be infinite
    double holdOff_s = 0;     ///< no trigger sooner than this after the last one
    bool operator==(const SampleTrigger&) const = default;
};

/// One setting of a kind beside its level, as forms show it, files keep it and refusals name it.
struct TriggerField {
    std::string_view key;
    std::string_view title;
    bool isTime = false;  ///< in seconds; otherwise in the unit of the signal
    double least = 0;     ///< for a level: as a share of the channel's full scale
    double most = 0;
    std::string_view tip{};
    double SampleTrigger::*value = nullptr;
};
struct TriggerKindInfo {
    TriggerKind kind = TriggerKind::Magnitude;
    std::string_view key;
    std::string_view title;
    std::string_view level;                    ///< what its level is called
    std::span<const Word<TriggerEdge>> edges;  ///< the words for what it may look for; empty: nothing to choose
    std::vector<TriggerField> fields;          ///< the last one is the hold-off
    std::string_view tip;
};
/// All kinds, in the order in which they are offered.
[[nodiscard]] std::span<const TriggerKindInfo> triggerKinds();
[[nodiscard]] const TriggerKindInfo& infoOf(TriggerKind kind);

/// False for a limit that the rule of widths does not ask for.
[[nodiscard]] bool uses(const SampleTrigger& trigger, const TriggerField& field);
/// True if the program searches for this trigger in the samples; false: it is the oscilloscope's own.
[[nodiscard]] constexpr bool searched(TriggerKind kind) noexcept { return kind != TriggerKind::Magnitude; }

/// Errors: InvalidArgument with the field, its value and what is accepted. `fullScale` is the channel's, in `unit`.
[[nodiscard]] Result<void> checkTrigger(const SampleTrigger& trigger, double fullScale, std::string_view unit);

/// Returns where the record triggers, in samples from its first one, in ascending order; the hold-off is not applied.
/// For the oscilloscope's own trigger: where the magnitude rises through the level. A clipped sample counts as having
/// reached every threshold: a clipped pulse is no runt.
[[nodiscard]] std::vector<double> triggersIn(const CaptureChannel& channel, double rate_hz,
                                             const SampleTrigger& trigger);

/// Searches the records of one oscilloscope, in their order.
class SampleTriggerSearch {
public:
    /// Looks from now on in the first channel in `unit`. What take() returns has `samples` samples, `preTrigger` (0..1)
    /// of them before the trigger; it is shorter if a record is. A hold-off goes on.
    void set(const SampleTrigger& trigger, std::string_view unit, std::size_t samples, double preTrigger);
    /// Ends a hold-off: the next record has another time base.
    void forget() noexcept { last_s_ = -std::numeric_limits<double>::infinity(); }

    /// Returns the part of the record around its first trigger that has room before and after it and is not held off;
    /// without one, the middle of the record, marked as untriggered. For the oscilloscope's own trigger the whole
    /// record, marked as untriggered if it is held off. Null stays null.
    [[nodiscard]] std::shared_ptr<const Capture> take(std::shared_ptr<const Capture> record);

private:
    /// A time before the last trigger is of another time base, and is not held off; NaN is.
    [[nodiscard]] bool heldOff(double at_s) const noexcept {
        return !(at_s < last_s_ || at_s >= last_s_ + trigger_.holdOff_s);
    }

    SampleTrigger trigger_;
    std::string unit_;
    std::size_t samples_ = std::numeric_limits<std::size_t>::max();
    double preTrigger_ = 0;
    double last_s_ = -std::numeric_limits<double>::infinity();  // the last trigger, on the session's time base
};

}  // namespace tacto
