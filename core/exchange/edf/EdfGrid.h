// EdfGrid.h - the common grid of an EDF file: how long a record is, and how a value stands in it.
//
// Thread-safety: pure functions.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace tacto::edf {

/// The shortest record that is chosen.
inline constexpr double kMinRecord_s = 0.01;

/// Returns the duration of a record: the first of 1, 2, 4, 5, 8 and 10 s at which every rate gives whole samples, else
/// the multiple of kMinRecord_s up to 60 s with the least relative error. Rates are finite and above 0; `maxRecord` is
/// the most samples in a record, and limits what is chosen in place of the first six.
[[nodiscard]] double recordDuration_s(std::span<const double> rates_hz, double maxRecord);

/// How the values of a signal stand in the file.
struct Scale {
    std::string physicalMin, physicalMax;  ///< decimals of at most 8 characters, as in the header
    int digitalMin = 0, digitalMax = 0;    ///< the lowest means absent
    bool exact = false;                    ///< whole numbers with a step of 1

    /// Puts the nearest digital value of every `apart`-th value into `to`; digitalMin for what is not finite.
    void digital(const double* values, std::size_t apart, std::span<int> to) const noexcept;

    double low = 0, high = 0;  ///< the physical limits as numbers
    double step = 1;           ///< between two values
};

/// Returns the scale for values from `least` to `most` (NaN: there are none) in 16 or 24 bits; nothing if the header
/// cannot state their range.
[[nodiscard]] std::optional<Scale> scaleFor(double least, double most, bool whole, int bits);

}  // namespace tacto::edf
