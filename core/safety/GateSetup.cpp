#include "core/safety/GateSetup.h"

#include <cmath>

#include "core/base/Words.h"
#include "core/safety/SourceTraits.h"

namespace tacto {

namespace {
constexpr Word<OutputMode> kOutputModes[] = {{"bench load", OutputMode::BenchLoad}, {"person", OutputMode::Person}};
}  // namespace

std::string_view nameOf(OutputMode mode) noexcept { return wordFor(kOutputModes, mode); }

LoadRange LoadRange::around(const Load& nominal, double low, double high) {
    return {scaled(nominal, low), scaled(nominal, high), nominal};
}

LoadRange LoadRange::measured(Ohms magnitude) { return around(Load::resistor(magnitude), 0.7, 1.3); }

LoadRange LoadRange::between(Ohms low, Ohms high) {
    return {Load::resistor(low), Load::resistor(high), Load::resistor(Ohms(std::sqrt(low.value() * high.value())))};
}

PulseTrain checkTrainOf(const GateSetup& setup) {
    const SourceTraits& source = setup.source;
    const bool current = source.drive == Drive::Current;
    const double wanted = current ? source.checkCurrent.value() : source.checkVoltage.value();
    double amplitude = towardZero(wanted, source.amplitudeStep);
    if (amplitude < source.amplitudeStep) amplitude = source.amplitudeStep;  // the smallest amplitude of the device
    return trainAt(setup.check, source.drive, amplitude);
}

}  // namespace tacto
