// BenchTap.h - lets displays follow the running bench: samples, roughness frames and trains as they pass through the
// control loop.
//
// The loop pushes without waiting; a display that reads too rarely loses the oldest entries and nothing else. Data that
// must not be lost are in the session file.
//
// Thread-safety: the control loop pushes; pop from one thread.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/SpscRing.h"
#include "core/bench/delivery/TrainReport.h"
#include "core/devices/EncodingSensor.h"
#include "core/dsp/RoughnessChain.h"

namespace tacto {

/// One sample of one stream, in the unit given by the sensor's StreamInfo.
struct TapSample {
    static constexpr std::size_t kMaxChannels = 32;  ///< the most that a display can show; further ones are left out
    double t_s = 0;
    std::uint32_t stream = 0;  ///< index into the sensor's streams()
    std::uint32_t channels = 0;
    std::array<float, kMaxChannels> values{};
};

struct BenchTap {
    SpscRing<TapSample> samples{16'384};  ///< about 4 s of a 4 kHz finger
    SpscRing<RoughnessFrame> frames{2048};
    SpscRing<TrainReport> trains{256};         ///< with every outcome; includes impedance checks
    SpscRing<EncodedFrame> boardFrames{2048};  ///< from the board's own encoder, if it encodes
    SpscRing<EncodedTrain> boardTrains{256};   ///< from there too, also those that are not played
};

}  // namespace tacto
