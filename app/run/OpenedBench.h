// OpenedBench.h - a bench with its devices, its clock and its session file, opened in the one way that there is: for a
// protocol, and for looking and driving by hand.
//
// Thread-safety: openBench() any thread; the rest as its parts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/run/RunFiles.h"
#include "app/run/RunNotes.h"
#include "app/run/Shipped.h"
#include "core/bench/Bench.h"
#include "core/bench/sensing/BenchTap.h"
#include "core/devices/DeviceUri.h"
#include "core/devices/Registry.h"
#include "core/session/SessionWriter.h"

namespace tacto {

/// What a bench opens, for whom, and where it is recorded.
struct BenchOrder {
    std::vector<DeviceUri> uris = {};
    std::set<Role> needed = {};  ///< sim: fills the roles that no other device fills
    std::string declaredLoad = kDefaultLoad;
    std::uint64_t seed = 1;
    bool realtime = false;  ///< the steady clock even where a virtual one could serve
    Profile profile = {};
    ShippedLimits limits = {};
    std::string out = {};  ///< folder, as prepareRunFiles() takes it
    RunNotes notes = {};
    /// The stops that end this order, from the opening of the devices on; null: the bench's own. `asked`: when the
    /// operator asked for it.
    std::shared_ptr<StopCounter> stops = nullptr;
    StopMark asked = {};
    std::function<bool()> watched = {};  ///< BenchConfig::watched
    OutputMode mode = OutputMode::BenchLoad;
    std::optional<PersonSetup> person = {};  ///< for OutputMode::Person
    bool virtualParticipant = false;         ///< as in BenchConfig
    bool rehearsal = false;
    /// Makes the session file in place of makeRunSession(); empty: that does. It is given the open devices, and may
    /// refuse them: then nothing was made.
    std::function<Result<RunSession>(const SessionAbout&, const Clock&, const DeviceSet&)> makeSession = {};
    SessionAbout about = {};  ///< for a protocol its script and parameters; aboutSession() adds the rest
};

struct OpenedBench {
    std::shared_ptr<Clock> clock;
    std::shared_ptr<BenchTap> tap;  ///< null: no view is open
    RunFiles files;
    SessionAbout about;
    std::unique_ptr<SessionWriter> session;
    std::shared_ptr<const RowSeal> seal;  ///< seals the session's rows; null: they are not sealed
    std::unique_ptr<Bench> bench;         // Ends before what it writes to
    /// What the operator should know before anything is delivered, a sentence each; what a report needs of it is in the
    /// session.
    std::vector<std::string> warnings;
};

/// Opens the devices, makes the session file and the bench. A stop ends the opening of devices; the bench's begin()
/// finds one that comes later.
/// Errors: as checkNotes(), Registry::allVirtual(), openDevices(), makeRunSession() and Bench::create().
[[nodiscard]] Result<std::shared_ptr<OpenedBench>> openBench(const BenchOrder& order, Registry& registry,
                                                             std::shared_ptr<BenchTap> tap = nullptr);

/// The description of a session before its first row.
[[nodiscard]] SessionAbout aboutSession(const DeviceSet& devices, const BenchOrder& order);

}  // namespace tacto
