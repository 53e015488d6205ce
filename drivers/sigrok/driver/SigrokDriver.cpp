#include "drivers/sigrok/driver/SigrokDriver.h"

#include <algorithm>
#include <array>

#include "drivers/sigrok/driver/SigrokOscilloscope.h"

namespace tacto {

namespace {

/// USB vendor and product numbers (usb.ids) with libsigrok's driver for these oscilloscopes.
struct Maker {
    std::uint16_t vendor;
    std::uint16_t product;
    const char* driver;
};
constexpr std::array<Maker, 9> kMakers{{
    {0x1ab1, 0x04ce, "rigol-ds"},
    {0x1ab1, 0x04b0, "rigol-ds"},
    {0x1ab1, 0x0588, "rigol-ds"},
    {0xf4ec, 0xee3a, "siglent-sds"},
    {0xf4ed, 0xee3a, "siglent-sds"},
    {0x05ff, 0x1023, "lecroy-xstream"},
    {0x0b21, 0x0039, "yokogawa-dlm"},
    {0x04b4, 0x6022, "hantek-6xxx"},
    {0x04b5, 0x6022, "hantek-6xxx"},
}};

class SigrokDriver final : public Driver {
public:
    explicit SigrokDriver(UsbProvider usb) : usb_(std::move(usb)) {}

    std::string_view scheme() const noexcept override { return "sigrok"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        std::vector<DeviceIdentity> found;
        listUsb(found);
        found.push_back({"sigrok:demo", Role::Oscilloscope, "libsigrok's demo device", "", "", true});
        found.push_back({"sigrok:DRIVER:conn=tcp-raw/HOST/PORT", Role::Oscilloscope,
                         "an oscilloscope through libsigrok, here on the network", "", "", false, "", true});
        return found;
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        if (auto free = into.checkFree(Role::Oscilloscope, uri); !free) return free;
        const auto parsed = sigrok_driver::ScopeUri::parse(uri);
        if (!parsed) return failure(parsed);
        auto opened = sigrok_driver::openOscilloscope(*parsed, uri.text(), context.clock);
        if (!opened) return uri.refuse(opened.error());
        into.oscilloscope = std::move(*opened);
        return {};
    }

private:
    void listUsb(std::vector<DeviceIdentity>& found) const {
        if (!usb_) return;
        const auto context = usb_();
        if (!context) return;
        for (const auto& device : (*context)->devices()) {
            const auto maker = std::ranges::find_if(kMakers, [&](const Maker& one) {
                return one.vendor == device.vendor && one.product == device.product;
            });
            if (maker == kMakers.end()) continue;
            DeviceIdentity identity{"sigrok:" + std::string(maker->driver),
                                    Role::Oscilloscope,
                                    device.name.empty() ? device.label() : device.name,
                                    device.serial,
                                    "",
                                    false};
            if (!device.maker.empty()) identity.name = device.maker + " " + identity.name;
            identity.uri += fmt::format(":conn={}.{}", device.bus, device.address);
            identity.obstacle = device.obstacle();
            found.push_back(std::move(identity));
        }
    }

    const UsbProvider usb_;
};

}  // namespace

std::unique_ptr<Driver> makeSigrokDriver(UsbProvider usb) { return std::make_unique<SigrokDriver>(std::move(usb)); }

}  // namespace tacto
