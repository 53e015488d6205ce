#include "app/cli/PulseText.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sys/ioctl.h>
#include <unistd.h>

#include "app/cli/Say.h"
#include "app/cli/TextPlot.h"
#include "app/cli/TextTable.h"
#include "app/cli/Verdicts.h"
#include "core/base/QuantityText.h"
#include "core/base/Words.h"

namespace tacto::cli {

namespace {

using nlohmann::json;
using sciencemode::Measurement;
using sciencemode::SampledPulse;

const char* unitOf(const SampledPulse& samples) noexcept {
    return samples.measurement == Measurement::Voltage ? "V" : "mA";
}
const char* quantityOf(const SampledPulse& samples) noexcept {
    return samples.measurement == Measurement::Voltage ? "voltage magnitude" : "current magnitude";
}

constexpr Word<ElectrodeState> kElectrodeStates[] = {{"not measured", ElectrodeState::NotMeasured},
                                                     {"ok", ElectrodeState::Ok},
                                                     {"open", ElectrodeState::Open},
                                                     {"short", ElectrodeState::Short}};
std::string_view nameOf(ElectrodeState state) noexcept { return wordFor(kElectrodeStates, state); }

/// Returns the values as the device sent them, in hundredths: 4.99, not the nearest float.
std::vector<double> digitsOf(const SampledPulse& samples) {
    std::vector<double> values;
    for (const float value : samples.magnitudes) values.push_back(std::round(value / sciencemode::kSampleUnit) / 100);
    return values;
}

json toJson(const PulseFinding& finding) {
    json samples = nullptr;
    if (finding.samples) {
        samples = {{"quantity", quantityOf(*finding.samples)},
                   {"unit", unitOf(*finding.samples)},
                   {"step_s", Seconds(finding.samples->step).count()},
                   {"samples", digitsOf(*finding.samples)}};
    }
    return {{"current_ma", finding.current.value()},
            {"electrode", nameOf(finding.electrode)},
            {"impedance_ohm", finding.impedance ? json(finding.impedance->value()) : json(nullptr)},
            {"read_back", std::move(samples)}};
}

/// Returns the width of the terminal, at most 80 columns.
int plotColumns() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kMaxColumns;
    return std::min<int>(size.ws_col, kMaxColumns);
}

}  // namespace

std::string describe(const PulseTrain& train) {
    return fmt::format("{:g} mA, {:g} us a phase, {:g} us between", std::get<Milliamps>(train.amplitude).value(),
                       train.phaseWidth.count(), train.interPhaseGap.count());
}

Capture captureOf(const SampledPulse& samples, bool simulated) {
    const bool volts = samples.measurement == Measurement::Voltage;
    const double unit = volts ? 1 : 1e-3;  // captures are in V and A
    CaptureChannel channel;
    channel.name = volts ? "voltage_magnitude" : "current_magnitude";
    channel.unit = volts ? "V" : "A";
    for (const float value : samples.magnitudes) channel.samples.push_back(static_cast<float>(value * unit));
    channel.lsb = sciencemode::kSampleUnit * unit;
    Capture capture;
    capture.rate_hz = 1e6 / samples.step.count();
    capture.trigger_s = std::numeric_limits<double>::quiet_NaN();
    capture.simulated = simulated;
    capture.channels.push_back(std::move(channel));
    return capture;
}

json toJson(const BenchPulse& order, const PulseOutcome& outcome, const DeviceIdentity& device,
            const std::string& file) {
    const auto& train = order.order().pulse;
    const auto range = order.expected();
    return {{"verdict", outcome.verdict},
            {"reasons", outcome.reasons},
            {"simulated", device.simulated},
            {"id", device.serial},
            {"current_ma", std::get<Milliamps>(train.amplitude).value()},
            {"width_us", train.phaseWidth.count()},
            {"gap_us", train.interPhaseGap.count()},
            {"load", order.order().load.text()},
            {"declared_ohm", range.nominal.value()},
            {"accepted_ohm", {{"low", range.low.value()}, {"high", range.high.value()}}},
            {"delivered", outcome.pulse.has_value()},
            {"check", toJson(outcome.check)},
            {"pulse", outcome.pulse ? toJson(*outcome.pulse) : json(nullptr)},
            {"file", file.empty() ? json(nullptr) : json(file)}};
}

void print(const BenchPulse& order, const PulseOutcome& outcome, const DeviceIdentity& device,
           const std::string& file) {
    const auto& finding = outcome.last();
    const auto range = order.expected();
    const auto ohms = [](Ohms value) { return scaledText(value.value(), "ohm", 4); };
    if (finding.samples) {
        TextPlot plot;
        plot.title =
            fmt::format("{} ({}): the device sends no sign", quantityOf(*finding.samples), unitOf(*finding.samples));
        plot.xTitle = outcome.pulse ? "time (us)" : "time (us), check pulse";
        plot.step = finding.samples->step.count();
        plot.values = finding.samples->magnitudes;
        plot.mark = order.order().pulse.phaseWidth.count();
        if (finding.impedance) plot.markText = fmt::format("|Z| {}", ohms(*finding.impedance));
        say("{}\n", lines(draw(plot, plotColumns())));
    }
    TextTable table({"", ""});
    table.add({"stimulator", device.serial});
    table.add({"pulse", describe(order.order().pulse) + (outcome.pulse ? "" : ": not sent")});
    table.add({"|Z|", fmt::format("{} at the end of the leading phase",
                                  finding.impedance ? ohms(*finding.impedance) : "not measured")});
    table.add(
        {"declared", fmt::format("{}: {} to {} is accepted", ohms(range.nominal), ohms(range.low), ohms(range.high))});
    if (!file.empty()) table.add({"file", file});
    table.print();
    if (device.simulated) say("  SIMULATED: no number here was measured on hardware.\n");
    printVerdict(outcome.verdict, outcome.reasons);
}

}  // namespace tacto::cli
