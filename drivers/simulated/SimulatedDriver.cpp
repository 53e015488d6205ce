#include "drivers/simulated/SimulatedDriver.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/base/ProgramVersion.h"
#include "drivers/simulated/DeviceSettings.h"

namespace tacto {

namespace sim {
namespace {

struct Kind {
    Role role;
    std::string_view path;
    std::string_view name;
    /// Keys that only this simulated device has; a plain "sim:" accepts them too.
    std::vector<std::string_view> ownKeys;
};

const std::array<Kind, 4>& kinds() {
    static const std::array<Kind, 4> all{{
        {Role::Sensor,
         "finger",
         "simulated fingertip",
         {"material", "speed", "force", "stroke", "lift", "tremor", "resonance", "damping", "grating", "depth",
          "taxelrate", "range", "taxelnoise", "forcenoise", "dropouts", "on"}},
        {Role::Stimulator,
         "stimulator",
         "simulated stimulator",
         {"mode",      "load",     "max",       "step",      "compliance", "limit",    "gap",
          "deadman",   "readback", "imbalance", "widthgain", "widtherror", "gaperror", "droop",
          "overshoot", "coldgain", "sourceohm", "rise",      "latency",    "jitter",   "readbacknoise"}},
        {Role::Oscilloscope,
         "oscilloscope",
         "simulated oscilloscope",
         {"memory", "bandwidth", "currentgain", "currentoffset", "timebase", "accuracy", "gaintolerance",
          "offsettolerance", "linearitytolerance", "shunttolerance", "timebasetolerance"}},
        {Role::Massager, "massager", "simulated massager", {"spinup", "frequency", "acceleration"}},
    }};
    return all;
}

DeviceIdentity identityOf(const Kind& kind, const DeviceUri& uri, std::uint64_t seed) {
    return {uri.text(), kind.role, std::string(kind.name), fmt::format("SIM-{}", seed), programVersion().version, true};
}

/// Returns the world of a simulated device that is already in the set, or null.
std::shared_ptr<World> worldOf(const DeviceSet& devices) {
    const std::array<const Device*, 4> all{devices.sensor.get(), devices.stimulator.get(), devices.oscilloscope.get(),
                                           devices.massager.get()};
    for (const auto* device : all) {
        if (const auto* member = dynamic_cast<const WorldMember*>(device)) return member->world();
    }
    return nullptr;
}

class SimulatedDriver final : public Driver {
public:
    explicit SimulatedDriver(std::optional<SimulatedBoards> boards) : boards_(boards) {}

    std::string_view scheme() const noexcept override { return "sim"; }
    bool runsOnVirtualClock() const noexcept override { return true; }

    std::vector<DeviceIdentity> list() const override {
        std::vector<DeviceIdentity> found;
        for (const auto& kind : kinds()) {
            found.push_back(identityOf(kind, {"sim", std::string(kind.path), {}}, 1));
            found.back().serial = "SIM";
        }
        if (boards_) {
            found.push_back(identityOf(kinds().front(), {"sim", "board", {}}, 1));
            found.back().name = "simulated sensor board";
            found.back().serial = "SIM";
        }
        return found;
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& wanted, const OpenContext& context,
                      DeviceSet& into) override {
        if (uri.path.empty()) return openWanted(uri, wanted, context, into);
        if (uri.path == "board" && boards_) return openBoard(uri, context, into);
        for (const auto& kind : kinds()) {
            if (kind.path != uri.path) continue;
            if (auto free = into.checkFree(kind.role, uri); !free) return free;
            return openOne(kind, uri, context, into);
        }
        return uri.refuse(ErrorCode::NotFound,
                          "there is no simulated \"{}\": sim:finger, sim:stimulator, sim:oscilloscope, sim:massager, {}"
                          "or sim: for all that are needed",
                          uri.path, boards_ ? "sim:board, " : "");
    }

private:
    /// Opens a finger, and puts its sensors on a board.
    Result<void> openBoard(const DeviceUri& uri, const OpenContext& context, DeviceSet& into) const {
        if (auto free = into.checkFree(Role::Sensor, uri); !free) return free;
        DeviceUri finger{"sim", "finger", {}}, board{"sim", "board", {}};
        for (const auto& [key, value] : uri.parameters) {
            if (key == "on")
                return uri.refuse(ErrorCode::InvalidArgument, "on={}: sim:finger can be fastened to a motor", value);
            (boards_->isOwn(key) ? board : finger).parameters.emplace_back(key, value);
        }
        if (auto opened = openOne(kinds().front(), finger, context, into); !opened) return opened;
        auto on = boards_->open(std::move(into.sensor), board, context.clock);
        if (!on) {
            into.surface.reset();
            return failure(on);
        }
        into.sensor = std::move(*on);
        return {};
    }

    static Result<void> openWanted(const DeviceUri& uri, const std::set<Role>& wanted, const OpenContext& context,
                                   DeviceSet& into) {
        std::array<DeviceUri, 4> parts;
        for (const auto& [key, value] : uri.parameters) {
            if (key == "flaws") {  // applies to every device that has flaws
                for (std::size_t i = 0; i < parts.size(); ++i) {
                    if (kinds()[i].role == Role::Stimulator || kinds()[i].role == Role::Oscilloscope) {
                        parts[i].parameters.emplace_back(key, value);
                    }
                }
                continue;
            }
            const auto owner = std::ranges::find_if(
                kinds(), [&](const Kind& kind) { return std::ranges::find(kind.ownKeys, key) != kind.ownKeys.end(); });
            if (owner == kinds().end()) {
                return uri.refuse(ErrorCode::InvalidArgument,
                                  "\"{}\" belongs to no single simulated device: write, for example, "
                                  "sim:stimulator?{}={}",
                                  key, key, value);
            }
            if (into.has(owner->role) || !wanted.contains(owner->role)) {
                return uri.refuse(ErrorCode::InvalidArgument, "\"{}\" is for a simulated {}, which this opens none of",
                                  key, nameOf(owner->role));
            }
            parts[static_cast<std::size_t>(owner - kinds().begin())].parameters.emplace_back(key, value);
        }
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto& kind = kinds()[i];
            if (into.has(kind.role) || !wanted.contains(kind.role)) continue;
            parts[i].scheme = "sim";
            parts[i].path = kind.path;
            if (const auto opened = openOne(kind, parts[i], context, into); !opened) return opened;
        }
        return {};
    }

    static Result<void> openOne(const Kind& kind, const DeviceUri& uri, const OpenContext& context, DeviceSet& into) {
        auto world = worldOf(into);
        if (!world) world = std::make_shared<World>(context.clock, context.seed);
        auto identity = identityOf(kind, uri, context.seed);
        switch (kind.role) {
            case Role::Sensor:
                return openFinger(std::move(identity), std::move(world), uri, into);
            case Role::Stimulator:
                return openStimulator(std::move(identity), std::move(world), uri, context, into);
            case Role::Oscilloscope: {
                const auto read = readOscilloscope(uri, context.seed);
                if (!read) return failure(read);
                into.reference = std::make_shared<WorldReference>(world);
                into.oscilloscope = std::make_unique<SimulatedOscilloscope>(std::move(identity), std::move(world),
                                                                            read->traits, read->flaws);
                return {};
            }
            case Role::Massager: {
                const auto read = readMassager(uri);
                if (!read) return failure(read);
                into.massager = std::make_unique<SimulatedMassager>(std::move(identity), std::move(world), *read);
                return {};
            }
        }
        return fail(ErrorCode::Unsupported, "device \"{}\" has a role that cannot be simulated", uri.text());
    }

    static Result<void> openFinger(DeviceIdentity identity, std::shared_ptr<World> world, const DeviceUri& uri,
                                   DeviceSet& into) {
        const auto read = readFinger(uri, world->seed());
        if (!read) return failure(read);
        auto finger = std::make_shared<Finger>(read->finger, world->clock().now());
        if (read->sensor.onMotor) {  // a fingertip on the motor touches no surface, and none can be presented to it
            const auto lifted = finger->present("", MillimetresPerSecond(0), Newtons(0), world->clock().now());
            if (!lifted) return failure(lifted);
        } else {
            into.surface = std::make_shared<FingerPresenter>(world, finger);
        }
        into.sensor =
            std::make_unique<SimulatedSensor>(std::move(identity), std::move(world), std::move(finger), read->sensor);
        return {};
    }

    static Result<void> openStimulator(DeviceIdentity identity, std::shared_ptr<World> world, const DeviceUri& uri,
                                       const OpenContext& context, DeviceSet& into) {
        const auto read = readStimulator(uri, context.seed);
        if (!read) return failure(read);
        auto load = read->load;
        if (!load) {
            const auto declared = parseLoad(context.declaredLoad);
            if (!declared) return failure(declared);
            load = *declared;
        }
        world->circuit().fit(*load, world->clock().now());
        into.load = std::make_shared<CircuitFitter>(world);
        into.stimulator =
            std::make_unique<SimulatedStimulator>(std::move(identity), std::move(world), read->stimulator);
        return {};
    }

    const std::optional<SimulatedBoards> boards_;
};

}  // namespace
}  // namespace sim

std::unique_ptr<Driver> makeSimulatedDriver(std::optional<SimulatedBoards> boards) {
    return std::make_unique<sim::SimulatedDriver>(boards);
}

}  // namespace tacto
