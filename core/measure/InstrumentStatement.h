// InstrumentStatement.h - what is stated of an oscilloscope's accuracy, and by whom: science.md section 12.
//
// A figure is stated or unknown (NaN), and unknown is never zero (hazard H9). Statements come from a data sheet
// (resources/instruments), the keys of a device's address, or a certificate of calibration; each overrides those
// before it, figure by figure, and each figure keeps who stated it. What a capture states itself (the twin, a header
// that this program wrote) stays where nothing else is stated.
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

/// Half-widths. A certificate's U (k = 2) counts as a half-width with 95 % inside, U/0.95.
struct ChannelStatement {
    Stated gain;        ///< relative
    Stated offset;      ///< in the channel's unit
    Stated linearity;   ///< share of full scale (high less low): a gain error that is stated of full scale
    Stated probe;       ///< relative, of the probe, or of the shunt on the current channel
    Stated resolution;  ///< one step, in the channel\'s unit
};
struct InstrumentStatement {
    ChannelStatement voltage;
    ChannelStatement current;
    Stated timeBase;  ///< relative
    Stated stamp_s;   ///< how far the stamps of separate records are off against each other
};

/// `over` wins where it states something.
[[nodiscard]] InstrumentStatement merged(const InstrumentStatement& under, const InstrumentStatement& over);

/// Writes what is stated into `capture`: its channels in V take `voltage`, those in A `current`.
void applyStatement(Capture& capture, const InstrumentStatement& statement);

/// What a budget needs and is not stated, for people: "the gain of voltage", "the time base". Empty: all is
/// stated. The offset is not among them: levels are read from their own baseline.
[[nodiscard]] std::vector<std::string> notStated(const Capture& capture);
/// "the oscilloscope does not state the gain of voltage and the time base"; empty where all is stated.
[[nodiscard]] std::string notStatedText(const Capture& capture);

// What the data sheet of a series of oscilloscopes states: resources/instruments/*.json.
//
// A figure without a source is refused, and one that no source gives is null: unknown (hazard H9). The probe belongs to
// no profile. Where a sheet states a figure by range or by temperature, the profile holds the worst one.
//
//   {"id": "rigol-ds2000", "title": "Rigol DS2000", "makers": ["Rigol"], "models": ["DS2072", "DS21*"],
//    "gain": {"pct": 2, "of": "full scale", "source": "...", "address": "...", "confidence": "medium"},
//    "time_base": {"ppm": 25, "ppm_per_year": 5, "source": "...", "address": "...", "confidence": "medium"}}

/// Time bases age and an instrument does not say how old it is: so many years of drift are added to what it had when
/// it was new (choice).
inline constexpr double kYearsOfDrift = 10;

/// One figure of a data sheet. `value` is NaN where no source is known.
struct SheetFigure {
    double value = kNaN;    ///< relative half-width, drift not included
    double perYear = 0;     ///< relative; of the time base alone
    std::string source{};   ///< title of the document, with its page; not empty where `value` is known
    std::string address{};  ///< where the figure was read
    Confidence confidence = Confidence::Low;
    std::string condition{};  ///< the condition under which the sheet states it
};

struct InstrumentProfile {
    std::string id;                   ///< "rigol-ds2000"
    std::string title;                ///< "Rigol DS2000"
    std::vector<std::string> makers;  ///< as the driver reports them
    std::vector<std::string> models;  ///< a final * stands for any ending
    SheetFigure gain;
    bool gainOfFullScale = false;  ///< otherwise of the reading
    SheetFigure timeBase;

    /// Whether `name`, maker and model as DeviceIdentity has them ("Rigol DS2072"), is of this series. Letter case
    /// does not matter.
    [[nodiscard]] bool matches(std::string_view name) const;
    /// Gain and time base, stated by "data sheet of the Rigol DS2000". A gain of full scale is taken of the range that
    /// the capture states, which may be wider than the screen (libsigrok: ten divisions for a screen of eight).
    [[nodiscard]] InstrumentStatement statement() const;
};

/// `source` begins every message. Errors: ParseError as parseJson() and onlyKeys(), or naming the key, its value and
/// what is accepted: a figure is 0 to 50 %, 0 to 100000 ppm, and has a source, an address and a confidence.
[[nodiscard]] Result<InstrumentProfile> parseInstrumentProfile(std::string_view text, std::string_view source);

/// What the first of `profiles` that matches `name` states; nothing is stated where none does.
[[nodiscard]] InstrumentStatement statementOf(const std::vector<InstrumentProfile>& profiles, std::string_view name);

}  // namespace tacto
