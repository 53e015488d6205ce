// Registry.h - the drivers of a program; opens devices by their addresses.
//
// Thread-safety: one caller.
#pragma once

#include <memory>
#include <set>
#include <span>
#include <vector>

#include "core/devices/Driver.h"

namespace tacto {

/// The drivers of a program, in the order given. Opens URIs that name a single device first.
class Registry {
public:
    explicit Registry(std::vector<std::unique_ptr<Driver>> drivers);
    [[nodiscard]] std::vector<DeviceIdentity> list() const;
    /// True if all of `uris` can run on the virtual clock. Errors: as open().
    [[nodiscard]] Result<bool> allVirtual(std::span<const DeviceUri> uris) const;
    /// Takes the accuracy keys (see DeviceUri.h) from the oscilloscope's address. A stop ends the opening once the
    /// current driver returns; devices opened so far are switched off and closed. Errors: Stopped; NotFound naming
    /// the unknown scheme and the known ones, or the role that no device fills; as Driver::open().
    [[nodiscard]] Result<DeviceSet> open(std::span<const DeviceUri> uris, const std::set<Role>& needed,
                                         const OpenContext& context);

private:
    [[nodiscard]] Result<Driver*> driverFor(const DeviceUri& uri) const;
    std::vector<std::unique_ptr<Driver>> drivers_;
};

}  // namespace tacto
