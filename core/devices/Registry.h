// Registry.h - the drivers of a program, and the opening of devices by their addresses.
//
// Thread-safety: one caller.
#pragma once

#include <memory>
#include <set>
#include <span>
#include <vector>

#include "core/devices/Driver.h"

namespace tacto {

/// The drivers of a program, in the order given. Opens lists of URIs, the ones naming a single device first.
class Registry {
public:
    explicit Registry(std::vector<std::unique_ptr<Driver>> drivers);
    [[nodiscard]] std::vector<DeviceIdentity> list() const;
    /// Whether all of `uris` can run on the virtual clock. Errors: as open().
    [[nodiscard]] Result<bool> allVirtual(std::span<const DeviceUri> uris) const;
    /// The statement keys of DeviceUri.h are taken from the address of the oscilloscope.
    /// A stop ends the opening as soon as the driver that is at work returns; what was opened is switched off and
    /// closed. Errors: Stopped; NotFound naming the unknown scheme and the known ones, or the role that nothing fills;
    /// as Driver::open().
    [[nodiscard]] Result<DeviceSet> open(std::span<const DeviceUri> uris, const std::set<Role>& needed,
                                         const OpenContext& context);

private:
    [[nodiscard]] Result<Driver*> driverFor(const DeviceUri& uri) const;
    std::vector<std::unique_ptr<Driver>> drivers_;
};

}  // namespace tacto
