#include "drivers/simulated/Material.h"

#include <array>

namespace tacto::sim {

namespace {
// Sandpaper: mean grain diameters d by FEPA 43-1 (P60 269 µm, P120 125 µm, P400 35 µm). Areal profilometry of P120
// gives Sa = 42.4 µm (Nanovea, "Roughness and Particle Diameter of Sandpaper", 2018), so Sa / d = 0.34, used for all
// three. Correlation length d / 2; load-bearing summits are 2.5 d apart (an open coat). Rz of a Gaussian profile over
// the usual sampling lengths is 6 to 7.5 Ra.
// Friction: dry fingertip, order of magnitude from the tribology of skin (glass above 1, rough solids near 0.6).
constexpr std::array<Material, 7> kMaterials{{
    {"glass", Micrometres(0.01), Micrometres(0.07), Micrometres(50), Micrometres(90), 1.1, Millimetres(0),
     Micrometres(0), "float glass, Ra at most 0.01 µm"},
    {"plastic", Micrometres(1.6), Micrometres(11), Micrometres(60), Micrometres(90), 0.8, Millimetres(0),
     Micrometres(0), "moulded ABS with a spark-eroded finish, VDI 3400 Ref 24: Ra 1.6 µm"},
    {"paper", Micrometres(3), Micrometres(21), Micrometres(30), Micrometres(100), 0.5, Millimetres(0), Micrometres(0),
     "80 g/m² copy paper, Ra 2.5 to 4 µm by stylus"},
    {"denim", Micrometres(17), Micrometres(165), Micrometres(120), Micrometres(200), 0.45, Millimetres(0.85),
     Micrometres(60), "3/1 twill cotton, 12 ridges per cm, 60 µm deep: Ra 24 µm in all"},
    {"P400", Micrometres(12), Micrometres(84), Micrometres(17.5), Micrometres(88), 0.6, Millimetres(0), Micrometres(0),
     "FEPA P400, d = 35 µm; Ra = 0.34 d"},
    {"P120", Micrometres(42), Micrometres(290), Micrometres(62), Micrometres(312), 0.65, Millimetres(0), Micrometres(0),
     "FEPA P120, d = 125 µm; Sa 42.4 µm (Nanovea 2018)"},
    {"P60", Micrometres(91), Micrometres(600), Micrometres(135), Micrometres(672), 0.7, Millimetres(0), Micrometres(0),
     "FEPA P60, d = 269 µm; Ra = 0.34 d"},
}};
}  // namespace

std::span<const Material> materials() noexcept { return kMaterials; }

const Material* findMaterial(std::string_view name) noexcept {
    for (const auto& material : kMaterials) {
        if (material.name == name) return &material;
    }
    return nullptr;
}

std::string materialNames() {
    std::string names;
    for (const auto& material : kMaterials) {
        if (!names.empty()) names += ", ";
        names += material.name;
    }
    return names;
}

}  // namespace tacto::sim
