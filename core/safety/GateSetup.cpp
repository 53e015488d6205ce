#include "core/safety/GateSetup.h"

#include <cmath>

namespace tacto {

std::string_view nameOf(OutputMode mode) noexcept { return mode == OutputMode::BenchLoad ? "bench load" : "person"; }

LoadRange LoadRange::around(const Load& nominal, double low, double high) {
    return {scaled(nominal, low), scaled(nominal, high), nominal};
}

LoadRange LoadRange::measured(Ohms magnitude) { return around(Load::resistor(magnitude), 0.7, 1.3); }

LoadRange LoadRange::between(Ohms low, Ohms high) {
    return {Load::resistor(low), Load::resistor(high), Load::resistor(Ohms(std::sqrt(low.value() * high.value())))};
}

}  // namespace tacto
