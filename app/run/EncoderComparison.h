// EncoderComparison.h - the same samples through the bench's chain and through the board's own encoder
// (resources/firmware/tactile_encoder), turn by turn as the control loop takes them, and how far apart the results are.
//
// The bench's side is the bench's own code up to the gate: FingerInput, TrainPlanner, SafetyGate. Nothing is delivered.
// The board's side is what a board that encodes sends, else the encoder's C99 code here. A board is followed message by
// message on its own clock, with the samples that it had and at the moments at which it asked its encoder, so that the
// same limits hold for it as for the code here.
// A board knows no declared intervals of rest or contact, so neither side is told them.
//
// Thread-safety: none; one owner.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/Clock.h"
#include "core/bench/ControlLoop.h"
#include "core/bench/Profile.h"
#include "core/devices/TactileSensor.h"
#include "drivers/sensor_board/EncoderProfile.h"

namespace tacto {

/// A train of either side; amplitude in V, or mA of a current source.
struct ComparedTrain {
    double onset_s, amplitude;
};

/// What one side made of the samples.
struct EncoderSide {
    std::vector<RoughnessFrame> frames;
    std::vector<ComparedTrain> trains;
    std::vector<double> refused_s;         ///< when a train was refused
    std::vector<EncodedSilence> silences;  ///< of a board
};

/// The largest differences between the frames and trains of both sides.
struct EncoderAgreement {
    std::size_t frames = 0, trains = 0;  ///< that both sides made
    double maxR = 0, maxP = 0;
    double maxAmplitude = 0;       ///< relative
    double maxAmplitudeSteps = 0;  ///< in steps of the stimulator; 0 where it has none
    double maxOnset_s = 0;
    /// True if both made the same trains and frames, refused the same trains, and left out the same values.
    bool refusedAlike = true;
    std::string unlike;  ///< the first thing that one side alone has, in a sentence; empty if there is none
    /// How many blocks and messages of a board were lost on the way here: then the bench had not what the board had,
    /// and nothing is shown.
    std::uint64_t lost = 0;

    double acceptedR = 0.01, acceptedP = 0.002, acceptedOnset_s = 0, acceptedAmplitude = 0.005;  ///< at most
    /// True if nothing is above what is accepted, amplitudes also within one step.
    [[nodiscard]] bool holds() const noexcept;
};

/// Compares frames whose stamps differ by at most 3 us, and trains whose onsets differ by at most 25 ms.
[[nodiscard]] EncoderAgreement agreementOf(const EncoderSide& bench, const EncoderSide& board, double amplitudeStep);

/// A voltage source of up to 60 V without steps or errors, on 1 kohm.
[[nodiscard]] EncoderOutput idealOutput();

class EncoderComparison {
public:
    static constexpr Instant kTurn = std::chrono::milliseconds(1);

    /// `sensor` and `clock` outlive the comparison; a simulated board gets the profile. Errors: as encoderProfile(),
    /// SafetyGate::configure() and RoughnessChain::create(); Unsupported for a stream of more channels than a session
    /// takes, and for a board with another profile in its encoder.
    [[nodiscard]] static Result<std::unique_ptr<EncoderComparison>> create(TactileSensor& sensor,
                                                                           const Profile& profile,
                                                                           const EncoderOutput& output,
                                                                           const std::vector<LimitSet>& limits,
                                                                           const Clock& clock);
    ~EncoderComparison();

    /// Reads the sensor, and every ControlLoop::kPeriod lets both sides make trains, or when a board made its own; to
    /// be called every kTurn. Errors: Device, as the sensor.
    [[nodiscard]] Result<void> turn();

    [[nodiscard]] const EncoderSide& bench() const noexcept;
    [[nodiscard]] const EncoderSide& board() const noexcept;
    /// Onsets may differ by a sample of acceleration; by 1 ms where there is none.
    [[nodiscard]] EncoderAgreement agreement() const;

private:
    struct State;
    explicit EncoderComparison(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace tacto
