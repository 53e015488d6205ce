// CalibratedQuantity.h - the quantities that a stimulator is calibrated in: what files, scripts and people call them.
//
// Thread-safety: constants; a pure function.
#pragma once

#include <array>
#include <string_view>

namespace tacto {

struct CalibratedQuantity {
    std::string_view id;       ///< in files, scripts and results
    std::string_view reading;  ///< its member of a reading, and of what was commanded: V or mA by the source, else s
    std::string_view title;
    std::string_view words;    ///< within a sentence
    std::string_view setting;  ///< the unit in which a run's parameters state its range, as their names end
    double perUnit = 1;        ///< from the unit of a reading to that of a parameter
    [[nodiscard]] constexpr bool isAmplitude() const noexcept { return id == "amplitude"; }
};

inline constexpr CalibratedQuantity kCalibratedAmplitude{"amplitude", "amplitude", "Amplitude", "amplitude", "v"};
inline constexpr CalibratedQuantity kCalibratedInterval{"interval", "interval_s", "Interval", "interval", "s"};
inline constexpr CalibratedQuantity kCalibratedWidth{"width", "width_s", "Phase width", "phase width", "us", 1e6};
inline constexpr CalibratedQuantity kCalibratedGap{"gap", "gap_s", "Inter-phase gap", "inter-phase gap", "us", 1e6};
inline constexpr std::array kCalibratedQuantities{kCalibratedAmplitude, kCalibratedInterval, kCalibratedWidth,
                                                  kCalibratedGap};

/// Null for another id.
[[nodiscard]] constexpr const CalibratedQuantity* calibratedQuantity(std::string_view id) noexcept {
    for (const auto& one : kCalibratedQuantities) {
        if (one.id == id) return &one;
    }
    return nullptr;
}

}  // namespace tacto
