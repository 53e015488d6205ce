// EncodingProfile.h - how roughness and pressure become amplitude and interval: data, never code.
//
// The `encoding` section of a profile file. Defaults are the paper's (science.md section 4).
//
// Thread-safety: a value; constant while the bench runs.
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

/// The course from one end of a range (x = 0) to the other (x = 1).
struct Curve {
    CurveKind kind = CurveKind::Linear;
    double beta = 1.5;  ///< Power only: from + (to − from)·x^(1/β)
    /// `x` in 0..1; both ends > 0 for Logarithmic: from·(to/from)^x. Exact at x = 0 and x = 1.
    [[nodiscard]] double at(double x, double from, double to) const noexcept;
    bool operator==(const Curve&) const = default;
};

/// Which input drives which output.
enum class Assignment {
    TextureToAmplitude,  ///< R → amplitude, P → interval (the paper's)
    Swapped,             ///< P → amplitude, R → interval (the paper's theoretical section)
};
[[nodiscard]] std::string_view nameOf(Assignment assignment) noexcept;  // "texture_to_amplitude", "swapped"

/// What keeps its encoded value when the load's |Z| changes during delivery, within the gate's limits. The commands
/// belong to the |Z| that was measured when the output was armed.
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
    PulseTrain train;  ///< everything but its amplitude
    /// Limits on the step from a train to the next; 0 = no limit. The shipped profile has the two ratios, just below
    /// two just-noticeable differences each (resources/encodings/default.json); a profile that names none has none.
    double amplitudeRatioPerTrain = 0;  ///< at most this times (or 1/this of) the amplitude before; else > 1
    double intervalRatioPerTrain = 0;   ///< at most this times (or 1/this of) the interval before; else > 1
    double amplitudeSlew_V_per_s = 0;   ///< largest change of the amplitude over the time between the trains
    Hold hold = Hold::Voltage;
    std::vector<Condition> conditions = fourConditions(0, 1);

    /// smooth-low, smooth-high, rough-low, rough-high with R and P at `low` and `high`.
    [[nodiscard]] static std::vector<Condition> fourConditions(double low, double high);
    /// Null if none has that name.
    [[nodiscard]] const Condition* condition(std::string_view name) const noexcept;
    /// The step to the next train has a limit.
    [[nodiscard]] bool movesInSteps() const noexcept {
        return amplitudeRatioPerTrain > 0 || intervalRatioPerTrain > 0 || amplitudeSlew_V_per_s > 0;
    }
    bool operator==(const EncodingProfile&) const = default;
};

/// The `encoding` section of a profile: every key with what it accepts.
[[nodiscard]] const RecordFields<EncodingProfile>& encodingFields();
/// Errors: InvalidArgument naming the field, its value and what is accepted (among them n/rate < T_min).
[[nodiscard]] Result<void> validate(const EncodingProfile& profile);
/// Reads the section; a missing key keeps its default. Errors: as RecordFields::read().
[[nodiscard]] Result<EncodingProfile> encodingProfileFrom(const nlohmann::json& section);
/// The section that reads back to the same profile.
[[nodiscard]] nlohmann::json toJson(const EncodingProfile& profile);

}  // namespace tacto
