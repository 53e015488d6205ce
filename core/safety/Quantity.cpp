#include "core/safety/Quantity.h"

#include <limits>

namespace tacto {

namespace {
struct Entry {
    std::string_view key;
    std::string_view title;
    std::string_view unit;
    double window_s;
};
constexpr std::array<Entry, kQuantityCount> kEntries{{
    {"command_voltage", "commanded voltage", "V", 0},
    {"peak_voltage", "peak voltage", "V", 0},
    {"peak_current", "peak current", "mA", 0},
    {"phase_charge", "charge per phase", "uC", 0},
    {"net_charge", "net charge per pulse", "uC", 0},
    {"pulse_energy", "energy per pulse", "mJ", 0},
    {"rms_current_train", "RMS current in the train", "mA", 0},
    {"rms_current_1s", "RMS current over 1 s", "mA", 1},
    {"rms_current_5s", "RMS current over 5 s", "mA", 5},
    {"rms_voltage_5s", "RMS voltage over 5 s", "V", 5},
    {"dc_current", "mean current over 5 s", "mA", 5},
    {"current_density", "current density", "mA/cm2", 5},
    {"power_density", "power density over 1 s", "W/cm2", 1},
}};
}  // namespace

std::string_view keyOf(Quantity quantity) noexcept { return kEntries[indexOf(quantity)].key; }
std::string_view titleOf(Quantity quantity) noexcept { return kEntries[indexOf(quantity)].title; }
std::string_view unitOf(Quantity quantity) noexcept { return kEntries[indexOf(quantity)].unit; }
double windowOf(Quantity quantity) noexcept { return kEntries[indexOf(quantity)].window_s; }
bool needsArea(Quantity quantity) noexcept {
    return quantity == Quantity::CurrentDensity || quantity == Quantity::PowerDensity;
}

std::optional<Quantity> quantityOf(std::string_view key) noexcept {
    for (std::size_t i = 0; i < kEntries.size(); ++i) {
        if (kEntries[i].key == key) return static_cast<Quantity>(i);
    }
    return std::nullopt;
}

}  // namespace tacto
