#include "app/run/OpenedBench.h"

#include <algorithm>
#include <utility>

#include "app/run/KnownCalibration.h"
#include "app/run/OpenDevices.h"
#include "app/run/ScopeStatement.h"
#include "core/base/JsonText.h"
#include "core/base/ProgramVersion.h"
#include "core/bench/arming/CommandPreview.h"
#include "core/devices/Device.h"
#include "core/devices/EncoderLoader.h"
#include "core/safety/UnitRecord.h"
#include "core/session/Origin.h"
#include "drivers/sensor_board/EncoderProfile.h"

namespace tacto {

namespace {

std::string originOf(const DeviceSet& devices, const DeviceIdentity& identity) {
    const Device* all[] = {devices.sensor.get(), devices.stimulator.get(), devices.oscilloscope.get(),
                           devices.massager.get()};
    for (const auto* device : all) {
        const auto* replayed = dynamic_cast<const ReplayedDevice*>(device);
        if (replayed == nullptr || !(device->identity() == identity)) continue;
        switch (replayed->statedOrigin()) {
            case StatedOrigin::Measured:
                return origin::kReplayedMeasured;
            case StatedOrigin::Simulated:
                return origin::kReplayedSimulated;
            case StatedOrigin::NotStated:
                return origin::kReplayedUnknown;
        }
    }
    return identity.simulated ? origin::kSimulated : origin::kHardware;
}

Result<BoardProfile> profileForBoard(const TactileSensor& sensor, const Profile& profile, const GateSetup& setup) {
    const auto made = encoderProfile(sensor.streams(), profile.roughness, profile.encoding,
                                     {setup.source, setup.load, setup.ceilings}, sensor.identity().serial);
    if (!made) return failure(made);
    return BoardProfile{made->hash, profileBytes(*made)};
}

/// Writes the profile for this stimulator and the declared load into a simulated board.
Result<void> loadBoard(const BenchOrder& order, DeviceSet& devices) {
    auto* const loader = dynamic_cast<EncoderLoader*>(devices.sensor.get());
    if (loader == nullptr || !loader->wantsProfile() || !devices.stimulator) return {};
    const auto load = parseLoad(order.declaredLoad);
    if (!load) return failure(load);
    GateSetup setup;
    setup.source = devices.stimulator->traits();
    setup.load = LoadRange::declared(*load);
    setup.ceilings = order.profile.ceilings;
    const auto made = profileForBoard(*devices.sensor, order.profile, setup);
    // What a real stimulator delivered before is not known.
    if (made) return loader->load(made->bytes, devices.stimulator->identity().simulated);
    return fail(made.error().code, "the profile \"{}\" is not for {}, which encodes: {}", order.profile.name,
                devices.sensor->identity().name, made.error().message);
}

/// Notes in the session which parts of the profile do not fit the devices, and warns about them.
Result<void> warnOfProfile(const Profile& profile, const DeviceSet& devices, OpenedBench& opened) {
    const auto warn = [&opened](const char* kind, const std::optional<std::string>& text) -> Result<void> {
        if (!text) return {};
        opened.warnings.push_back(*text);
        const auto kept = opened.session->event(opened.clock->now(), kind, {{"text", *text}});
        if (!kept) return failure(kept);
        return {};
    };
    if (const auto& stimulator = devices.stimulator) {
        const auto beyond = beyondReach(profile, stimulator->traits(), stimulator->identity().name);
        if (auto warned = warn("profile beyond reach", beyond); !warned) return warned;
    }
    if (!devices.sensor) return {};
    return warn("profile of another fingertip", madeWithAnother(profile, devices.sensor->identity().serial));
}

}  // namespace

OpenedBench::~OpenedBench() {
    bench.reset();
    if (!lsl) return;
    session->listen(nullptr);
    static_cast<void>(lsl->end());
}

std::optional<LslTally> OpenedBench::endLsl() {
    if (!lsl) return std::nullopt;
    session->listen(nullptr);
    const auto tally = std::exchange(lsl, nullptr)->end();
    static_cast<void>(session->event(clock->now(), "lsl", toJson(tally)));
    return tally;
}

SessionAbout aboutSession(const DeviceSet& devices, const BenchOrder& order) {
    SessionAbout about = order.about;
    about.programVersion = programVersion().version;
    about.seed = order.seed;
    for (const auto& device : devices.identities()) {
        about.devices.push_back({device.uri, std::string(nameOf(device.role)), device.name, device.serial,
                                 device.firmware, device.simulated, originOf(devices, device)});
        about.simulated = about.simulated || device.simulated;
    }
    // Without a device nothing is measured: the results of such a protocol are predictions.
    about.simulated = about.simulated || (!about.protocol.empty() && devices.identities().empty());
    about.profileJson = dumpJson(toJson(order.profile));
    const auto& limits = order.limits;
    for (std::size_t i = 0; i < limits.sets.size(); ++i)
        about.limitSets.push_back({limits.sets[i].id, limits.sha256[i], limits.from[i]});
    about.mode = nameOf(order.mode);
    about.wallStart = wallTimeUtc();
    return about;
}

Result<std::shared_ptr<LslStreams>> prepareLsl(const BenchOrder& order, Registry& registry) {
    if (!order.lsl.wanted()) return nullptr;
    const auto allVirtual = registry.allVirtual(order.uris);
    if (!allVirtual) return failure(allVirtual);
    if (*allVirtual && !order.realtime)
        return fail(
            ErrorCode::InvalidArgument,
            "LSL has the computer's clock, and these devices run on a simulated one, which is faster; real time "
            "(--realtime, or the session’s own pace) is expected");
    return LslStreams::prepare(order.lsl, order.mode == OutputMode::Person);
}

Result<std::shared_ptr<OpenedBench>> openBench(const BenchOrder& order, Registry& registry,
                                               std::shared_ptr<BenchTap> tap) {
    if (auto checked = checkNotes(order.notes); !checked) return failure(checked);
    const auto allVirtual = registry.allVirtual(order.uris);
    if (!allVirtual) return failure(allVirtual);
    auto lsl = prepareLsl(order, registry);
    if (!lsl) return failure(lsl);
    auto opened = std::make_shared<OpenedBench>();
    opened->tap = std::move(tap);
    if (*allVirtual && !order.realtime)
        opened->clock = std::make_shared<VirtualClock>(order.pace);
    else
        opened->clock = std::make_shared<SteadyClock>();
    const OpenContext context{.clock = *opened->clock,
                              .seed = order.seed,
                              .declaredLoad = order.declaredLoad,
                              .stops = order.stops.get(),
                              .asked = order.asked};
    auto devices = openDevices(registry, order.uris, order.needed, context);
    if (!devices) return failure(devices);
    if (auto loaded = loadBoard(order, *devices); !loaded) return failure(loaded);
    const auto certificate = stateOscilloscope(*devices);
    opened->about = aboutSession(*devices, order);
    auto session = order.makeSession
                       ? order.makeSession(opened->about, *opened->clock, *devices)
                       : makeRunSession(order.out, order.about.protocol.empty() ? "live" : order.about.protocol,
                                        opened->about, *opened->clock);
    if (!session) return failure(session);
    opened->files = std::move(session->files);
    opened->session = std::move(session->writer);
    opened->seal = std::move(session->seal);
    opened->lsl = std::move(*lsl);
    if (opened->lsl) opened->session->listen(opened->lsl);
    if (auto warned = warnOfProfile(order.profile, *devices, *opened); !warned) return failure(warned);
    if (auto kept = keepCertificate(certificate, *opened->session, opened->clock->now()); !kept) return failure(kept);
    if (!certificate.used && !certificate.text.empty()) opened->warnings.push_back(certificate.text);
    if (auto kept = keepNotes(order.notes, *opened->session, opened->clock->now()); !kept) return failure(kept);
    BenchConfig config;
    config.devices = std::move(*devices);
    config.clock = opened->clock;
    config.profile = order.profile;
    config.limits = order.limits.sets;
    config.mode = order.mode;
    config.person = order.person;
    config.virtualParticipant = order.virtualParticipant;
    config.rehearsal = order.rehearsal;
    config.session = opened->session.get();
    config.tap = opened->tap.get();
    config.stops = order.stops;
    config.asked = order.asked;
    config.watched = order.watched;
    applyKnown(knownCalibration(config.devices), config);
    config.units = unitFolders();
    config.boardProfile = profileForBoard;
    auto bench = Bench::create(std::move(config));
    if (!bench) return failure(bench);
    opened->bench = std::move(*bench);
    if (opened->lsl) {
        auto begun =
            opened->lsl->begin(*opened->session, opened->about, opened->files.session.stem().string(), opened->clock);
        if (!begun)
            return fail(begun.error().code, "{}; {} stays, with nothing put out in it", begun.error().message,
                        opened->files.session.string());
    }
    return opened;
}

}  // namespace tacto
