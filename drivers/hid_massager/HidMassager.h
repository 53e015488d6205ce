// HidMassager.h - implements Massager for a vibration device that is driven by reports.
//
// Only the driver's own thread writes to the port: it sends the burst, repeats it if the device needs that, and ends it
// with the stop report. forceOff(), an error, a report that took too long, opening and closing also send the stop
// report. A stop report that fails is retried every 50 ms.
//
// A failed or partial write is the error Device. A write that still runs after kTimeout is the error Timeout; its burst
// is given up, and the device is stopped when the write returns.
//
// A watchdog can send the stop as well, in case this program dies or hangs. It is started when the device is opened;
// without a watchdog that answers, only stops are written: a watchdog that has ended is the error Device, one that does
// not answer is Timeout. If this program hangs for longer than Watchdog::kSilence during a burst, the burst is over: it
// is not repeated, the device is stopped again, and the next vibrate() reports this.
//
// After a fault the next vibrate() opens the device again, by identity. If a stop or repetition failed while no caller
// waited, the next vibrate() returns that error once.
//
// Thread-safety: as Massager; forceOff() waits for no write. On a VirtualClock there is no thread, and only the owner
// calls serve().
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/base/Clock.h"
#include "core/devices/Stimulator.h"
#include "drivers/hid_massager/BurstTimer.h"
#include "drivers/hid_massager/HidPort.h"
#include "drivers/hid_massager/VibrationReports.h"

namespace tacto::hid {

class HidMassager final : public Massager {
public:
    /// How long vibrate() waits for the device; an approval is valid for 100 ms.
    static constexpr Seconds kTimeout{0.05};

    /// Opens the device and stops it. `open` is called again after a fault. `clock` outlives the device.
    /// Errors: as `open` and HidPort::watch(); InvalidArgument for invalid reports; Device, Timeout if it takes no
    /// stop.
    [[nodiscard]] static Result<std::unique_ptr<HidMassager>> open(OpenPort open, DeviceIdentity identity,
                                                                   VibrationReports reports, const Clock& clock);
    /// Sends the stop report, then closes. Waits for a running write, at most as long as HidPort::write() takes.
    ~HidMassager() override;
    HidMassager(const HidMassager&) = delete;
    HidMassager& operator=(const HidMassager&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const VibrationReports& reports() const noexcept { return reports_; }
    /// Returns when the device has the report. A burst replaces a running one. If forceOff() overtakes a burst, it is
    /// not sent, which is no error. Refuses an expired approval (Device).
    [[nodiscard]] Result<void> vibrate(ApprovedBurst&& burst) override;
    /// Returns the intensity step of the field that has the fewest values.
    [[nodiscard]] double step() const noexcept override;
    void forceOff() noexcept override;

    /// Writes what is due and returns the time of the next write. For the driver's own thread, and for tests on a
    /// virtual clock.
    Instant serve(Instant now) noexcept;

    /// True if the device took a burst and its stop has not been written yet.
    [[nodiscard]] bool vibrating() const;

private:
    /// One running call of vibrate().
    struct Job {
        Instant expires{0};
        std::uint64_t offs = 0;  // value of offs_ when the call began
        std::optional<Result<void>> done;
    };

    HidMassager(OpenPort open, DeviceIdentity identity, VibrationReports reports, const Clock& clock);
    [[nodiscard]] Result<void> connect();
    [[nodiscard]] Result<void> reconnect(std::unique_lock<std::mutex>& lock);  // `lock` is a lock of state_
    [[nodiscard]] Result<void> send(std::span<const std::uint8_t> report);     // the only writer to the port
    void serveOne(HidWrite what, std::unique_lock<std::mutex>& lock) noexcept;
    void finish(Result<void> result) noexcept;       // ends the waiting job, if any; needs state_ held
    void endBurstAfterStandstill();                  // needs state_ held
    [[nodiscard]] Instant keepBeating(Instant now);  // needs state_ held; returns when the next beat is due
    void raise(Error fault);
    void run();

    const OpenPort open_;
    const DeviceIdentity identity_;
    const VibrationReports reports_;
    const Clock& clock_;

    std::mutex urgent_;  // guards port_; held only for stopNow(), which does not wait, and to replace port_
    std::unique_ptr<HidPort> port_;

    std::unique_ptr<Watchdog> watchdog_;  // used only by the thread that may write to the port, see writing_

    mutable std::mutex state_;  // guards everything below; held only for copies, never during a write
    std::condition_variable changed_;
    BurstTimer timer_;
    std::vector<std::uint8_t> burst_;    // the report of the newest burst
    std::vector<std::uint8_t> sending_;  // the report being written
    std::optional<Job> job_;
    bool writing_ = false;
    std::optional<Error> fault_;  // set: the device must be opened again
    bool faultTold_ = false;
    Instant lastBeat_{0};
    std::uint64_t offs_ = 0;  // number of forceOff() calls
    bool quitting_ = false;
    bool farewell_ = false;  // true once the last stop was tried

    std::thread thread_;  // declared last: starts when everything else is ready
};

}  // namespace tacto::hid
