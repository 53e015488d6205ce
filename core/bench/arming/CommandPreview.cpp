#include "core/bench/arming/CommandPreview.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/base/Clock.h"
#include "core/encoding/Encoder.h"
#include "core/safety/SafetyGate.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

namespace {

/// Makes an ideal source: no amplitude steps, and no ceiling except the standard's 500 V.
SourceTraits idealVoltageSource() {
    SourceTraits source;
    source.drive = Drive::Voltage;
    source.amplitudeMax = 500;
    source.compliance = Volts(500);
    source.widthStep = Micros(0);
    source.widthMin = Micros(1);
    source.widthMax = Micros(100'000);
    return source;
}

}  // namespace

Result<CommandPreview> previewOf(const Command& command, const Profile& profile, const std::vector<LimitSet>& limits,
                                 const Load& load) {
    if (const auto valid = validate(profile.encoding); !valid) return failure(valid);
    GateSetup setup;
    setup.source = idealVoltageSource();
    setup.load = LoadRange::declared(load);
    setup.limits = limits;
    setup.ceilings = profile.ceilings;
    setup.electrodeArea = profile.electrodeArea;
    setup.check = profile.encoding.train;
    const VirtualClock clock;
    SafetyGate gate(clock);
    if (const auto configured = gate.configure(setup); !configured) return failure(configured);
    const auto train = voltageTrain(profile.encoding, command.amplitude);
    CommandPreview preview{impedanceOf(load, train, setup.source), exposureTable(setup, train, command.interval), {}};
    const auto approved = gate.approve(TrainRequest{train, command.interval, Instant(0)});
    if (!approved) preview.refusal = approved.error();
    return preview;
}

std::optional<std::string> beyondReach(const Profile& profile, const SourceTraits& source, std::string_view device) {
    const double low = profile.encoding.amplitudeMin.value();
    const double high = profile.encoding.amplitudeMax.value();
    double most = source.compliance.value() > 0 ? source.compliance.value() : high;
    std::string how;
    if (source.drive == Drive::Voltage) {
        most = std::min(most, source.amplitudeMax);
    } else {
        // A current source reaches the highest voltage at the highest load.
        const double byCurrent = source.amplitudeMax * 1e-3 * profile.loadHigh.value();
        if (byCurrent < most) {
            most = byCurrent;
            how = fmt::format(" ({:g} mA into {:g} Ω, the profile's highest load)", source.amplitudeMax,
                              profile.loadHigh.value());
        }
    }
    if (most >= high) return std::nullopt;
    return fmt::format(
        "The profile \"{}\" asks for {:g} to {:g} V, and {} delivers {:g} V at most{}: {} will be refused or fall "
        "short. "
        "Choose a profile whose amplitude_max_v is {:g} or less, or another stimulator.",
        profile.name, low, high, device, most, how, most < low ? "all its trains" : "trains above that", most);
}

std::optional<std::string> madeWithAnother(const Profile& profile, std::string_view serial) {
    const auto& sensor = profile.roughness.sensor;
    if (!sensor || matchOf(*sensor, serial) != FingertipMatch::Another) return std::nullopt;
    return fmt::format(
        "the profile \"{}\" was made with the fingertip {}, and this one is {}: its scales of force and taxels are "
        "left "
        "aside, and R is uncalibrated. Calibrate this fingertip, or choose its own profile",
        profile.name, sensor->fingertip, serial);
}

namespace {

/// Returns the device's own text with every character replaced that could do more than name it.
std::string plain(std::string_view said) {
    constexpr std::string_view kKept = " ._:+,()/#=-";
    std::string out(said);
    for (char& c : out) {
        const bool isLetter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (!isLetter && kKept.find(c) == std::string_view::npos) c = '?';
    }
    return out;
}

LoadRange rangeOf(const Profile& profile, OutputMode mode, const Load& load) {
    return mode == OutputMode::BenchLoad ? LoadRange::declared(load)
                                         : LoadRange::between(profile.loadLow, profile.loadHigh);
}

/// Returns the largest peaks that the encoding can request at any |Z| in the range.
std::string mostOf(const SourceTraits& source, const EncodingProfile& encoding, const LoadRange& range) {
    double volts = encoding.amplitudeMax.value();
    const double low = impedanceOf(range.min, encoding.train, source).value();
    const double high = impedanceOf(range.max, encoding.train, source).value();
    // An encoding that holds charge or energy raises the voltage with the impedance, at most to twice its value: see
    // heldAmplitude().
    if (encoding.hold != Hold::Voltage && std::isfinite(high / low)) volts *= std::min(2.0, high / low);
    double most_mA = 1e3 * volts / low;
    if (source.drive == Drive::Current) {
        most_mA = low > 0 ? std::min(most_mA, source.amplitudeMax) : source.amplitudeMax;
    } else {
        const auto most =
            worstExposure(voltageTrain(encoding, Volts(volts)), encoding.intervalMin, range, source, std::nan(""));
        most_mA = most.at(Quantity::PeakCurrent);
    }
    return std::isfinite(most_mA) ? fmt::format("up to {:.3g} V and {:.3g} mA", volts, most_mA)
                                  : fmt::format("up to {:.3g} V", volts);
}

}  // namespace

std::string armingText(const DeviceIdentity& output, const SourceTraits* source, const Profile& profile,
                       OutputMode mode, const Load& load) {
    auto text = plain(output.name);
    if (!output.serial.empty()) text += " " + plain(output.serial);
    if (source == nullptr) return text + ", vibrating up to its strongest";
    text += mode == OutputMode::BenchLoad ? " into " + load.text() : std::string(" into a person");
    if (!source->readsBack) text += " (declared, not measured)";
    text += ", " + mostOf(*source, profile.encoding, rangeOf(profile, mode, load));
    text += profile.electrodeArea ? fmt::format(", electrode area {:g} cm2", profile.electrodeArea->value())
                                  : std::string(", electrode area not stated");
    return text;
}

}  // namespace tacto
