// DeviceText.h - what the device dock says of a device, in lines of rich text, and which of those that are plugged in
// is the one that is open.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QStringList>
#include <set>
#include <string>
#include <vector>

#include "app/gui/controller/BenchController.h"

namespace tacto::gui {

/// Whether `present` is the device that was opened as `open`: by its URI, by its serial number, or as the one that a
/// URI without a name ("sensor:") stands for.
[[nodiscard]] bool isSame(const SessionDevice& open, const DeviceIdentity& present);

/// Whether an open device was among those plugged in (`seen`, URIs) and is not any more.
[[nodiscard]] bool unpluggedWhileOpen(const SessionDevice& open, const std::vector<DeviceIdentity>& present,
                                      const std::set<std::string>& seen);

/// Identity and abilities of an open device.
[[nodiscard]] QStringList factsOf(const SessionDevice& device, const OpenBench& open);

/// What it reports on itself, but for counts of 0 and what is not known.
[[nodiscard]] QStringList rowsOf(const DeviceReport& report);

}  // namespace tacto::gui
