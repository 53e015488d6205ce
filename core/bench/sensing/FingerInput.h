// FingerInput.h - the control loop's sense of touch: collects samples, judges their continuity and age, and
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
    /// `session` outlives this. Errors: as RoughnessChain::create().
    [[nodiscard]] static Result<std::unique_ptr<FingerInput>> create(SensorSession& session,
                                                                     const RoughnessSettings& settings);

    /// Takes what arrived. frames() and blocks() are of this call until the next.
    void update();
    [[nodiscard]] const std::vector<RoughnessFrame>& frames() const noexcept { return frames_; }
    [[nodiscard]] std::span<const SampleBlock> blocks() const noexcept { return blocks_; }
    /// The newest frame; its R is NaN before the first.
    [[nodiscard]] const RoughnessFrame& latest() const noexcept { return latest_; }

    /// Age of the oldest stream's newest sample; infinite before the first. While all streams stand still, or one axis
    /// of the acceleration or a touched array of taxels does, it is the age of the first sample that stood still.
    [[nodiscard]] double age_s(double now_s) const noexcept;
    /// Fresh when no sample stands still, every stream, and the newest frame allowing for its window, is at most 100 ms
    /// old, none is stamped in the future, and no value of the last 100 ms was outside what a fingertip can give
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
    RoughnessFrame latest_;
    double implausible_s_ = -1;  // stamp of the newest value outside its range
    bool finished_ = false;
};

}  // namespace tacto
