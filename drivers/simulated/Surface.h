// Surface.h - one specimen of a material: a height profile along the path in space, so that a faster finger produces
// higher frequencies.
//
// The profile is Gaussian with exponential correlation, scaled to exactly the material's Ra (as a certificate would
// state), plus the material's grating; it repeats after length(). The finger's skin follows contactHeight(), the
// profile as far as skin can follow it. The taxels measure bearing(): how many summits carry load under each taxel.
//
// Thread-safety: constant after construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "drivers/simulated/Material.h"

namespace tacto::sim {

class Surface {
public:
    /// `seed` selects the specimen. Takes a few milliseconds.
    Surface(const Material& material, std::uint64_t seed);

    [[nodiscard]] const Material& material() const noexcept { return material_; }
    /// Ra of this specimen: the material's Ra, or more with a grating.
    [[nodiscard]] Micrometres ra() const noexcept;
    /// Rz of this specimen: mean peak-to-valley height of five sampling lengths.
    [[nodiscard]] Micrometres rz() const noexcept;
    [[nodiscard]] Millimetres length() const noexcept;

    /// Height in metres of cell `i` of the profile, cells kCell_m apart.
    [[nodiscard]] double profile(std::size_t i) const noexcept { return static_cast<double>(height_[i & kMask]); }
    /// Returns the profile in metres, averaged over the contact patch at `x_m` ≥ 0 along the path.
    [[nodiscard]] double contactHeight(double x_m) const noexcept { return lookUp(contact_, x_m / kCell_m); }
    /// Returns the relative deviation of a taxel's pressure from the mean, at `x_m` along track `track`.
    [[nodiscard]] double bearing(std::size_t track, double x_m) const noexcept;
    /// Returns how much fine friction flicker this surface causes, 0 (mirror) to 1 (coarser than skin can follow).
    [[nodiscard]] double flicker() const noexcept { return flicker_; }

    static constexpr double kCell_m = 5e-6;
    static constexpr std::size_t kCells = 1U << 17U;
    static constexpr double kBearingCell_m = 250e-6;
    static constexpr std::size_t kBearingCells = 1U << 13U;

private:
    static constexpr std::size_t kMask = kCells - 1;

    template <class Table>
    [[nodiscard]] static double lookUp(const Table& table, double position) noexcept {
        const auto cell = static_cast<std::size_t>(position);
        const double part = position - static_cast<double>(cell);
        const double a = static_cast<double>(table[cell & (table.size() - 1)]);
        const double b = static_cast<double>(table[(cell + 1) & (table.size() - 1)]);
        return a + part * (b - a);
    }

    void makeProfile(std::uint64_t seed);
    [[nodiscard]] double grating(std::size_t i) const noexcept;
    void makeContact();
    void makeBearing(std::uint64_t seed);

    Material material_;
    std::vector<float> height_;
    std::vector<float> contact_;
    std::vector<float> bearing_;
    double gratingAmplitude_ = 0;  // metres
    double flicker_ = 0;
};

}  // namespace tacto::sim
