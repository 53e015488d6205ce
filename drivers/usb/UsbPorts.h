// UsbPorts.h - lists the sockets that hold a device of one of these products, each as a TransportPort.
//
// Thread-safety: as TransportPorts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/devices/TransportPorts.h"
#include "drivers/usb/UsbBulkTransport.h"
#include "drivers/usb/UsbProvider.h"

namespace tacto {

struct UsbProduct {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string name = {};  ///< the product string that the device must have; empty: any
};

/// If USB does not start (in a container), there are no ports. A device without the function that `options` names is
/// tried as a vendor-specific device.
[[nodiscard]] std::shared_ptr<TransportPorts> makeUsbPorts(UsbProvider usb, std::vector<UsbProduct> products,
                                                           UsbBulkOptions options);

}  // namespace tacto
