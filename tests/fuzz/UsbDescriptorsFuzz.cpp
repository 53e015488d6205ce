// Any USB device's descriptors give a pair of bulk endpoints that they contain, or a sentence (hazard H10). Each
// interface setting is four bytes (number, alternate setting, class, number of endpoints 0 to 7), each endpoint four
// (address, attributes, largest packet); the first byte chooses the function to look for.
#include <cstdint>
#include <cstdlib>
#include <libusb.h>
#include <vector>

#include "drivers/usb/UsbEndpoints.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::UsbDescriptorsFuzz {

TACTO_FUZZ(UsbDescriptorsFuzz, const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    std::vector<libusb_interface_descriptor> settings;
    std::vector<std::vector<libusb_endpoint_descriptor>> endpoints;
    for (std::size_t at = 1; at + 4 <= size && settings.size() < 32;) {
        libusb_interface_descriptor setting{};
        setting.bInterfaceNumber = data[at];
        setting.bAlternateSetting = data[at + 1];
        setting.bInterfaceClass = data[at + 2];
        const unsigned wanted = data[at + 3] % 8;
        auto& own = endpoints.emplace_back();
        for (at += 4; own.size() < wanted && at + 4 <= size; at += 4) {
            libusb_endpoint_descriptor endpoint{};
            endpoint.bEndpointAddress = data[at];
            endpoint.bmAttributes = data[at + 1];
            endpoint.wMaxPacketSize = static_cast<std::uint16_t>(data[at + 2] << 8 | data[at + 3]);
            own.push_back(endpoint);
        }
        setting.bNumEndpoints = static_cast<std::uint8_t>(own.size());
        settings.push_back(setting);
    }
    std::vector<libusb_interface> interfaces;
    for (std::size_t i = 0; i < settings.size(); ++i) {
        settings[i].endpoint = endpoints[i].data();
        interfaces.push_back({&settings[i], 1});
    }
    libusb_config_descriptor configuration{};
    configuration.bNumInterfaces = static_cast<std::uint8_t>(interfaces.size());
    configuration.interface = interfaces.data();

    const auto function = data[0] % 2 == 0 ? tacto::UsbFunction::CdcAcm : tacto::UsbFunction::Vendor;
    const auto pair = tacto::findBulkPair(configuration, function, "the fuzzed device");
    if (!pair) {
        if (pair.error().message.find("the fuzzed device") == std::string::npos) std::abort();
        return 0;
    }
    if ((pair->in & 0x80U) == 0 || (pair->out & 0x80U) != 0 || pair->inPacket == 0 || pair->outPacket == 0)
        std::abort();
    return 0;
}

}  // namespace tacto::fuzz::UsbDescriptorsFuzz
