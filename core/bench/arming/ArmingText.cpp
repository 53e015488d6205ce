#include "core/bench/arming/ArmingText.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/encoding/Encoder.h"
#include "core/safety/TrainExposure.h"

namespace tacto {

namespace {

/// What a device says of itself, with everything replaced that is more than a name.
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

/// The largest peaks that the encoding can ask for at any |Z| in the range.
std::string mostOf(const SourceTraits& source, const EncodingProfile& encoding, const LoadRange& range) {
    double volts = encoding.amplitudeMax.value();
    const double low = impedanceOf(range.min, encoding.train, source).value();
    const double high = impedanceOf(range.max, encoding.train, source).value();
    // An encoding that holds charge or energy follows the impedance up, at most to twice what it was: see
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
