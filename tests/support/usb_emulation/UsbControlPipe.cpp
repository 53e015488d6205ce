#include <algorithm>
#include <cerrno>
#include <linux/usbdevice_fs.h>
#include <utility>

#include "tests/support/usb_emulation/UsbEmulation.h"

namespace tacto::test {

namespace {

constexpr std::uint8_t kTypeMask = 0x60;  // 0: a standard request

UsbSetup setupFrom(std::span<const std::uint8_t> b) {
    const auto word = [&](std::size_t at) { return static_cast<std::uint16_t>(b[at] | b[at + 1] << 8); };
    return {b[0], b[1], word(2), word(4), word(6)};
}

}  // namespace

std::optional<UsbBytes> EmulatedUsbDevice::Emulation::answerTo(std::unique_lock<std::mutex>& lock,
                                                               const UsbSetup& setup,
                                                               std::span<const std::uint8_t> data) {
    const bool input = (setup.type & kInputBit) != 0;
    if ((setup.type & kTypeMask) == 0 && (setup.type & 0x1F) == 0) return standard(setup);
    requests.push_back(setup);
    changed.notify_all();
    if (!behaviour.onRequest) return input ? std::nullopt : std::optional<UsbBytes>(std::in_place);
    lock.unlock();
    auto answer = behaviour.onRequest(setup, input ? std::span<const std::uint8_t>{} : data);
    lock.lock();
    return answer;
}

void EmulatedUsbDevice::Emulation::control(std::unique_lock<std::mutex>& lock, Urb urb) {
    const auto buffer = urb.buffer();
    const auto setup = setupFrom(buffer);
    const bool input = (setup.type & kInputBit) != 0;
    const auto data = buffer.subspan(kSetupSize, std::min<std::size_t>(buffer.size() - kSetupSize, setup.length));
    const auto answer = answerTo(lock, setup, data);
    if (!answer) {
        wire.finish(std::move(urb), -EPIPE, 0);
    } else if (!input) {
        wire.finish(std::move(urb), 0, data.size());
    } else {
        const std::size_t taken = std::min(answer->size(), data.size());
        std::copy_n(answer->begin(), taken, data.begin());
        // More bytes than were asked for are an overflow (babble) on the bus.
        const int status = answer->size() > data.size() ? -EOVERFLOW : 0;
        wire.finish(std::move(urb), status, taken);
    }
}

EmulatedUsbDevice::Emulation::Answer EmulatedUsbDevice::Emulation::controlNow(std::unique_lock<std::mutex>& lock,
                                                                              UMockdevIoctlData* argument,
                                                                              const void* client) {
    constexpr std::uint8_t kVendor = 0x40;
    constexpr std::uint8_t kRecipientMask = 0x1F;
    const IoctlData data(umockdev_ioctl_data_resolve(argument, 0, sizeof(usbdevfs_ctrltransfer), nullptr));
    const auto& asked = *reinterpret_cast<const usbdevfs_ctrltransfer*>(data->data);
    const UsbSetup setup{asked.bRequestType, asked.bRequest, asked.wValue, asked.wIndex, asked.wLength};
    if ((setup.type & kInputBit) != 0) return refuse(ENOTTY);  // no test needs input requests
    if ((setup.type & kTypeMask) != kVendor && (setup.type & kRecipientMask) == 1) {
        const auto owner = claims.find(setup.index & 0xFFU);
        if (owner == claims.end() || owner->second != client) return refuse(EBUSY);
    }
    if (controlHeld) return refuse(ETIMEDOUT);
    std::span<const std::uint8_t> sent;
    IoctlData bytes;
    if (setup.length > 0) {
        bytes.reset(
            umockdev_ioctl_data_resolve(data.get(), offsetof(usbdevfs_ctrltransfer, data), setup.length, nullptr));
        sent = {bytes->data, setup.length};
    }
    if (!answerTo(lock, setup, sent)) return refuse(EPIPE);
    return {setup.length, 0};
}

std::optional<UsbBytes> EmulatedUsbDevice::Emulation::standard(const UsbSetup& setup) const {
    constexpr std::uint8_t kGetDescriptor = 6;
    if (setup.type != kInputBit || setup.request != kGetDescriptor) return std::nullopt;
    const auto upTo = [&](UsbBytes bytes) {
        bytes.resize(std::min<std::size_t>(bytes.size(), setup.length));
        return bytes;
    };
    switch (setup.value >> 8) {
        case 1:
            return upTo(description.deviceDescriptor());
        case 2:
            return upTo(description.configuration);
        case 3:
            break;
        default:
            return std::nullopt;
    }
    const std::string* texts[] = {nullptr, &description.maker, &description.name, &description.serial};
    const std::size_t index = setup.value & 0xFF;
    if (index == 0) return upTo({4, 3, 9, 4});  // English (United States)
    if (index >= std::size(texts)) return std::nullopt;
    UsbBytes text{static_cast<std::uint8_t>(2 + 2 * texts[index]->size()), 3};
    for (const char c : *texts[index]) {
        text.push_back(static_cast<std::uint8_t>(c));
        text.push_back(0);
    }
    return upTo(std::move(text));
}

}  // namespace tacto::test
