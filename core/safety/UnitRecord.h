// UnitRecord.h - a file with a unit's deliveries of the last seconds and its last fault: both belong to the unit and
// outlive the program (H1, H2).
//
// One file of fixed size per unit, mapped into memory: the control loop writes to it without a system call, and the
// next process finds the data however this one ends. A train is written before its approval is handed out. Each part
// has a checksum. A record is not trusted if it is damaged, if its times lie in the future, if it is from another start
// of the computer and not clearly old by the wall clock, or if another record on this computer was used last
// (UnitClaim).
// The unit then rests until whatever it delivered is out of every window (quietUntil()).
//
// The file is locked while this object exists, so two processes never drive one unit with two meters. Simulated
// units have no record: they start with their bench, at rest.
//
// Thread-safety: book() has one caller, the gate's; keepFault() and clearFault() have one caller at a time, the
// interlock under its lock; the rest is constant after open().
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "core/base/Clock.h"
#include "core/base/Result.h"
#include "core/safety/ExposureMeter.h"
#include "core/safety/Interlock.h"
#include "core/safety/LockedFile.h"

namespace tacto {

// The places where the program keeps lasting data about each unit (UnitRecord, UnitClaim).

struct UnitFolders {
    std::filesystem::path records;
    std::filesystem::path claims;  ///< one folder for all users of this computer, emptied when it starts
};

/// Returns $XDG_DATA_HOME/tactoscope/units or ~/.local/share/tactoscope/units for records, and /run/lock for claims.
[[nodiscard]] UnitFolders unitFolders();

class UnitClaim;

/// The highest voltage that may be left on the load, and until when it was put there.
struct ResidualVoltage {
    double volts = 0;
    Instant at{0};
};
/// Sorted by the resting state of the source that left the voltage, in the order of GapState.
using ResidualVoltages = std::array<ResidualVoltage, 2>;

class UnitRecord {
public:
    /// How many trains the record holds: as many as the meter.
    static constexpr std::size_t kTrains = ExposureMeter::kCapacity;
    /// How long a unit with an unknown past rests: the longest window after a train of 2 s that may have begun when the
    /// previous process ended.
    static constexpr Instant kRest = std::chrono::seconds(8);
    /// A record from another start of the computer is old if the wall clock shows at least this age.
    static constexpr std::chrono::seconds kLongAgo{60};

    /// Opens the record of `unit` ("sciencemode 1234"), or makes it, and locks it. `clock` and `time` outlive the
    /// record. Errors: Device if another process drives this unit, naming that process; Io.
    [[nodiscard]] static Result<std::unique_ptr<UnitRecord>> open(const UnitFolders& folders, std::string_view unit,
                                                                  const Clock& clock,
                                                                  const SystemTime& time = SystemTime::real());
    ~UnitRecord();
    UnitRecord(const UnitRecord&) = delete;
    UnitRecord& operator=(const UnitRecord&) = delete;

    /// Nothing is approved before this moment of the clock, because the unit's earlier deliveries are not known. The
    /// moment lies in the past if they are known.
    [[nodiscard]] Instant quietUntil() const noexcept { return quietUntil_; }
    /// Returns the reason in one sentence; empty if the past is known.
    [[nodiscard]] std::string_view whyQuiet() const noexcept { return why_; }

    /// Books the trains of earlier processes that a window could still touch, timed by the clock (negative before its
    /// start). Returns the voltages left on the load.
    [[nodiscard]] ResidualVoltages replay(ExposureMeter& meter) const noexcept;

    /// Writes a train into the record. Does not block, allocate or fail.
    void book(const BookedTrain& train, const ResidualVoltages& left) noexcept;

    /// Returns the fault in which the unit was left, until it is cleared.
    [[nodiscard]] std::optional<UnitFault> fault() const noexcept { return fault_; }
    void keepFault(FaultCause cause, std::string_view reason) noexcept;
    /// Clears the fault, and with it the file, unless the file holds one: see holdFault().
    void clearFault() noexcept;
    /// Holds the present fault in the file, whatever is cleared, until the record is opened again: a safety check that
    /// is killed before it passes has reset nothing (hazard H2).
    void holdFault() noexcept;

private:
    struct Map;
    UnitRecord(LockedFile&& file, std::unique_ptr<UnitClaim> claim, const Clock& clock, const SystemTime& time);
    void takeOver();
    void writeFault() noexcept;
    [[nodiscard]] Instant onClock(Instant sinceBoot) const noexcept;

    const LockedFile file_;
    Map& map_;
    const std::unique_ptr<UnitClaim> claim_;  // null: no claim could be made
    const Clock& clock_;
    const SystemTime& time_;
    std::string_view why_;
    Instant quietUntil_;
    std::uint64_t next_ = 1;          // sequence number of the next train
    std::optional<UnitFault> fault_;  // the file has it and what is held
    std::optional<UnitFault> held_;
};

// Notes from which record a unit was last driven, in a place that depends on no account or environment (H1): with two
// records, of two accounts or data folders, neither knows the unit's whole past.
//
// One small file per unit, in a folder to which everybody may write and which is emptied when the computer starts. It
// is locked while this object exists, so two accounts never drive one unit at once. If it cannot be kept, nothing is
// claimed, and the unit's past is not known. Programs in another container or on another computer that drive the unit
// are not noticed.

class UnitClaim {
public:
    /// Opens and locks the claim of `unit`, or makes it: `file` in `folder`. Null if no claim can be kept. Errors:
    /// Device if another process holds it, naming that process.
    [[nodiscard]] static Result<std::unique_ptr<UnitClaim>> open(const std::filesystem::path& folder,
                                                                 std::string_view file, std::string_view unit);
    ~UnitClaim();
    UnitClaim(const UnitClaim&) = delete;
    UnitClaim& operator=(const UnitClaim&) = delete;

    /// True if the unit was driven from no record but `record` since the computer started.
    [[nodiscard]] bool isOf(std::uint64_t record) const noexcept;
    /// True if the last program that drove the unit left it in a fault, or if this is not known.
    [[nodiscard]] bool faulted() const noexcept;

    /// Notes that the unit is now driven from `record`.
    void take(std::uint64_t record, bool faulted) noexcept;
    void keepFault(bool faulted) noexcept;

private:
    struct State;
    explicit UnitClaim(std::unique_ptr<State> state);

    const std::unique_ptr<State> state_;
};

}  // namespace tacto
