// FakeHid.h - HID devices without a system under them: what is written to them is kept, and their faults come on the
// test's command.
//
// Thread-safety: every function from any thread.
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

/// One device; outlives its ports.
class FakeHidDevice {
public:
    FakeHidDevice(const Clock& clock, hid::HidDeviceInfo info, Bytes descriptor);

    void unplug();
    void plug();
    /// Writes wait while held: a slow device.
    void hold(bool held);
    /// The next write takes so many bytes only.
    void takeOnly(std::size_t bytes);
    /// While it refuses, all writes fail.
    void refuse(bool refused);
    void setFeature(Bytes report);
    /// An input report that the device sends by itself.
    void send(Bytes report);
    void setDescriptor(Bytes descriptor);
    void setPermitted(bool permitted);

    struct Write {
        Instant at{0};  ///< when the device took it
        Bytes bytes;
    };
    /// All writes that the device took whole, in order.
    [[nodiscard]] std::vector<Write> writes() const;
    [[nodiscard]] Bytes last() const;
    /// Waits until the device took so many; false after 5 s.
    [[nodiscard]] bool waitForWrites(std::size_t count) const;
    /// Waits until a write is held; false after 5 s.
    [[nodiscard]] bool waitForHeld() const;
    /// Waits until the last report is this one; false after 5 s.
    [[nodiscard]] bool waitForLast(const Bytes& report) const;
    [[nodiscard]] int attempts() const;
    [[nodiscard]] int openings() const;
    [[nodiscard]] int openNow() const;
    /// While it refuses, no watchdog starts for its ports; a running one has ended.
    void refuseWatch(bool refused);
    /// The watchdogs of its ports run on and do not answer.
    void silenceWatch(bool silent);
    /// Times that a port's watchdog was told that output is on; whether the last word was that it is off.
    [[nodiscard]] int beats() const;
    [[nodiscard]] bool watchRests() const;
    [[nodiscard]] Bytes watchedStop() const;
    /// Has a port's stopNow() send this report past all that waits.
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
    std::uint64_t session_ = 0;  // plug() makes old ports useless
};

class FakeHidBackend final : public hid::HidBackend {
public:
    std::vector<std::shared_ptr<FakeHidDevice>> plugged;

    std::vector<hid::HidDeviceInfo> devices() const override;
    Result<std::vector<std::uint8_t>> descriptor(const hid::HidDeviceInfo& info) const override;
    Result<std::unique_ptr<hid::HidPort>> open(const hid::HidDeviceInfo& info) const override;
};

/// A report descriptor with one output report of `length` bytes (its number's byte included), on a game pad.
[[nodiscard]] Bytes outputDescriptor(std::uint8_t number, std::size_t length);
/// A haptic controller as in resources/design/wire/hid-vibration.md: output report 1 with u16 intensity, u8 ordinal, u8
/// repeat, then `moreControls`; feature report 2 with the waveforms of ordinals 3 and 4, then their durations.
[[nodiscard]] Bytes hapticDescriptor(const Bytes& moreControls = {});
/// The two-motor reports of a made-up device: number 5, 8 bytes, weak at byte 4, strong at byte 5.
[[nodiscard]] hid::VibrationReports padReports(Seconds keepAlive = Seconds(0), Seconds shortestWrite = Seconds(0));

}  // namespace tacto::test
