// Devices with false descriptors, as the real libusb reads them.
#include <gmock/gmock.h>

#include "tests/drivers/usb/UsbFixture.h"

#ifdef TACTOSCOPE_ADDRESS_SANITIZED
#include <sanitizer/lsan_interface.h>
#endif

namespace tacto::test {
namespace {

using testing::HasSubstr;

class UsbDescriptors : public UsbTest {
protected:
    /// Plugs in a device, opens it, and returns the error; an empty message means that opening succeeded.
    [[nodiscard]] Error refusal(const UsbDescription& description, UsbFunction function) {
        const EmulatedUsbDevice device(bed, description, {}, 1);
        // libusb does not list a device at all if its descriptors are unreadable: a second device, plugged in after it,
        // shows when the first would have been listed.
        const EmulatedUsbDevice after(bed, vendorDevice(0x1209, 2, "after"), {}, 2);
        if (!comes([&] { return context->find({0x1209, 2}).has_value(); })) return {ErrorCode::Timeout, "no hot-plug"};
        const auto found = context->find({description.vendor, description.product});
        if (!found) return found.error();
#ifdef TACTOSCOPE_ADDRESS_SANITIZED
        // libusb 1.0.26 leaks an interface's settings (40 bytes) if the descriptors break off within them.
        const __lsan::ScopedDisabler notOurs;
#endif
        auto opened = UsbBulkTransport::open(context, *found, {.function = function});
        return opened ? Error{ErrorCode::Io, ""} : opened.error();
    }
    /// Returns where the endpoint's descriptor starts.
    [[nodiscard]] static std::size_t endpointAt(const UsbBytes& bytes, std::uint8_t address) {
        std::size_t at = 0;
        while (!(bytes.at(at + 1) == 5 && bytes.at(at + 2) == address)) at += bytes.at(at);
        return at;
    }
    UsbDescription serial = cdcAcmDevice(0x0483, 0x5740, "S");
    UsbDescription vendor = vendorDevice(0x1209, 1, "S");
};

TEST_F(UsbDescriptors, GoodOnesAreTaken) {
    EXPECT_EQ(refusal(serial, UsbFunction::CdcAcm).message, "");
    EXPECT_EQ(refusal(vendor, UsbFunction::Vendor).message, "");
}

TEST_F(UsbDescriptors, ADeviceOfAnotherKindIsRefused) {
    EXPECT_EQ(refusal(vendor, UsbFunction::CdcAcm).code, ErrorCode::Unsupported);
    EXPECT_EQ(refusal(serial, UsbFunction::Vendor).code, ErrorCode::Unsupported);
}

TEST_F(UsbDescriptors, PacketSizesThatNoBulkEndpointHasAreRefused) {
    RecordProperty("hazard", "H10");
    for (const std::size_t size : {0U, 1U, 63U, 65U, 2047U, 65535U}) {
        auto lying = vendor;
        const auto at = endpointAt(lying.configuration, kIn);
        lying.configuration[at + 4] = static_cast<std::uint8_t>(size);
        lying.configuration[at + 5] = static_cast<std::uint8_t>(size >> 8);
        const auto error = refusal(lying, UsbFunction::Vendor);
        EXPECT_EQ(error.code, ErrorCode::Device) << size;
        EXPECT_THAT(error.message, HasSubstr(std::to_string(size)));
    }
}

TEST_F(UsbDescriptors, EndpointAddressesOutOfRangeAreRefused) {
    RecordProperty("hazard", "H10");
    for (const std::uint8_t address : UsbBytes{0x80, 0x91, 0xF1}) {
        auto lying = vendor;
        lying.configuration[endpointAt(lying.configuration, kIn) + 2] = address;
        EXPECT_NE(refusal(lying, UsbFunction::Vendor).message, "") << int(address);
    }
}

TEST_F(UsbDescriptors, TheSameEndpointTwiceIsRefused) {
    auto lying = vendor;
    auto& bytes = lying.configuration;
    const auto at = endpointAt(bytes, kIn);
    const UsbBytes again(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                         bytes.begin() + static_cast<std::ptrdiff_t>(at + 7));
    bytes.insert(bytes.end(), again.begin(), again.end());
    bytes[13] = 3;  // number of the interface's endpoints
    correctTotalLength(lying);
    EXPECT_EQ(refusal(lying, UsbFunction::Vendor).code, ErrorCode::Device);
}

TEST_F(UsbDescriptors, AUnionThatNamesNoDataInterfaceIsRefused) {
    RecordProperty("hazard", "H10");
    for (const std::uint8_t named : UsbBytes{0, 2, 31, 255}) {
        auto lying = serial;
        auto& bytes = lying.configuration;
        const UsbBytes pattern{5, 0x24, 6, 0, 1};
        const auto found = std::search(bytes.begin(), bytes.end(), pattern.begin(), pattern.end());
        ASSERT_NE(found, bytes.end());
        *(found + 4) = named;
        EXPECT_EQ(refusal(lying, UsbFunction::CdcAcm).code, ErrorCode::Device) << int(named);
    }
}

TEST_F(UsbDescriptors, EveryLengthByteMayLie) {
    RecordProperty("hazard", "H10");
    // Refused, or accepted if the false value makes no difference; never a crash, a hang or a read out of bounds.
    int refused = 0;
    for (const auto* honest : {&serial, &vendor}) {
        const auto function = honest == &serial ? UsbFunction::CdcAcm : UsbFunction::Vendor;
        for (std::size_t at = 0; at < honest->configuration.size(); at += honest->configuration[at]) {
            for (const std::uint8_t lie : UsbBytes{0, 1, 2, 3, 4, 200, 255}) {
                auto lying = *honest;
                lying.configuration[at] = lie;
                const auto error = refusal(lying, function);
                refused += error.message.empty() ? 0 : 1;
            }
        }
    }
    EXPECT_GT(refused, 20);
}

TEST_F(UsbDescriptors, ATotalLengthThatLiesIsSurvived) {
    RecordProperty("hazard", "H10");
    for (const std::size_t total : {0U, 5U, 9U, 20U, 33U, 500U, 65535U}) {
        auto lying = vendor;
        lying.configuration[2] = static_cast<std::uint8_t>(total);
        lying.configuration[3] = static_cast<std::uint8_t>(total >> 8);
        const auto error = refusal(lying, UsbFunction::Vendor);
        // If the length ends before the endpoints, nothing can be opened; a length beyond the end changes nothing.
        if (total < 30) {
            EXPECT_NE(error.message, "") << total;
        }
    }
}

}  // namespace
}  // namespace tacto::test
