// Material.h - what the simulated finger can slide on, as data: each figure with where it comes from.
//
// Thread-safety: constants and pure functions.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/base/Units.h"

namespace tacto::sim {

struct Material {
    std::string_view name;
    Micrometres ra{0};                 ///< arithmetic mean roughness, of the relief without the grating
    Micrometres rz{0};                 ///< mean peak-to-valley over five sampling lengths, grating included
    Micrometres correlationLength{0};  ///< how the height correlates, exponential: exp(-|x| / length)
    Micrometres asperitySpacing{0};    ///< distance of the summits that bear load
    double friction = 0;               ///< skin on it, coefficient
    Millimetres gratingPeriod{0};      ///< 0 = no grating
    Micrometres gratingDepth{0};       ///< peak to valley, sinusoidal
    std::string_view source;
};

[[nodiscard]] std::span<const Material> materials() noexcept;
/// The material of that name (case matters, as printed on the back of the paper), or null.
[[nodiscard]] const Material* findMaterial(std::string_view name) noexcept;
/// "glass, plastic, paper, ..." for messages.
[[nodiscard]] std::string materialNames();

}  // namespace tacto::sim
