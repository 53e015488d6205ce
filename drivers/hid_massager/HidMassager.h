// HidMassager.h - a vibration device that is driven by reports, as a Massager.
//
// The driver's own thread is the port's only writer: it sends the burst, repeats it where the device wants that, and
// ends it with the stop report. The stop report goes out on every way out as well: forceOff(), an error, a report that
// the device was too slow to take, opening and closing; one that fails is tried again every 50 ms.
//
// A fault is not slowness: a write that fails, or that the device takes only part of, is Device; one that is
// still under way after kTimeout is Timeout, its burst is given up and stopped when the write returns.
//
// A watchdog holds the stop as well, for when this program dies or stands still. It is started when the device is
// opened, and without one nothing is written but the stop: one that has ended is Device, one that does not answer is
// Timeout. A burst that was under way while this program stood still
// for longer than Watchdog::kSilence is over: it is not repeated, the device is stopped again, and the next vibrate()
// says so.
//
// After a fault the next vibrate() opens the device again, by identity; an earlier failure that nobody waited for (a
// stop, a repetition) is the error of the vibrate() after it, once.
//
// Thread-safety: as Massager; forceOff() waits for no write. On a VirtualClock there is no thread and the owner calls
// serve(); it is called nowhere else.
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
    /// How long vibrate() waits for the device: an approval lives for 100 ms.
    static constexpr Seconds kTimeout{0.05};

    /// Opens the device and stops it. `open` is called again after a fault. `clock` outlives the device.
    /// Errors: as `open`; InvalidArgument for reports that are not valid(); Device, Timeout when it takes no stop; as
    /// HidPort::watch().
    [[nodiscard]] static Result<std::unique_ptr<HidMassager>> open(OpenPort open, DeviceIdentity identity,
                                                                   VibrationReports reports, const Clock& clock);
    /// The stop report, then closes. Waits for a write that is under way, as HidPort::write() says.
    ~HidMassager() override;
    HidMassager(const HidMassager&) = delete;
    HidMassager& operator=(const HidMassager&) = delete;

    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] const VibrationReports& reports() const noexcept { return reports_; }
    /// Returns when the device has the report. A burst takes the place of one that runs. One that forceOff() overtakes
    /// is not sent, which is not an error. Refuses an expired approval (Device).
    [[nodiscard]] Result<void> vibrate(ApprovedBurst&& burst) override;
    /// The step of the field that takes the fewest values.
    [[nodiscard]] double step() const noexcept override;
    void forceOff() noexcept override;

    /// Writes what is due and returns when the next write is. For the driver's own thread, and for tests on a virtual
    /// clock.
    Instant serve(Instant now) noexcept;

    /// A burst was taken and its stop was not yet written.
    [[nodiscard]] bool vibrating() const;

private:
    /// One vibrate() in progress.
    struct Job {
        Instant expires{0};
        std::uint64_t offs = 0;  // offs_ when it began
        std::optional<Result<void>> done;
    };

    HidMassager(OpenPort open, DeviceIdentity identity, VibrationReports reports, const Clock& clock);
    [[nodiscard]] Result<void> connect();
    [[nodiscard]] Result<void> reconnect(std::unique_lock<std::mutex>& lock);  // of state_
    [[nodiscard]] Result<void> send(std::span<const std::uint8_t> report);     // the port's only writer
    void serveOne(HidWrite what, std::unique_lock<std::mutex>& lock) noexcept;
    void finish(Result<void> result) noexcept;       // the job, if one waits; with state_ held
    void endBurstAfterStandstill();                  // these two with state_ held
    [[nodiscard]] Instant keepBeating(Instant now);  // returns when the next beat is due
    void raise(Error fault);
    void run();

    const OpenPort open_;
    const DeviceIdentity identity_;
    const VibrationReports reports_;
    const Clock& clock_;

    std::mutex urgent_;  // the pointer below; held for stopNow(), which does not wait, and for replacing it
    std::unique_ptr<HidPort> port_;

    std::unique_ptr<Watchdog> watchdog_;  // touched by who may write to the port, as writing_ says

    mutable std::mutex state_;  // guards all below; held for copies only, never for a write
    std::condition_variable changed_;
    BurstTimer timer_;
    std::vector<std::uint8_t> burst_;    // the report of the newest burst
    std::vector<std::uint8_t> sending_;  // the report being written
    std::optional<Job> job_;
    bool writing_ = false;
    std::optional<Error> fault_;  // the device is to be opened again
    bool faultTold_ = false;
    Instant lastBeat_{0};
    std::uint64_t offs_ = 0;  // forceOff() calls
    bool quitting_ = false;
    bool farewell_ = false;  // the last stop was tried

    std::thread thread_;  // Last: starts when all else is ready
};

}  // namespace tacto::hid
