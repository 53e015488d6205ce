// InstrumentProfile.h - what the data sheet of a series of oscilloscopes states: resources/instruments/*.json.
//
// A figure without a source is refused, and one that no source gives is null: unknown (hazard H9). The probe belongs to
// no profile. Where a sheet states a figure by range or by temperature, the profile holds the worst one.
//
//   {"id": "rigol-ds2000", "title": "Rigol DS2000", "makers": ["Rigol"], "models": ["DS2072", "DS21*"],
//    "gain": {"pct": 2, "of": "full scale", "source": "...", "address": "...", "confidence": "medium"},
//    "time_base": {"ppm": 25, "ppm_per_year": 5, "source": "...", "address": "...", "confidence": "medium"}}
//
// Thread-safety: values and pure functions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/Confidence.h"
#include "core/base/Result.h"
#include "core/measure/InstrumentStatement.h"

namespace tacto {

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
    std::string condition{};  ///< under which the sheet states it
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
