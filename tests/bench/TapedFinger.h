// TapedFinger.h - a finger that slides forever, with generated samples and without the cost of a driver.
//
// Thread-safety: as a TactileSensor.
#pragma once

#include "core/base/Clock.h"
#include "core/devices/TactileSensor.h"

namespace tacto::test {

/// A finger, at rest for half a second, then in contact: 3 axes at 4 kHz, 8 taxels and force at 200 Hz.
class TapedFinger final : public TactileSensor {
public:
    explicit TapedFinger(const Clock& clock) : clock_(clock) {}
    const DeviceIdentity& identity() const noexcept override { return identity_; }
    std::span<const StreamInfo> streams() const noexcept override { return streams_; }
    Result<void> read(std::span<SampleBlock> blocks) override {
        const double now = toSeconds(clock_.now());
        for (std::size_t s = 0; s < streams_.size(); ++s) {
            for (; static_cast<double>(next_[s]) / streams_[s].rate_hz <= now; ++next_[s]) {
                const double t = static_cast<double>(next_[s]) / streams_[s].rate_hz;
                blocks[s].t_s.push_back(t);
                for (std::size_t c = 0; c < streams_[s].channels; ++c) {
                    noise_ = noise_ * 6364136223846793005ULL + 1442695040888963407ULL;
                    const double n = static_cast<double>(noise_ >> 40U) * 0x1.0p-24 - 0.5;
                    const bool touching = t > 0.5;
                    const double value = s == 0   ? (touching ? 3 * n : 0.01 * n)
                                         : s == 1 ? (touching ? 1000.0 * static_cast<double>(c + 1) + 20 * n : 2 * n)
                                                  : (touching ? 2.0 : 0.0);
                    blocks[s].values.push_back(value);
                }
            }
        }
        return {};
    }

private:
    const Clock& clock_;
    DeviceIdentity identity_{"taped:", Role::Sensor, "Taped finger", "", "", true};
    std::vector<StreamInfo> streams_{
        {StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, "acceleration"},
        {StreamKind::Taxels, StreamUnit::Pascal, 8, 200, "taxels"},
        {StreamKind::Force, StreamUnit::Newton, 1, 200, "force"}};
    std::uint64_t next_[3] = {0, 0, 0};
    std::uint64_t noise_ = 1;
};

}  // namespace tacto::test
