// FingerInput.h - the control loop's input from the fingertip: collects samples, judges their continuity and age, and
// keeps the newest roughness frame.
//
// Thread-safety: none; the control loop owns it. update() does not allocate in a steady state.
#pragma once

#include <memory>
#include <vector>

#include "core/acquisition/StreamHealth.h"
#include "core/bench/Telemetry.h"
#include "core/bench/sensing/SensorSession.h"
#include "core/dsp/RoughnessChain.h"

namespace tacto {

class FingerInput {
public:
    /// `session` outlives this object. Errors: as RoughnessChain::create().
    [[nodiscard]] static Result<std::unique_ptr<FingerInput>> create(SensorSession& session,
                                                                     const RoughnessSettings& settings);

    /// Takes what arrived. frames(), blocks() and encoded() stay valid until the next update().
    void update();
    [[nodiscard]] const std::vector<RoughnessFrame>& frames() const noexcept { return frames_; }
    [[nodiscard]] std::span<const SampleBlock> blocks() const noexcept { return blocks_; }
    /// What the board's own encoder said; empty if it does not encode.
    [[nodiscard]] const Encoded& encoded() const noexcept { return encoded_; }
    /// True if the board's trains are played while the finger drives, and not the bench's own.
    [[nodiscard]] bool boardDrives() const noexcept { return session_.boardDrives(); }
    /// The newest frame; before the first, its R is NaN.
    [[nodiscard]] const RoughnessFrame& latest() const noexcept { return latest_; }

    /// Returns the age of the newest sample in the oldest stream; infinite before the first. If all streams, one axis
    /// of the acceleration or a touched array of taxels stand still, returns the age of the first unchanged sample.
    [[nodiscard]] double age_s(double now_s) const noexcept;
    /// Returns Fresh if no signal stands still, each stream and the newest frame (allowing for its window) are at most
    /// 100 ms old, no stamp lies in the future, and no value of the last 100 ms was outside the range of a fingertip
    /// (hazard H7).
    [[nodiscard]] FingerStanding standing(double now_s) const noexcept;
    [[nodiscard]] std::uint64_t gaps() const noexcept;
    [[nodiscard]] RoughnessFlags flags() const noexcept { return chain_->flags(); }
    [[nodiscard]] SensorSession& session() const noexcept { return session_; }

private:
    void watchRange(std::size_t stream) noexcept;
    FingerInput(SensorSession& session, std::unique_ptr<RoughnessChain> chain);

    SensorSession& session_;
    std::unique_ptr<RoughnessChain> chain_;
    [[nodiscard]] std::optional<double> standsStillSince() const noexcept;

    std::vector<StreamHealth> health_;
    std::vector<Standstill> still_;
    std::vector<SampleBlock> blocks_;
    std::vector<RoughnessFrame> frames_;
    Encoded encoded_;
    RoughnessFrame latest_;
    double implausible_s_ = -1;  // time stamp of the newest value outside its range
    bool finished_ = false;
};

}  // namespace tacto
