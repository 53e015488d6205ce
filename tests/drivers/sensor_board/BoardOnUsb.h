// BoardOnUsb.h - the emulated sensor board plugged into the emulated bus: the driver meets it through the real libusb,
// on the steady clock.
//
// Thread-safety: all members any thread.
#pragma once

#include "tests/drivers/sensor_board/BoardFeed.h"
#include "tests/support/usb_emulation/EmulatedUsbDevice.h"

namespace tacto::test {

/// How a board shows its two endpoints; PROTOCOL.md, section 1, allows either.
enum class BoardInterface { Serial, Vendor };

/// The descriptors of a board, with the product string that boards are known by.
[[nodiscard]] UsbDescription boardDescription(BoardInterface kind, const std::string& serial);

class BoardOnUsb {
public:
    BoardOnUsb(UsbTestbed& bed, const Clock& clock, sensorboard::EmulatedBoardSettings settings = {},
               BoardInterface kind = BoardInterface::Serial, int port = 1, BoardFeed::MakeSignal signal = {});
    ~BoardOnUsb() { feed_.stop(); }
    BoardOnUsb(const BoardOnUsb&) = delete;
    BoardOnUsb& operator=(const BoardOnUsb&) = delete;

    /// Out of the socket and without power.
    void unplug();
    void plug();
    [[nodiscard]] EmulatedUsbDevice& usb() noexcept { return usb_; }
    [[nodiscard]] BoardFeed& board() noexcept { return feed_; }

private:
    BoardFeed feed_;
    EmulatedUsbDevice usb_;
};

}  // namespace tacto::test
