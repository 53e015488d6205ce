// Material.h - the materials that the simulated finger can slide on; each figure with its source.
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
    Micrometres ra{0};                 ///< arithmetic mean roughness of the relief without the grating
    Micrometres rz{0};                 ///< mean peak-to-valley height over five sampling lengths, with the grating
    Micrometres correlationLength{0};  ///< of the heights; exponential: exp(-|x| / length)
    Micrometres asperitySpacing{0};    ///< distance between the summits that bear load
    double friction = 0;               ///< friction coefficient of skin on it
    Millimetres gratingPeriod{0};      ///< 0 = no grating
    Micrometres gratingDepth{0};       ///< peak to valley, sinusoidal
    std::string_view source;
};

[[nodiscard]] std::span<const Material> materials() noexcept;
/// Returns the material of that name (case-sensitive, as printed on the back of the paper), or null.
[[nodiscard]] const Material* findMaterial(std::string_view name) noexcept;
/// Returns "glass, plastic, paper, ..." for messages.
[[nodiscard]] std::string materialNames();

}  // namespace tacto::sim
