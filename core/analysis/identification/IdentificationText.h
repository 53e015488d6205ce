// IdentificationText.h - writes the opening sentences of identification results.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "core/analysis/identification/Identification.h"
#include "core/base/Units.h"

namespace tacto {

/// The range of the presented conditions: a current with its voltage, or a massager's intensity.
struct PresentedRange {
    std::optional<Milliamps> low, high;
    Volts lowVoltage{kNaN}, highVoltage{kNaN};  ///< at `impedance`
    Ohms impedance{kNaN};
    std::optional<double> lowIntensity, highIntensity;  ///< 0 to 1
};

/// Returns "14 to 22 V" or "0.62 to 0.95 V": both numbers get the decimals that give the smaller one two digits.
[[nodiscard]] std::string voltageRangeText(Volts low, Volts high);

/// Returns "P-7K3M told the four apart in 68 of 80 trials (85 %, 95 % interval 76 to 91 %, chance 25 %) between 4.0 and
/// 6.5 mA, 14 to 22 V at 3.4 kΩ." Unknown parts are left out. Without trials: "P-7K3M answered no test trial."
[[nodiscard]] std::string headline(const std::string& name, const Identification& found, const PresentedRange& range);

/// Returns the wording of a condition or answer for people: "rough, firm" for "rough-high", "not sure" for "not-sure".
/// Other names are unchanged.
[[nodiscard]] std::string answerWords(std::string_view key);

/// Returns "0.012", "< 0.001" for smaller values, or "–" for an unknown value.
[[nodiscard]] std::string chanceText(double p);

/// Returns "1.94 (1.72 to 2.00)": the corrected information and its 95 % interval in bits; "–" if unknown.
[[nodiscard]] std::string bitsText(const Estimate& bits);

/// Returns "80 trials: ± 8 % at 85 %, ± 11 % at 50 %; 27 right of 80 is above chance."; `n` ≥ 1.
[[nodiscard]] std::string precisionSentence(std::size_t n, double chance);

}  // namespace tacto
