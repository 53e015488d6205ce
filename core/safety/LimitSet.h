// LimitSet.h - limits as data: the values that a standard, an agency or the paper allows, each with its source and our
// confidence in it. Shipped in resources/limits/*.json; safety.md, Limit sets, describes the format.
//
// Thread-safety: plain data and pure functions.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Words.h"
#include "core/safety/FixedText.h"

namespace tacto {

// The quantities of limits (science.md section 7). Each has one unit, used in limit files, exposure tables and
// refusals.

enum class Quantity {
    CommandVoltage,   ///< A of science.md section 4: amplitude of a voltage source, or I·|Z| at the nominal load (V)
    PeakVoltage,      ///< across the load, at most the source's compliance (V)
    PeakCurrent,      ///< (mA)
    PhaseCharge,      ///< the larger |charge| of either phase (µC)
    NetCharge,        ///< |charge| of one pulse, gap and tail included (µC)
    PulseEnergy,      ///< ∫v·i dt of one pulse (mJ)
    RmsCurrentTrain,  ///< over n / intra-train rate (mA); shown, without a limit
    RmsCurrent1s,     ///< worst sliding second (mA)
    RmsCurrent5s,     ///< worst sliding 5 s (mA): the window of every "mA RMS" limit
    RmsVoltage5s,     ///< worst sliding 5 s (V)
    DcCurrent,        ///< |mean current| over 5 s (mA)
    CurrentDensity,   ///< RmsCurrent5s / electrode area (mA/cm²)
    PowerDensity,     ///< power over the worst second / electrode area (W/cm²)
};
inline constexpr std::size_t kQuantityCount = 13;

/// One value per quantity, each in the unit that unitOf() gives.
using QuantityValues = std::array<double, kQuantityCount>;
[[nodiscard]] constexpr std::size_t indexOf(Quantity q) noexcept { return static_cast<std::size_t>(q); }

/// The key in limit files: "rms_current_5s".
[[nodiscard]] std::string_view keyOf(Quantity quantity) noexcept;
/// The title for people: "RMS current over 5 s".
[[nodiscard]] std::string_view titleOf(Quantity quantity) noexcept;
/// "V", "mA", "uC", "mJ", "mA/cm2", "W/cm2": plain ASCII, as in files.
[[nodiscard]] std::string_view unitOf(Quantity quantity) noexcept;
/// The averaging window in seconds; 0 for quantities of one pulse.
[[nodiscard]] double windowOf(Quantity quantity) noexcept;
/// True for the density rows, which are "not evaluated" without an electrode area.
[[nodiscard]] bool needsArea(Quantity quantity) noexcept;
/// Returns nothing for an unknown key.
[[nodiscard]] std::optional<Quantity> quantityOf(std::string_view key) noexcept;

/// The load used to judge a row.
enum class JudgedAt {
    LoadRange,  ///< worst case over the range from load_min to load_max
    Ohm500,     ///< into 500 Ω, for which the standards give their values
};

enum class LimitAction {
    Refuse,    ///< the gate refuses the train
    Warn,      ///< delivered, and shown as a warning (2 mA/cm²)
    Disclose,  ///< delivered; above this the output must be marked or stated (10 mA RMS)
};

[[nodiscard]] std::string_view nameOf(JudgedAt judged) noexcept;     // "load_range", "500_ohm"
[[nodiscard]] std::string_view nameOf(LimitAction action) noexcept;  // "refuse", "warn", "disclose"

struct LimitRow {
    Quantity quantity = Quantity::PeakVoltage;
    double max = 0;       ///< in unitOf(quantity); > 0 and finite
    bool strict = false;  ///< true: a value equal to `max` breaks the limit ("< 10 mA"); false: "≤"
    JudgedAt judged = JudgedAt::LoadRange;
    LimitAction action = LimitAction::Refuse;
    double aboveHz = 0;  ///< the row holds for aboveHz < f ≤ upToHz (f = 0 belongs to the lowest band)
    double upToHz = 0;   ///< 0 = no upper end
    std::string source;  ///< document and clause
    Confidence confidence = Confidence::Low;
    std::string note;  ///< how we read the source, if this needs a note

    /// True if the row holds for a repetition frequency of `hz`.
    [[nodiscard]] bool holdsAt(double hz) const noexcept {
        return (hz > aboveHz || aboveHz == 0) && (upToHz == 0 || hz <= upToHz);
    }
    /// True if `value` keeps the limit. NaN never does.
    [[nodiscard]] bool keeps(double value) const noexcept { return strict ? value < max : value <= max; }
};

/// Accuracy that a set requires of the output; calibration checks it, not the gate.
struct AccuracyRow {
    std::string parameter;     ///< "amplitude", "width", "rate"
    double tolerance_pct = 0;  ///< ± % of the command; 0 = "must be stated", without a value
    std::string source;
    Confidence confidence = Confidence::Low;
};

/// Output that a set requires in the documents; a content of the report, not a limit.
struct DisclosureRow {
    std::string output;  ///< "net charge per pulse at 500 ohm"
    std::string source;
    Confidence confidence = Confidence::Low;
};

struct LimitSet {
    std::string id;  ///< "paper", "iec-60601-2-10", "fda-pms"
    std::string title;
    std::vector<LimitRow> rows;
    std::vector<AccuracyRow> accuracy;
    std::vector<DisclosureRow> disclosures;
};

/// Returns the title of the set with this id, for people; "the encoding profile" for the ceilings of "profile"; the id
/// itself if no set has it.
[[nodiscard]] std::string_view titleOf(std::span<const LimitSet> sets, std::string_view id) noexcept;

/// Returns a title in two words, also for other refusers: "the paper", "this program" for "gate". Returns the id
/// itself if it has none.
[[nodiscard]] std::string_view shortTitleOf(std::string_view id) noexcept;

/// Reads one limit set. Messages use `name` as the file's name. Errors: ParseError, one sentence naming file, row
/// and what is accepted. Never throws, whatever the text.
[[nodiscard]] Result<LimitSet> parseLimitSet(std::string_view json, std::string_view name);

/// The limit of a gate that a train came nearest to: the largest share that it takes of a limit that would refuse it.
/// Trivially copyable.
struct NearestLimit {
    double share = kNaN;  ///< of the limit; NaN: no limit judged the train
    Quantity quantity = Quantity::PeakVoltage;
    FixedText<31> set;  ///< id of the limit set, "profile" for a ceiling
};

// One line of an exposure table: a quantity, its value, and the limit that applies to it.
//
// Never allocates and is trivially copyable: the control loop fills such rows during delivery.

/// The largest number of rows. More limits are refused: a limit missing from all tables would seem to be kept.
inline constexpr std::size_t kMaxExposureRows = 64;

struct ExposureRow {
    Quantity quantity = Quantity::PeakVoltage;
    double value = 0;       ///< in `unit`; meaningless if not evaluated
    double limit = 0;       ///< in `unit`; NaN for a row shown without a limit
    std::string_view unit;  ///< static text, as unitOf(quantity)
    double window_s = 0;    ///< 0 = for one pulse
    FixedText<31> set;      ///< id of the limit set, "profile" for a ceiling; empty without a limit
    LimitAction action = LimitAction::Refuse;
    JudgedAt judged = JudgedAt::LoadRange;
    bool strict = false;     ///< the limit is "<", not "≤"
    bool evaluated = false;  ///< false: shown as "not evaluated", and never a pass (H9)
    bool within = false;     ///< evaluated and within the limit (true without a limit)
    FixedText<95> reason;    ///< why it was not evaluated; otherwise empty
    double measured = kNaN;  ///< in `unit`: the value that an instrument measured; NaN: not measured
    bool beyond = false;     ///< true if the measured value is beyond the source's stated accuracy
};

}  // namespace tacto
