// LimitSet.h - limits as data: what a standard, an agency or the paper allows, each figure with its source
// and with how sure we are of it. Shipped in resources/limits/*.json; safety.md, Limit sets, describes the format.
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

// The quantities that limits are written in (science.md section 7), each with the one unit in
// which limit files, exposure tables and refusals give it.

enum class Quantity {
    CommandVoltage,   ///< A of section 4: a voltage source's amplitude, or I·|Z| at the nominal load (V)
    PeakVoltage,      ///< across the load, capped by the source's compliance (V)
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

/// One value per quantity, each in unitOf() its quantity.
using QuantityValues = std::array<double, kQuantityCount>;
[[nodiscard]] constexpr std::size_t indexOf(Quantity q) noexcept { return static_cast<std::size_t>(q); }

/// The key in limit files: "rms_current_5s".
[[nodiscard]] std::string_view keyOf(Quantity quantity) noexcept;
/// The title that people read: "RMS current over 5 s".
[[nodiscard]] std::string_view titleOf(Quantity quantity) noexcept;
/// "V", "mA", "uC", "mJ", "mA/cm2", "W/cm2": plain ASCII, as in files.
[[nodiscard]] std::string_view unitOf(Quantity quantity) noexcept;
/// The averaging window in seconds; 0 for quantities of one pulse.
[[nodiscard]] double windowOf(Quantity quantity) noexcept;
/// True for the density rows, which without an electrode area read "not evaluated".
[[nodiscard]] bool needsArea(Quantity quantity) noexcept;
/// Nothing for an unknown key.
[[nodiscard]] std::optional<Quantity> quantityOf(std::string_view key) noexcept;

/// The load on which a row is judged.
enum class JudgedAt {
    LoadRange,  ///< worst case between load_min and load_max
    Ohm500,     ///< into 500 Ω, as the standards state their figures
};

enum class LimitAction {
    Refuse,    ///< the gate refuses
    Warn,      ///< delivered; shown as a warning (2 mA/cm²)
    Disclose,  ///< delivered; the output must be marked or stated above this (10 mA RMS)
};

[[nodiscard]] std::string_view nameOf(JudgedAt judged) noexcept;     // "load_range", "500_ohm"
[[nodiscard]] std::string_view nameOf(LimitAction action) noexcept;  // "refuse", "warn", "disclose"

struct LimitRow {
    Quantity quantity = Quantity::PeakVoltage;
    double max = 0;       ///< in unitOf(quantity); > 0 and finite
    bool strict = false;  ///< true: a value equal to `max` already breaks it ("< 10 mA"); false: "≤"
    JudgedAt judged = JudgedAt::LoadRange;
    LimitAction action = LimitAction::Refuse;
    double aboveHz = 0;  ///< the row holds for aboveHz < f ≤ upToHz (f = 0 belongs to the lowest band)
    double upToHz = 0;   ///< 0 = no upper end
    std::string source;  ///< document and clause
    Confidence confidence = Confidence::Low;
    std::string note;  ///< our reading of it, where there is one

    /// True where the row holds for a repetition frequency of `hz`.
    [[nodiscard]] bool holdsAt(double hz) const noexcept {
        return (hz > aboveHz || aboveHz == 0) && (upToHz == 0 || hz <= upToHz);
    }
    /// Whether `value` keeps the limit. NaN never keeps it.
    [[nodiscard]] bool keeps(double value) const noexcept { return strict ? value < max : value <= max; }
};

/// Accuracy that a set asks of the output; judged by calibration, not by the gate.
struct AccuracyRow {
    std::string parameter;     ///< "amplitude", "width", "rate"
    double tolerance_pct = 0;  ///< ± % of the command; 0 = "must be stated", no figure
    std::string source;
    Confidence confidence = Confidence::Low;
};

/// Output that a set asks to be stated in the documents; the report's table of contents, not a limit.
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

/// The title that people read of the set with this id, "the encoding profile" for the ceilings of "profile", the id
/// itself where no set has it.
[[nodiscard]] std::string_view titleOf(std::span<const LimitSet> sets, std::string_view id) noexcept;

/// The title in two words, also of others who refuse: "the paper", "this program" for "gate". The id itself where there
/// is none.
[[nodiscard]] std::string_view shortTitleOf(std::string_view id) noexcept;

/// Reads one limit set. `name` stands in messages for the file's name. Errors: ParseError, one sentence naming file,
/// row and what would be accepted. Never throws, whatever the text.
[[nodiscard]] Result<LimitSet> parseLimitSet(std::string_view json, std::string_view name);

// One line of an exposure table: a quantity, its value, and the limit it is held against.
//
// Never allocates and is trivially copyable: the control loop fills these while delivering.

/// The most rows of a table. A setup with more limits is refused: a limit that no table shows would seem to be kept.
inline constexpr std::size_t kMaxExposureRows = 64;

struct ExposureRow {
    Quantity quantity = Quantity::PeakVoltage;
    double value = 0;       ///< in `unit`; meaningless when not evaluated
    double limit = 0;       ///< in `unit`; NaN for a row that is shown without a limit
    std::string_view unit;  ///< static text, as unitOf(quantity)
    double window_s = 0;    ///< 0 = of one pulse
    FixedText<31> set;      ///< id of the limit set, "profile" for a ceiling; empty without a limit
    LimitAction action = LimitAction::Refuse;
    JudgedAt judged = JudgedAt::LoadRange;
    bool strict = false;     ///< the limit is "<", not "≤"
    bool evaluated = false;  ///< false: reads "not evaluated", and is never a pass (H9)
    bool within = false;     ///< evaluated and within the limit (true without a limit)
    FixedText<95> reason;    ///< why it was not evaluated, else empty
    double measured = kNaN;  ///< in `unit`: what an instrument showed of what was set; NaN: no instrument did
    bool beyond = false;     ///< the measured value lies beyond the source's stated accuracy
};

}  // namespace tacto
