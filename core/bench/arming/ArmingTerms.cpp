#include "core/bench/arming/ArmingTerms.h"

#include <fmt/chrono.h>

#include "core/bench/arming/CommandPreview.h"
#include "core/devices/Device.h"
#include "core/devices/Stimulator.h"

namespace tacto {

GateSetup ArmingTerms::setupFor(const Load& load) const {
    GateSetup setup;
    setup.mode = config_.mode;
    setup.source = output_.source();
    setup.load = config_.mode == OutputMode::BenchLoad
                     ? LoadRange::declared(load)
                     : LoadRange::between(config_.profile.loadLow, config_.profile.loadHigh);
    setup.limits = config_.limits;
    setup.ceilings = config_.profile.ceilings;
    setup.electrodeArea = config_.profile.electrodeArea;
    setup.check = config_.profile.encoding.train;
    setup.check.pulses = 1;
    setup.person = config_.person;
    setup.calibration = config_.calibration;
    setup.calibrated = calibration_.applied().has_value();
    return setup;
}

std::string ArmingTerms::text(const Load& load) const {
    const Device* output = output_.device();
    if (output == nullptr) return {};
    const auto* stimulated = config_.devices.stimulator ? &output_.source() : nullptr;
    return armingText(output->identity(), stimulated, config_.profile, config_.mode, load);
}

/// Rejects a confirmation of any other text: a device, profile or area may have changed since the text was shown.
Result<void> ArmingTerms::checkConfirmed(const ArmRequest& request, const Load& load) const {
    if (request.confirmed.empty() && !output_.isReal()) return {};
    const auto shown = text(load);
    if (request.confirmed == shown) return {};
    if (request.confirmed.empty())
        return fail(ErrorCode::NotArmed, "not armed: the operator has not confirmed \"{}\"", shown);
    return fail(ErrorCode::NotArmed, "not armed: the operator confirmed \"{}\", and what would be armed is \"{}\"",
                request.confirmed, shown);
}

std::optional<BoardEncoder> ArmingTerms::boardEncoder() const noexcept {
    const auto* board = dynamic_cast<const EncodingSensor*>(config_.devices.sensor.get());
    return board != nullptr ? board->encoder() : std::nullopt;
}

bool ArmingTerms::boardDrives() const noexcept {
    const auto encoder = boardEncoder();
    return encoder && encoder->drives;
}

Result<BoardProfile> ArmingTerms::boardProfile(const Load& load) const {
    if (!config_.boardProfile) return fail(ErrorCode::NotArmed, "this program cannot tell whose profile the board has");
    auto made = config_.boardProfile(*config_.devices.sensor, config_.profile, setupFor(load));
    if (made) return made;
    return fail(ErrorCode::NotArmed, "the profile \"{}\" is not for a board that encodes: {}", config_.profile.name,
                made.error().message);
}

Result<void> ArmingTerms::checkEncoder(const Load& load) const {
    if (!boardDrives()) return {};
    if (config_.mode == OutputMode::Person)
        return fail(ErrorCode::NotArmed, "a board that encodes is for loads on a bench, not for a person");
    if (!config_.devices.stimulator)
        return fail(ErrorCode::NotArmed, "a board that encodes drives a stimulator, and none is open");
    const auto wanted = boardProfile(load);
    if (!wanted) return failure(wanted);
    const auto has = boardEncoder()->hash;
    if (wanted->hash == has) return {};
    return fail(ErrorCode::NotArmed,
                "the board encodes by a profile with hash {:08x}, and the profile \"{}\" with this stimulator and load "
                "has {:08x}; write that one into the board (tactoscope-cli firmware-profile)",
                has, config_.profile.name, wanted->hash);
}

ArmCommand ArmingTerms::commandFor(const ArmRequest& request, const Load& load, StopMark asked) const {
    ArmCommand command;
    command.asked = asked;
    command.setup = setupFor(load);
    // |Z| depends on the pulse: the range comes from the check pulse at both ends of the load range.
    const auto& source = output_.source();
    const auto leading = segmentsOf(checkTrainOf(command.setup), source.gap).items[0];
    auto& evidence = command.evidence;
    evidence.limitsLoaded = !config_.limits.empty();
    const Device* output = output_.device();
    evidence.deviceIdentified = output != nullptr && !output->identity().name.empty();
    evidence.operatorConfirmed = request.operatorConfirmed;
    evidence.needsImpedance = config_.devices.stimulator != nullptr;
    evidence.readsBack = source.readsBack;
    evidence.impedanceLow = effectiveImpedance(command.setup.load.min, leading);
    evidence.impedanceHigh = effectiveImpedance(command.setup.load.max, leading);
    // A replayed oscilloscope always shows its file, so it cannot confirm a pulse.
    const auto* scope = config_.devices.oscilloscope.get();
    const bool sees = scope != nullptr && dynamic_cast<const ReplayedDevice*>(scope) == nullptr;
    command.confirmByCapture = sees && config_.devices.stimulator && !source.readsBack;
    if (sees && !source.readsBack) command.declared = effectiveImpedance(command.setup.load.nominal, leading);
    evidence.declaredLoadConfirmed = request.declaredLoadConfirmed && config_.mode == OutputMode::BenchLoad;
    return command;
}

bool BenchCalibration::apply(bool wanted) {
    const auto next = wanted && config_.calibrationHolds ? config_.calibration : std::nullopt;
    if (next == applied_) return false;
    applied_ = next;
    return true;
}

Result<void> BenchCalibration::checkDate() const {
    if (config_.mode != OutputMode::Person || !config_.calibratedUntil) return {};
    const auto today = config_.today != nullptr
                           ? config_.today()
                           : std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
    if (today <= *config_.calibratedUntil) return {};
    return fail(ErrorCode::NotArmed,
                "the stimulator's calibration ended on {:%Y-%m-%d} and today is {:%Y-%m-%d}; calibrate it again before "
                "a person",
                *config_.calibratedUntil, today);
}

void BenchCalibration::note(const BenchNotes& notes) const {
    const bool leftAside = held() && !applied_ && !config_.calibrationText.empty();
    notes.calibration(applied_,
                      leftAside ? "left aside: the commands are programmed as they are" : config_.calibrationText);
}

Result<void> checkWhere(const BenchConfig& config) {
    const bool hasPerson = config.mode == OutputMode::Person || config.person;
    if (!hasPerson && !config.virtualParticipant) return {};
    for (const Device* device : {static_cast<const Device*>(config.devices.stimulator.get()),
                                 static_cast<const Device*>(config.devices.massager.get())}) {
        if (device == nullptr) continue;
        const auto& identity = device->identity();
        if (config.virtualParticipant && !identity.simulated) {
            return invalid("a virtual participant cannot use the real device {}; use a simulated one", identity.name);
        }
        if (!config.virtualParticipant && identity.simulated && !config.rehearsal) {
            return invalid(
                "a person on {}, which delivers nothing; a device is accepted, a simulated one in a rehearsal",
                identity.name);
        }
    }
    return {};
}

BenchConfig withStatedCalibration(BenchConfig config) {
    const auto* stimulator = config.devices.stimulator.get();
    if (config.mode != OutputMode::Person || config.calibration || stimulator == nullptr) return config;
    if (!stimulator->identity().simulated) return config;
    const auto* stating = dynamic_cast<const StatesCalibration*>(stimulator);
    if (stating == nullptr || !stating->statedCalibration()) return config;
    config.calibration = stating->statedCalibration();
    config.calibrationHolds = true;
    config.calibratedUntil.reset();
    config.calibrationText = "as the simulated stimulator states";
    return config;
}

}  // namespace tacto
