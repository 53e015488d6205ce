// Cells.h - words and numbers of results, as written in sentences and captions.
//
// Thread-safety: pure functions.
#pragma once

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/QuantityText.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto::host::report {

using Json = nlohmann::json;

/// Returns the value with this many significant digits, with zeros at the end; "–" if it is not known. Whole numbers of
/// up to six digits are written out: 1010, not 1.01e+3.
[[nodiscard]] inline std::string digitsOf(double value, int digits) {
    if (!std::isfinite(value)) return "–";
    const auto scientific = fmt::format("{:.{}e}", value, digits - 1);
    const int exponent = decimalExponent(value, digits);
    if (exponent >= digits && exponent < 6) return fmt::format("{:.0f}", *parseNumber(scientific));
    if (exponent < -6 || exponent >= digits)
        return fmt::format("{}e{:+}", scientific.substr(0, scientific.find('e')), exponent);
    return decimalText(value, digits - 1 - exponent);
}

/// Returns an empty list if it is missing or null.
[[nodiscard]] inline const Json& listIn(const Json& row, const char* key) {
    static const Json kNone = Json::array();
    const auto at = row.find(key);
    return at != row.end() && at->is_array() ? *at : kNone;
}

/// Returns "Amplitude" for "amplitude", "Phase width" for "width".
[[nodiscard]] inline std::string titleOfQuantity(const std::string& quantity) {
    const auto* known = calibratedQuantity(quantity);
    return known != nullptr ? std::string(known->title) : quantity;
}

/// Returns a load as people write it: "200 Ω + 10 kΩ ∥ 50 nF".
[[nodiscard]] inline std::string writtenLoad(std::string load) {
    const auto replaceAll = [&load](std::string_view from, std::string_view to) {
        for (auto at = load.find(from); at != std::string::npos; at = load.find(from, at + to.size()))
            load.replace(at, from.size(), to);
    };
    replaceAll("ohm", "Ω");
    replaceAll("||", "∥");
    return load;
}

}  // namespace tacto::host::report
