#include "core/bench/arming/ProfileReach.h"

#include <algorithm>

namespace tacto {

std::optional<std::string> beyondReach(const Profile& profile, const SourceTraits& source, std::string_view device) {
    const double low = profile.encoding.amplitudeMin.value();
    const double high = profile.encoding.amplitudeMax.value();
    double most = source.compliance.value() > 0 ? source.compliance.value() : high;
    std::string how;
    if (source.drive == Drive::Voltage) {
        most = std::min(most, source.amplitudeMax);
    } else {
        // A current source reaches the voltage most easily where the load is highest.
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

}  // namespace tacto
