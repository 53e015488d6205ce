// Surface.h - one specimen of a material: a height profile along the path, in space, so that a faster finger hears
// higher frequencies.
//
// The profile is Gaussian with exponential correlation, scaled so that its Ra is the material's to the last digit, as a
// certificate would state it, plus the material's grating; it repeats after length(). What the finger feels of it is
// contactHeight(): the profile as far as skin can follow it. What the taxels feel is bearing(): how many summits
// carry load under each of them.
//
// Thread-safety: const after construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "drivers/simulated/Material.h"

namespace tacto::sim {

class Surface {
public:
    /// `seed` picks the specimen. Takes a few milliseconds.
    Surface(const Material& material, std::uint64_t seed);

    [[nodiscard]] const Material& material() const noexcept { return material_; }
    /// Measured on this specimen: the material's, or more with a grating.
    [[nodiscard]] Micrometres ra() const noexcept;
    /// Measured on this specimen: mean peak-to-valley of five sampling lengths.
    [[nodiscard]] Micrometres rz() const noexcept;
    [[nodiscard]] Millimetres length() const noexcept;

    /// Height in metres of cell `i` of the profile, cells kCell_m apart.
    [[nodiscard]] double profile(std::size_t i) const noexcept { return static_cast<double>(height_[i & kMask]); }
    /// The profile averaged over the contact patch, metres, at `x_m` ≥ 0 along the path.
    [[nodiscard]] double contactHeight(double x_m) const noexcept { return lookUp(contact_, x_m / kCell_m); }
    /// Relative deviation of a taxel's pressure from the mean contact pressure, at `x_m` along track `track`.
    [[nodiscard]] double bearing(std::size_t track, double x_m) const noexcept;
    /// How much of the fine friction flicker this surface excites, 0 (mirror) to 1 (coarser than skin can follow).
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
