// EncodingProfile.h - the data that map roughness and pressure to amplitude and interval.
//
// The `encoding` section of a profile file. The defaults are the paper's values (science.md section 4).
//
// Thread-safety: a plain value; constant while the bench runs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/encoding/PulseTrain.h"

namespace tacto {

template <class Record>
class RecordFields;

enum class CurveKind { Linear, Logarithmic, Power };
[[nodiscard]] std::string_view nameOf(CurveKind curve) noexcept;  // "linear", "logarithmic", "power"

/// The shape of the transition from one end of a range (x = 0) to the other (x = 1).
struct Curve {
    CurveKind kind = CurveKind::Linear;
    double beta = 1.5;  ///< only for Power: from + (to − from)·x^(1/β)
    /// `x` is in 0..1. Logarithmic: from·(to/from)^x, with both ends > 0. Exact at x = 0 and x = 1.
    [[nodiscard]] double at(double x, double from, double to) const noexcept;
    bool operator==(const Curve&) const = default;
};

/// Which input controls which output.
enum class Assignment {
    TextureToAmplitude,  ///< R → amplitude, P → interval (the paper's choice)
    Swapped,             ///< P → amplitude, R → interval (the paper's theoretical section)
};
[[nodiscard]] std::string_view nameOf(Assignment assignment) noexcept;  // "texture_to_amplitude", "swapped"

/// The quantity kept at its encoded value when the load's |Z| changes during delivery, within the gate's limits.
/// Commands refer to the |Z| measured when the output was armed.
enum class Hold {
    Voltage,  ///< the amplitude A
    Charge,   ///< per phase: A follows |Z|
    Energy,   ///< per pulse: A follows √|Z|
};
[[nodiscard]] std::string_view nameOf(Hold hold) noexcept;  // "voltage", "charge", "energy"

/// A named point of the R–P plane.
struct Condition {
    std::string name;
    double R = 0;
    double P = 0;
    bool operator==(const Condition&) const = default;
};

struct EncodingProfile {
    Volts amplitudeMin{10};
    Volts amplitudeMax{40};
    Seconds intervalMin{0.5};
    Seconds intervalMax{2};
    Curve amplitudeCurve;
    Curve intervalCurve;
    Assignment assignment = Assignment::TextureToAmplitude;
    PulseTrain train;  ///< the pulse train, except for its amplitude
    /// Limits on the step from one train to the next; 0 = no limit. The shipped profile sets the two ratios, each just
    /// below two just-noticeable differences (resources/encodings/default.json). A profile without limits has none.
    double amplitudeRatioPerTrain = 0;  ///< largest factor up or down from the previous amplitude; 0, or > 1
    double intervalRatioPerTrain = 0;   ///< largest factor up or down from the previous interval; 0, or > 1
    double amplitudeSlew_V_per_s = 0;   ///< largest rate of change of the amplitude between two trains
    Hold hold = Hold::Voltage;
    std::vector<Condition> conditions = fourConditions(0, 1);

    /// smooth-low, smooth-high, rough-low, rough-high with R and P at `low` and `high`.
    [[nodiscard]] static std::vector<Condition> fourConditions(double low, double high);
    /// Returns the condition with that name, or null.
    [[nodiscard]] const Condition* condition(std::string_view name) const noexcept;
    /// True if the step to the next train has a limit.
    [[nodiscard]] bool movesInSteps() const noexcept {
        return amplitudeRatioPerTrain > 0 || intervalRatioPerTrain > 0 || amplitudeSlew_V_per_s > 0;
    }
    bool operator==(const EncodingProfile&) const = default;
};

/// Returns the fields of a profile's `encoding` section, each with its accepted values.
[[nodiscard]] const RecordFields<EncodingProfile>& encodingFields();
/// Errors: InvalidArgument naming the field, its value and what is accepted (for example n/rate < T_min).
[[nodiscard]] Result<void> validate(const EncodingProfile& profile);
/// Reads the section; missing keys keep their defaults. Errors: as RecordFields::read().
[[nodiscard]] Result<EncodingProfile> encodingProfileFrom(const nlohmann::json& section);
/// Writes the section, so that reading it gives the same profile.
[[nodiscard]] nlohmann::json toJson(const EncodingProfile& profile);

}  // namespace tacto
