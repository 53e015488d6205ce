// InstrumentStatement.h - the stated accuracy of an oscilloscope, and who stated it: science.md section 12.
//
// A figure is stated or unknown (NaN); unknown is never zero (hazard H9). Statements come from a data sheet
// (resources/instruments), the keys of a device's address, or a certificate of calibration. Each of these overrides the
// ones before it, figure by figure, and each figure keeps its source. Figures in a capture itself (from the twin, or a
// header that this program wrote) stay if nothing else is stated.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/base/Statistics.h"
#include "core/base/Words.h"
#include "core/measure/Capture.h"

namespace tacto {

/// One figure with its source. NaN: not stated.
struct Stated {
    double value = kNaN;
    std::string by{};
    [[nodiscard]] bool known() const noexcept;
};

/// Half-widths. The U (k = 2) of a certificate is read as a half-width that contains 95 %: U/0.95.
struct ChannelStatement {
    Stated gain;        ///< relative half-width
    Stated offset;      ///< in the channel's unit
    Stated linearity;   ///< share of full scale (high minus low): a gain error stated relative to full scale
    Stated probe;       ///< relative, of the probe, or of the shunt for a current channel
    Stated resolution;  ///< one step, in the channel's unit
};
struct InstrumentStatement {
    ChannelStatement voltage;
    ChannelStatement current;
    Stated timeBase;  ///< relative half-width
    Stated stamp_s;   ///< largest error between the time stamps of separate records
};

/// Merges two statements, figure by figure. A figure stated in `over` replaces the one in `under`.
[[nodiscard]] InstrumentStatement merged(const InstrumentStatement& under, const InstrumentStatement& over);

/// Writes the stated figures into `capture`: channels in V use `voltage`, channels in A use `current`.
void applyStatement(Capture& capture, const InstrumentStatement& statement);

/// Returns what an uncertainty budget needs but nobody states, for people: "the gain of voltage", "the time base".
/// Empty if all is stated. The offset is not needed, because levels are measured from their own baseline.
[[nodiscard]] std::vector<std::string> notStated(const Capture& capture);
/// Returns "the oscilloscope does not state the gain of voltage and the time base", or an empty text if all is stated.
[[nodiscard]] std::string notStatedText(const Capture& capture);

// A profile holds the data sheet figures of a series of oscilloscopes: resources/instruments/*.json.
//
// A figure without a source is refused. A figure that no source gives is null: unknown (hazard H9). Probes are not in
// profiles. If a sheet states several figures, by range or temperature, the profile holds the worst.
//
//   {"id": "rigol-ds2000", "title": "Rigol DS2000", "makers": ["Rigol"], "models": ["DS2072", "DS21*"],
//    "gain": {"pct": 2, "of": "full scale", "source": "...", "address": "...", "confidence": "medium"},
//    "time_base": {"ppm": 25, "ppm_per_year": 5, "source": "...", "address": "...", "confidence": "medium"}}

/// Years of drift to add to the accuracy when new (our choice): a time base ages, and its age is unknown.
inline constexpr double kYearsOfDrift = 10;

/// One figure of a data sheet. `value` is NaN if no source is known.
struct SheetFigure {
    double value = kNaN;    ///< relative half-width, without drift
    double perYear = 0;     ///< relative; for the time base only
    std::string source{};   ///< title and page of the document; not empty if `value` is known
    std::string address{};  ///< web address at which the figure was read
    Confidence confidence = Confidence::Low;
    std::string condition{};  ///< condition under which the sheet states the figure
};

struct InstrumentProfile {
    std::string id;                   ///< "rigol-ds2000"
    std::string title;                ///< "Rigol DS2000"
    std::vector<std::string> makers;  ///< names as the driver reports them
    std::vector<std::string> models;  ///< model names; a final * stands for any ending
    SheetFigure gain;
    bool gainOfFullScale = false;  ///< true: gain relative to full scale; false: to the reading
    SheetFigure timeBase;

    /// Returns whether `name` belongs to this series. It holds maker and model as in DeviceIdentity ("Rigol DS2072");
    /// letter case does not matter.
    [[nodiscard]] bool matches(std::string_view name) const;
    /// Returns gain and time base, stated by "data sheet of the Rigol DS2000". A gain of full scale refers to the range
    /// in the capture, which may be wider than the screen (libsigrok: ten divisions for a screen of eight).
    [[nodiscard]] InstrumentStatement statement() const;
};

/// `source` begins every message. Errors: ParseError as in parseJson() and onlyKeys(), or naming the key, its value and
/// what is accepted: a figure is 0 to 50 %, 0 to 100000 ppm, and has a source, an address and a confidence.
[[nodiscard]] Result<InstrumentProfile> parseInstrumentProfile(std::string_view text, std::string_view source);

/// Returns the statement of the first profile that matches `name`, or an empty statement if none does.
[[nodiscard]] InstrumentStatement statementOf(const std::vector<InstrumentProfile>& profiles, std::string_view name);

}  // namespace tacto
