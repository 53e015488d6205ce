// UnitRecord.h - what a unit delivered in the last seconds and the fault that it was left in, in a file: exposure and
// faults belong to the unit and outlive the program (H1, H2).
//
// One file of fixed size per unit, mapped into memory: the control loop writes into it without a system call, and what
// it wrote is there for the next process however this one ends. A train is written before its approval is handed out.
// Each part carries a checksum. A record that does not check, one from a future that is not ours, one from another
// start of the computer of which the wall time cannot say that it is long ago, and one that is not the last that the
// unit was driven from on this computer (UnitClaim), are not believed: the unit then rests until whatever it
// delivered is out of every window (quietUntil()).
//
// The file is locked while the record lives, so two processes never drive one unit from two meters. Simulated units
// keep none: they are born with their bench, at rest.
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

// The place where the program keeps what outlives it about each unit (UnitRecord, UnitClaim).

struct UnitFolders {
    std::filesystem::path records;
    std::filesystem::path claims;  ///< one folder for everybody on this computer, emptied when it starts
};

/// The records in $XDG_DATA_HOME/tactoscope/units or ~/.local/share/tactoscope/units, the claims in /run/lock.
[[nodiscard]] UnitFolders unitFolders();

class UnitClaim;

/// The most that may be left on the load, and until when it was put there.
struct ResidualVoltage {
    double volts = 0;
    Instant at{0};
};
/// Sorted by what the source that left it does at rest, in the order of GapState.
using ResidualVoltages = std::array<ResidualVoltage, 2>;

struct UnitFault {
    std::uint32_t causes = 0;  ///< a bit per FaultCause
    std::chrono::sys_seconds at{};
    FixedText<159> reason;
};

class UnitRecord {
public:
    /// How many trains the record holds: as many as the meter.
    static constexpr std::size_t kTrains = ExposureMeter::kCapacity;
    /// How long a unit with an unknown past rests: the longest window after a train of 2 s that may have begun when the
    /// process before ended.
    static constexpr Instant kRest = std::chrono::seconds(8);
    /// By the wall clock, a record from another start of the computer that is at least this old is long ago.
    static constexpr std::chrono::seconds kLongAgo{60};

    /// Opens the record of `unit` ("sciencemode 1234"), or makes it, and locks it. `clock` and `time` outlive the
    /// record. Errors: Device when another process drives this unit, naming it; Io.
    [[nodiscard]] static Result<std::unique_ptr<UnitRecord>> open(const UnitFolders& folders, std::string_view unit,
                                                                  const Clock& clock,
                                                                  const SystemTime& time = SystemTime::real());
    ~UnitRecord();
    UnitRecord(const UnitRecord&) = delete;
    UnitRecord& operator=(const UnitRecord&) = delete;

    /// Nothing is approved before this moment, on the clock, as it is not known what the unit delivered before. It lies
    /// in the past where that is known.
    [[nodiscard]] Instant quietUntil() const noexcept { return quietUntil_; }
    /// The reason in one sentence; empty where the past is known.
    [[nodiscard]] std::string_view whyQuiet() const noexcept { return why_; }

    /// Books the trains of earlier processes that a window could still touch, with their times on the clock (before it
    /// was made, they are negative). Returns what was left on the load.
    [[nodiscard]] ResidualVoltages replay(ExposureMeter& meter) const noexcept;

    /// Writes a train down. Does not block, allocate or fail.
    void book(const BookedTrain& train, const ResidualVoltages& left) noexcept;

    /// The fault in which the unit was left, until it is cleared.
    [[nodiscard]] std::optional<UnitFault> fault() const noexcept;
    void keepFault(FaultCause cause, std::string_view reason) noexcept;
    void clearFault() noexcept;

private:
    struct Map;
    UnitRecord(LockedFile&& file, std::unique_ptr<UnitClaim> claim, const Clock& clock, const SystemTime& time);
    void takeOver();
    [[nodiscard]] Instant onClock(Instant sinceBoot) const noexcept;

    const LockedFile file_;
    Map& map_;
    const std::unique_ptr<UnitClaim> claim_;  // null: none could be made
    const Clock& clock_;
    const SystemTime& time_;
    std::string_view why_;
    Instant quietUntil_;
    std::uint64_t next_ = 1;  // Sequence number of the next train
};

// Which record of a unit was the last from which a program drove it, in a place that no account and no environment
// chooses (H1): a unit with two records, of two accounts or two data folders, has a past that neither knows.
//
// One small file per unit in a folder of the computer's that everybody may write to and that a start of the computer
// empties. It is locked while the claim lives, so two accounts never drive one unit at once. Where it cannot be kept,
// nothing is claimed, and the unit's past is not known. What drives a unit from another container or another computer
// is not seen.

class UnitClaim {
public:
    /// Opens and locks the claim of `unit`, or makes it: `file` in `folder`. Null where none can be kept. Errors:
    /// Device when another process holds it, naming it.
    [[nodiscard]] static Result<std::unique_ptr<UnitClaim>> open(const std::filesystem::path& folder,
                                                                 std::string_view file, std::string_view unit);
    ~UnitClaim();
    UnitClaim(const UnitClaim&) = delete;
    UnitClaim& operator=(const UnitClaim&) = delete;

    /// True when the unit was driven from no other record than `record` since the computer started.
    [[nodiscard]] bool isOf(std::uint64_t record) const noexcept;
    /// True when the last program to drive the unit left it in a fault, or whether it did is unknown.
    [[nodiscard]] bool faulted() const noexcept;

    /// From here on the unit is driven from `record`.
    void take(std::uint64_t record, bool faulted) noexcept;
    void keepFault(bool faulted) noexcept;

private:
    struct State;
    explicit UnitClaim(std::unique_ptr<State> state);

    const std::unique_ptr<State> state_;
};

}  // namespace tacto
