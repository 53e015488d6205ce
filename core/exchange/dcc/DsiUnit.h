// DsiUnit.h - units as D-SI writes them, "\milli\volt" or "\second\tothe{-1}": the brochure "Digital System of Units
// (D-SI)" of PTB, doi 10.5281/zenodo.3522631, and section 3 of the SI Brochure for prefixes and derived units.
//
// Thread-safety: pure functions.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace tacto {

/// A unit as a factor to the coherent SI unit of its dimension.
struct DsiUnit {
    /// Exponents of kg, m, s, A, K, mol and cd. All are 0 for a number, also for \percent and \ppm.
    std::array<double, 7> dimension{};
    double factor = 1;  ///< "\milli\volt": 0.001
    [[nodiscard]] bool sameKind(const DsiUnit& other) const noexcept { return dimension == other.dimension; }
};

/// Nothing for a text that is no unit of D-SI, or has a unit with an offset (\degreecelsius), of which a calibration of
/// electrical instruments needs none.
[[nodiscard]] std::optional<DsiUnit> dsiUnit(std::string_view text);

}  // namespace tacto
