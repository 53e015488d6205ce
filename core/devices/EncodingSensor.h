// EncodingSensor.h - a fingertip whose board can encode by itself: besides samples it sends its own view of them, and
// the trains that it would play. The board plays nothing: the bench has each train judged by its gate, or does not play
// it.
//
// A board's encoder has one profile, known by its hash (resources/firmware/tactile_encoder).
//
// Thread-safety: encoder() is constant while the device is open, but for the hash of a board whose profile is written
// anew (EncoderLoader.h); encoded() as TactileSensor::read().
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/encoding/PulseTrain.h"
#include "core/safety/FixedText.h"

namespace tacto {

/// The encoder of an open board, which encodes.
struct BoardEncoder {
    bool drives = false;     ///< its trains are played while the sensor drives; else they are only shown
    std::uint32_t hash = 0;  ///< of its profile
    bool operator==(const BoardEncoder&) const = default;
};

// Times are on the session's clock. Each is trivially copyable.

/// One frame as the board sees it. NaN: absent.
struct EncodedFrame {
    static constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();
    double t_s = 0;  ///< the middle of its window
    bool contact = false, sliding = false, slidingAssumed = false;
    double h = kAbsent, v = kAbsent, R = kAbsent, pressure_pa = kAbsent, P = kAbsent;
};

/// A train that the board's own gate let pass. Finite numbers; otherwise not judged.
struct EncodedTrain {
    double onset_s = 0;
    Seconds interval{0};   ///< to the next onset, as commanded
    Volts command{0};      ///< A of science.md section 4
    double amplitude = 0;  ///< V, or mA of a current source
    PulseTrain form;       ///< all but the amplitude, in single precision
    double made_s = 0;     ///< when the encoder made it
};

/// Why the board sends no train, from `t_s` on, when its encoder was asked for one.
struct EncodedSilence {
    double t_s = 0;
    FixedText<200> why;    ///< in words, without a verb; empty: nothing keeps trains back any longer
    bool refused = false;  ///< a train was due, and its gate refused it
    bool rests = false;    ///< it was switched on less than 8 s ago, and does not know what came out before
};

/// In the order of arrival; each at most once, none after a later one.
struct Encoded {
    std::vector<EncodedFrame> frames;
    std::vector<EncodedTrain> trains;
    std::vector<EncodedSilence> silences;
    void clear() noexcept {
        frames.clear();
        trains.clear();
        silences.clear();
    }
};

class EncodingSensor {
public:
    virtual ~EncodingSensor() = default;
    /// Nothing: the board is not asked to encode.
    [[nodiscard]] virtual std::optional<BoardEncoder> encoder() const noexcept = 0;
    /// What came with the last read(). Valid until the next.
    [[nodiscard]] virtual const Encoded& encoded() const noexcept = 0;
    /// For who compares what the board makes with what it had: from the first read() on, all times are seconds of the
    /// board's own clock, and a read() ends after each message of the encoder, so that the samples that came with it
    /// came before. The board's clock is not judged then.
    virtual void keepBoardTime() noexcept = 0;
    /// How many blocks of samples and messages of the encoder were lost on the way here.
    [[nodiscard]] virtual std::uint64_t lostOnTheWay() const noexcept = 0;
};

}  // namespace tacto
