// OpenedBench.h - a bench with its devices, clock and session file. This is the only way to open a bench, for a
// protocol and for manual use.
//
// Thread-safety: openBench() any thread; the rest as its parts.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/run/RunFiles.h"
#include "app/run/RunNotes.h"
#include "app/run/Shipped.h"
#include "core/bench/Bench.h"
#include "core/bench/sensing/BenchTap.h"
#include "core/devices/DeviceUri.h"
#include "core/devices/Registry.h"
#include "core/exchange/lsl/LslStreams.h"
#include "core/session/SessionWriter.h"

namespace tacto {

/// What a bench opens, for whom, and where the session is recorded.
struct BenchOrder {
    std::vector<DeviceUri> uris = {};
    std::set<Role> needed = {};  ///< sim: fills the roles that no other device has
    std::string declaredLoad = kDefaultLoad;
    std::uint64_t seed = 1;
    bool realtime = false;            ///< uses the steady clock even if a virtual clock would do
    std::optional<double> pace = {};  ///< of a virtual clock, as VirtualClock
    Profile profile = {};
    ShippedLimits limits = {};
    std::string out = {};  ///< folder, as prepareRunFiles() accepts it
    RunNotes notes = {};
    /// Counts stops; each ends this order from the opening of the devices on. Null: the bench's own counter. `asked`:
    /// the count when the operator made the request.
    std::shared_ptr<StopCounter> stops = nullptr;
    StopMark asked = {};
    std::function<bool()> watched = {};  ///< BenchConfig::watched
    OutputMode mode = OutputMode::BenchLoad;
    std::optional<PersonSetup> person = {};  ///< for OutputMode::Person
    bool virtualParticipant = false;         ///< as in BenchConfig
    bool rehearsal = false;
    /// Makes the session file instead of makeRunSession(), unless empty. Gets the open devices and may refuse them;
    /// then it has made nothing.
    std::function<Result<RunSession>(const SessionAbout&, const Clock&, const DeviceSet&)> makeSession = {};
    LslOrder lsl = {};        ///< streams while the bench is open; none by default
    SessionAbout about = {};  ///< for a protocol: its script and parameters; aboutSession() adds the rest
};

struct OpenedBench {
    OpenedBench() = default;
    ~OpenedBench();
    OpenedBench(const OpenedBench&) = delete;
    OpenedBench& operator=(const OpenedBench&) = delete;

    std::shared_ptr<Clock> clock;
    std::shared_ptr<BenchTap> tap;  ///< null: no view is open
    RunFiles files;
    SessionAbout about;
    std::unique_ptr<SessionWriter> session;
    std::shared_ptr<LslStreams> lsl;      ///< null: none; ends before the session is closed
    std::shared_ptr<const RowSeal> seal;  ///< seals the session's rows; null: rows are not sealed
    std::unique_ptr<Bench> bench;         // destroyed before the objects that it writes to
    /// What the operator should know before anything is delivered, one sentence each. The session records what a report
    /// needs of these.
    std::vector<std::string> warnings;

    /// Ends the streams and writes the session's row "lsl" about them. Once the bench is gone, and with it the last
    /// train. Nothing if there are none. An error in writing the row is found when the session is closed.
    std::optional<LslTally> endLsl();
};

/// Opens the devices, makes the session file and the bench. A stop ends the opening of devices; the bench's begin()
/// detects a later stop.
/// Errors: as checkNotes(), prepareLsl(), openDevices(), makeRunSession(), Bench::create() and LslStreams::begin().
[[nodiscard]] Result<std::shared_ptr<OpenedBench>> openBench(const BenchOrder& order, Registry& registry,
                                                             std::shared_ptr<BenchTap> tap = nullptr);

/// Returns the order's streams before anything is opened; null if it wants none. Errors: as Registry::allVirtual() and
/// LslStreams::prepare(); InvalidArgument if the session would have a virtual clock, whose times mean nothing to
/// others.
[[nodiscard]] Result<std::shared_ptr<LslStreams>> prepareLsl(const BenchOrder& order, Registry& registry);

/// Returns the description of a session before its first row.
[[nodiscard]] SessionAbout aboutSession(const DeviceSet& devices, const BenchOrder& order);

}  // namespace tacto
