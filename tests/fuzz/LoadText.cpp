// Any text as a load is read or refused, without a crash; a load that was read can be written and read again (hazard
// H10).
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/electrode/Load.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::LoadText {

namespace {
bool near(double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(a); }
}  // namespace

TACTO_FUZZ(LoadText, const std::uint8_t* data, std::size_t size) {
    const auto load = tacto::parseLoad({reinterpret_cast<const char*>(data), size});
    if (!load) {
        if (load.error().message.empty()) std::abort();
        return 0;
    }
    const auto again = tacto::parseLoad(load->text());
    if (!again || again->kind != load->kind || again->windowCount != load->windowCount) std::abort();
    if (!near(load->series.value(), again->series.value()) || !near(load->parallel.value(), again->parallel.value()) ||
        !near(load->capacitance.value(), again->capacitance.value()) ||
        !near(load->driftPerSecond, again->driftPerSecond)) {
        std::abort();
    }
    return 0;
}

}  // namespace tacto::fuzz::LoadText
