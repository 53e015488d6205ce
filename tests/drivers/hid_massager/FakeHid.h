// FakeHid.h - fake HID devices that need no system: they record what is written to them and fail when the test asks.
//
// Thread-safety: any thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "core/base/Clock.h"
#include "drivers/hid_massager/HidBackend.h"
#include "drivers/hid_massager/VibrationReports.h"

namespace tacto::test {

using Bytes = std::vector<std::uint8_t>;

/// One fake device; must outlive its ports.
class FakeHidDevice {
public:
    FakeHidDevice(const Clock& clock, hid::HidDeviceInfo info, Bytes descriptor);

    void unplug();
    void plug();
    /// While held, writes wait, as on a slow device.
    void hold(bool held);
    /// Makes the next write take only this many bytes.
    void takeOnly(std::size_t bytes);
    /// While `refused`, all writes fail.
    void refuse(bool refused);
    void setFeature(Bytes report);
    /// Sends an input report on the device's own initiative.
    void send(Bytes report);
    void setDescriptor(Bytes descriptor);
    void setPermitted(bool permitted);

    struct Write {
        Instant at{0};  ///< when the device took it
        Bytes bytes;
    };
    /// Returns all writes that the device took completely, in order.
    [[nodiscard]] std::vector<Write> writes() const;
    [[nodiscard]] Bytes last() const;
    /// Waits until the device took `count` writes; returns false after 5 s.
    [[nodiscard]] bool waitForWrites(std::size_t count) const;
    /// Waits until a write is held; returns false after 5 s.
    [[nodiscard]] bool waitForHeld() const;
    /// Waits until the last report is `report`; returns false after 5 s.
    [[nodiscard]] bool waitForLast(const Bytes& report) const;
    [[nodiscard]] int attempts() const;
    [[nodiscard]] int openings() const;
    [[nodiscard]] int openNow() const;
    /// While `refused`, no watchdog starts for the device's ports, and a running one has ended.
    void refuseWatch(bool refused);
    /// While `silent`, the watchdogs of the device's ports run but do not answer.
    void silenceWatch(bool silent);
    /// beats(): how often a port's watchdog was told that output is on. watchRests(): true if it was last told "off".
    [[nodiscard]] int beats() const;
    [[nodiscard]] bool watchRests() const;
    [[nodiscard]] Bytes watchedStop() const;
    /// Makes a port's stopNow() send this report ahead of everything that waits.
    void setUrgentStop(Bytes report);

    [[nodiscard]] bool plugged() const;
    [[nodiscard]] hid::HidDeviceInfo info() const;
    [[nodiscard]] Bytes descriptor() const;
    [[nodiscard]] Result<std::unique_ptr<hid::HidPort>> open();

private:
    friend class FakeHidPort;
    friend class FakeWatchdog;
    template <class Value>
    [[nodiscard]] Value locked(const Value& value) const {
        const std::scoped_lock lock(mutex_);
        return value;
    }

    const Clock& clock_;
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    hid::HidDeviceInfo info_;
    Bytes descriptor_, feature_, urgentStop_, watchedStop_;
    std::vector<Write> writes_;
    std::deque<Bytes> sent_;
    std::optional<std::size_t> takeOnly_;
    bool plugged_ = true, refused_ = false, held_ = false, watchRefused_ = false, watchSilent_ = false, resting_ = true;
    int beats_ = 0, waiting_ = 0, attempts_ = 0, openings_ = 0, openNow_ = 0;
    std::uint64_t session_ = 0;  // plug() changes it, which makes old ports useless
};

class FakeHidBackend final : public hid::HidBackend {
public:
    std::vector<std::shared_ptr<FakeHidDevice>> plugged;

    std::vector<hid::HidDeviceInfo> devices() const override;
    Result<std::vector<std::uint8_t>> descriptor(const hid::HidDeviceInfo& info) const override;
    Result<std::unique_ptr<hid::HidPort>> open(const hid::HidDeviceInfo& info) const override;
};

/// Makes a game pad's descriptor with one output report of `length` bytes, the number byte included.
[[nodiscard]] Bytes outputDescriptor(std::uint8_t number, std::size_t length);
/// A haptic controller as in resources/design/wire/hid-vibration.md: output report 1 with u16 intensity, u8 ordinal, u8
/// repeat count, then `moreControls`; feature report 2 with the waveforms of ordinals 3 and 4, then their durations.
[[nodiscard]] Bytes hapticDescriptor(const Bytes& moreControls = {});
/// Two-motor reports of an invented device: number 5, 8 bytes, weak motor at byte 4, strong motor at byte 5.
[[nodiscard]] hid::VibrationReports padReports(Seconds keepAlive = Seconds(0), Seconds shortestWrite = Seconds(0));

}  // namespace tacto::test
