// ProfileOnQemu.h - the profile of the board that runs under QEMU (resources/firmware/tactile_board/mps2.c).
//
// Thread-safety: pure.
#pragma once

#include "drivers/sensor_board/EncoderProfile.h"

namespace tacto::test {

[[nodiscard]] inline EncoderOutput outputOnQemu() {
    EncoderOutput output;
    output.source.amplitudeMax = 100;
    output.load = LoadRange::declared(Load::resistor(Ohms(1000)));
    return output;
}

[[nodiscard]] inline EncodingProfile encodingOnQemu() {
    EncodingProfile encoding;
    encoding.train.pulses = 3;
    encoding.train.rate = Hertz(200);
    return encoding;
}

[[nodiscard]] inline te_profile profileOnQemu() {
    const std::vector<StreamInfo> streams{
        {StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, "acceleration"},
        {StreamKind::Force, StreamUnit::Newton, 1, 200, "force"},
        {StreamKind::Taxels, StreamUnit::Pascal, 8, 200, "taxels"}};
    return encoderProfile(streams, {}, encodingOnQemu(), outputOnQemu()).value();
}

}  // namespace tacto::test
