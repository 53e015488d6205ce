// BoardAndHost.h - the same samples through the board's encoder and through the bench's chain, step by step as a
// control loop takes them.
//
// Thread-safety: the test's own thread.
#pragma once

#include <vector>

#include "core/acquisition/Recording.h"
#include "core/dsp/RoughnessChain.h"
#include "drivers/sensor_board/EncoderProfile.h"

namespace tacto::test {

/// A train of either side: onset in s, amplitude in V, interval in s.
struct SentTrain {
    double onset_s, amplitude_V, interval_s;
};

struct Side {
    std::vector<RoughnessFrame> frames;
    std::vector<SentTrain> trains;
};

/// What both sides made, and the largest differences of frames and trains that both have.
struct Comparison {
    Side host, board;
    double maxR = 0, maxP = 0;
    double maxOnset_s = 0, maxAmplitude = 0;  ///< amplitude: relative
};

/// A fingertip's samples from the first on, without a word of when it rests.
struct Samples {
    std::vector<StreamInfo> streams;
    std::vector<SampleBlock> blocks;
};

/// Expects frames and trains to be the same but for single precision; `what` names the samples.
[[nodiscard]] Comparison compare(const Samples& samples, const RoughnessSettings& roughness,
                                 const EncodingProfile& encoding, const std::string& what);

/// A voltage source without steps or errors, on 1 kohm.
[[nodiscard]] EncoderOutput idealOutput();

}  // namespace tacto::test
