// LimitSet.h - limits as data: what a standard, an agency or the paper allows, each figure with its source
// and with how sure we are of it. Shipped in resources/limits/*.json; safety.md, Limit sets, describes the format.
//
// Thread-safety: plain data and pure functions.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Confidence.h"
#include "core/base/Result.h"
#include "core/safety/Quantity.h"

namespace tacto {

/// Where a row is judged.
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
    /// Whether `value` keeps the limit. NaN never does.
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

/// For people: the title of the set with this id, "the encoding profile" for the ceilings of "profile", the id itself
/// where no set has it.
[[nodiscard]] std::string_view titleOf(std::span<const LimitSet> sets, std::string_view id) noexcept;

/// The same in two words, and who else refuses: "the paper", "this program" for "gate". The id itself where there are
/// none.
[[nodiscard]] std::string_view shortTitleOf(std::string_view id) noexcept;

/// Reads one limit set. `name` stands in messages for the file's name.
/// Errors: ParseError, one sentence naming file, row and what would be accepted. Never throws, whatever the text.
[[nodiscard]] Result<LimitSet> parseLimitSet(std::string_view json, std::string_view name);

}  // namespace tacto
