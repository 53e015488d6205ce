// UsbFixture.h - an emulated bus and the real libusb on it, for the tests of drivers/usb.
//
// Thread-safety: the test's own thread; transports state their own rules.
#pragma once

#include <chrono>
#include <future>
#include <gtest/gtest.h>
#include <string_view>

#include "drivers/usb/UsbBulkTransport.h"
#include "tests/support/Comes.h"
#include "tests/support/InTime.h"
#include "tests/support/OtherProgram.h"
#include "tests/support/usb_emulation/EmulatedUsbDevice.h"

namespace tacto::test {

inline constexpr std::uint8_t kIn = 0x81;
inline constexpr std::uint8_t kOut = 0x01;
inline constexpr Seconds kLong{5};      ///< to wait for something that must come
inline constexpr Seconds kShort{0.05};  ///< to wait for something that must not come

inline UsbBytes bytesOf(std::string_view text) { return {text.begin(), text.end()}; }
inline UsbBytes echo(std::span<const std::uint8_t> bytes) { return {bytes.begin(), bytes.end()}; }

class UsbTest : public testing::Test {
protected:
    void SetUp() override {
        auto started = UsbContext::start();
        ASSERT_IN_TIME(started);
        context = *started;
    }

    [[nodiscard]] bool waitForDevices(std::size_t count) const {
        return comes([&] { return context->devices().size() == count; });
    }

    [[nodiscard]] std::unique_ptr<UsbBulkTransport> open(const EmulatedUsbDevice& device,
                                                         const UsbBulkOptions& options = {}) const {
        if (!waitForDevices(1)) return nullptr;
        const auto list = context->devices();
        EXPECT_EQ(list.front().path, device.socket());
        auto opened = UsbBulkTransport::open(context, list.front(), options);
        EXPECT_IN_TIME(opened);
        return opened ? std::move(*opened) : nullptr;
    }

    /// Reads until `count` bytes have come, or no more come.
    [[nodiscard]] static UsbBytes readAll(Transport& transport, std::size_t count) {
        UsbBytes all;
        std::array<std::uint8_t, 4096> piece{};
        while (all.size() < count) {
            const auto read = transport.read(piece, kLong);
            if (!read) break;
            all.insert(all.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(*read));
        }
        return all;
    }

    UsbTestbed bed;
    std::shared_ptr<UsbContext> context;
};

template <class Call>
[[nodiscard]] auto timed(Call&& call) {
    const auto start = std::chrono::steady_clock::now();
    auto result = call();
    return std::pair(std::move(result), Seconds(std::chrono::steady_clock::now() - start));
}

}  // namespace tacto::test
