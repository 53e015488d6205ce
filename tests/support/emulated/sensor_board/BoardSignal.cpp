#include "tests/support/emulated/sensor_board/BoardSignal.h"

namespace tacto::sensorboard {

std::array<double, BoardSignal::kTaxels> FingerSignal::pressures_Pa() const {
    static_assert(kTaxels == sim::Finger::kTaxels);
    std::array<double, kTaxels> pressures{};
    finger_.pressures(pressures);
    return pressures;
}

std::array<double, 3> CountingSignal::acceleration() const {
    return {static_cast<double>(steps_ % kModulo) * kAcceleration,
            static_cast<double>(steps_ / kModulo % kModulo) * kAcceleration, 9.80665};
}

std::array<double, BoardSignal::kTaxels> CountingSignal::pressures_Pa() const {
    std::array<double, kTaxels> pressures{};
    for (std::size_t i = 0; i < kTaxels; ++i) {
        pressures[i] = (static_cast<double>(steps_ % kModulo) + static_cast<double>(i)) * kPressure;
    }
    return pressures;
}

double CountingSignal::force_N() const { return static_cast<double>(steps_ % kModulo) * kForce; }

}  // namespace tacto::sensorboard
