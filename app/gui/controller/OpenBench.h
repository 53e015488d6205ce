// OpenBench.h - what to open, and what is open then.
//
// Thread-safety: values.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "app/run/OpenedBench.h"

namespace tacto::gui {

/// What to open for looking, driving by hand and replaying.
struct LiveOrder {
    std::vector<DeviceUri> uris;
    /// What the bench must have; sim: fills those of them that no other device does.
    std::set<Role> needed{Role::Sensor, Role::Stimulator, Role::Oscilloscope};
    Profile profile;
    double speed = 1;  ///< times real time; devices that can live on the virtual clock only
    std::uint64_t seed = 1;
    RunNotes notes = {};  ///< the session's; the controller fills them in from the day's
};

/// Constant while it is open.
struct OpenBench {
    SessionAbout about;
    std::filesystem::path session;
    std::vector<StreamInfo> streams;       ///< the sensor's; empty without one
    std::optional<DeviceIdentity> output;  ///< what arming arms: the stimulator, else the massager
    std::optional<SourceTraits> source;
    std::optional<ScopeTraits> scope;
    bool paced = false;        ///< on the virtual clock: `speed` means something
    bool surfaces = false;     ///< the rig presents surfaces by itself
    bool untriggered = false;  ///< the oscilloscope can take a record without a trigger
    [[nodiscard]] bool simulated() const { return about.simulated; }
};

[[nodiscard]] std::shared_ptr<const OpenBench> describeBench(const OpenedBench& opened);

}  // namespace tacto::gui
