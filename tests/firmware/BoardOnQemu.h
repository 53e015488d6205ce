// BoardOnQemu.h - the profile of the board that runs under QEMU (resources/firmware/tactile_board/mps2.c).
//
// Thread-safety: pure.
#pragma once

#include "drivers/sensor_board/EncoderProfile.h"

namespace tacto::test {

[[nodiscard]] inline te_profile profileOnQemu() {
    EncoderOutput output;
    output.source.amplitudeMax = 100;
    output.load = LoadRange::declared(Load::resistor(Ohms(1000)));
    const std::vector<StreamInfo> streams{
        {StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, "acceleration"},
        {StreamKind::Force, StreamUnit::Newton, 1, 200, "force"},
        {StreamKind::Taxels, StreamUnit::Pascal, 8, 200, "taxels"}};
    EncodingProfile encoding;
    encoding.train.pulses = 3;
    encoding.train.rate = Hertz(200);
    return encoderProfile(streams, {}, encoding, output).value();
}

}  // namespace tacto::test
