// ReplayedDevice.h - a device that gives back what was taken before: a recording, captures in files. Whether that was
// measured or simulated only its files can say (hazard H9).
//
// Thread-safety: statedOrigin() is constant while the device is open.
#pragma once

namespace tacto {

enum class StatedOrigin { NotStated, Measured, Simulated };

/// Implemented beside Device by those that replay; DeviceIdentity::simulated is set where it is Simulated.
class ReplayedDevice {
public:
    virtual ~ReplayedDevice() = default;
    [[nodiscard]] virtual StatedOrigin statedOrigin() const noexcept = 0;
};

}  // namespace tacto
