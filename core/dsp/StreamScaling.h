// StreamScaling.h - the one place where a fingertip's readings become N and Pa: which scales of a profile hold for its
// streams, and what they make of a reading.
//
// Scales of another fingertip, and those for readings in another unit, are left aside; references that were read under
// them do not hold either (hazard H7).
//
// Thread-safety: constant after construction, but for scaled(), which has one caller. Neither allocates.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/Stream.h"
#include "core/dsp/RoughnessFlags.h"
#include "core/dsp/SensorScales.h"

namespace tacto {

class StreamScaling {
public:
    /// `serial` is of the fingertip that gives the samples; empty: not known.
    StreamScaling(std::span<const StreamInfo> streams, const std::optional<SensorScales>& scales,
                  std::string_view serial);

    /// In the units in use.
    [[nodiscard]] const std::vector<StreamInfo>& streams() const noexcept { return streams_; }
    [[nodiscard]] double inUse(std::size_t stream, std::size_t channel, double reading) const noexcept;
    /// All taxels of one sample in the unit in use; `readings` itself where nothing is scaled. Until the next call.
    [[nodiscard]] const double* scaled(std::size_t stream, const double* readings) noexcept;

    /// False where scales were left aside: what was measured under them is of no use here.
    [[nodiscard]] bool holds() const noexcept { return !another_ && !leftAside_; }
    void raise(RoughnessFlags& flags) const noexcept;

private:
    SensorScales scales_;
    std::vector<StreamInfo> streams_;
    bool force_ = false, taxels_ = false;  // scaled
    bool another_ = false, notNamed_ = false, leftAside_ = false;
    std::vector<double> row_;
};

/// Errors: InvalidArgument where the scales are of this very fingertip and hold for another number of taxels.
[[nodiscard]] Result<void> checkScales(std::span<const StreamInfo> streams, const std::optional<SensorScales>& scales,
                                       std::string_view serial);

}  // namespace tacto
