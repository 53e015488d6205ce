#include "app/cli/ScienceModePulse.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sys/ioctl.h>
#include <unistd.h>

#include "app/cli/BenchPulse.h"
#include "app/cli/Command.h"
#include "app/cli/Confirmation.h"
#include "app/cli/TextPlot.h"
#include "app/cli/Verdicts.h"
#include "app/run/AllDrivers.h"
#include "app/run/Shipped.h"
#include "core/analysis/ResultJson.h"
#include "core/base/Text.h"
#include "core/measure/CaptureFile.h"
#include "drivers/sciencemode/PulsePlan.h"

namespace tacto::cli {

namespace {

using nlohmann::json;
using sciencemode::Measurement;
using sciencemode::SampledPulse;
using sciencemode::ScienceModeStimulator;

constexpr const char* kWord = "bench load";
constexpr Seconds kAnswerWithin = Interlock::kConfirmWithin;

/// A number that is more than, or at least, 0.
Result<double> amountOption(const QCommandLineParser& parser, const char* name, bool zeroToo) {
    const auto number = numberOption(parser, name);
    if (!number) return number;
    if (*number > 0 || (zeroToo && *number == 0)) return number;
    return fail(ErrorCode::InvalidArgument, "--{} is {}; a number {} is expected", name, *number,
                zeroToo ? "of 0 or more" : "above 0");
}

Result<PulseTrain> pulseFrom(const QCommandLineParser& parser) {
    const auto current = amountOption(parser, "current", false);
    if (!current) return failure(current);
    const auto width = amountOption(parser, "width", false);
    if (!width) return failure(width);
    const auto gap = amountOption(parser, "gap", true);
    if (!gap) return failure(gap);
    PulseTrain train;
    train.amplitude = Milliamps(*current);
    train.phaseWidth = Micros(*width);
    train.interPhaseGap = Micros(*gap);
    // One pulse has no rate; this one has room for it.
    train.rate = Hertz(std::min(train.rate.value(), 0.5 / train.pulseDuration().count()));
    return train;
}

Result<Load> loadFrom(const QCommandLineParser& parser) {
    if (!parser.isSet("load")) return fail(ErrorCode::InvalidArgument, "--load is missing");
    auto load = parseLoad(parser.value("load").toStdString());
    if (load && load->kind != LoadKind::Resistor && load->kind != LoadKind::SkinEquivalent) {
        return fail(ErrorCode::InvalidArgument, "--load is {}; a resistance is expected, as 500", load->text());
    }
    return load;
}

/// The value is an exit code when something is wrong.
tl::expected<PulseOrder, int> orderFrom(const QCommandLineParser& parser) {
    const auto wrong = [](const Error& error) { return tl::unexpected(usage("sciencemode pulse: " + error.message)); };
    auto train = pulseFrom(parser);
    if (!train) return wrong(train.error());
    auto load = loadFrom(parser);
    if (!load) return wrong(load.error());
    auto profile = shippedProfile();
    if (!profile) return tl::unexpected(couldNotRun(profile.error()));
    auto limits = shippedLimits();
    if (!limits) return tl::unexpected(couldNotRun(limits.error()));
    return PulseOrder{*train, *load, std::move(limits->sets), std::move(profile->ceilings), profile->electrodeArea};
}

/// Before anything is delivered: a record that cannot be written would be lost.
Result<void> canWrite(const std::filesystem::path& file) {
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) {
        return fail(ErrorCode::Io, "--out {} is a folder; a file's name is expected", file.string());
    }
    if (std::filesystem::is_directory(folder, error) && access(folder.c_str(), W_OK) == 0) return {};
    return fail(ErrorCode::Io, "--out {}: {} is no folder that can be written to", file.string(), folder.string());
}

Result<DeviceSet> openDevice(const DeviceUri& uri, const Clock& clock) {
    auto registry = allDrivers()();
    return registry.open({&uri, 1}, {Role::Stimulator}, OpenContext{clock});
}

std::string describe(const PulseTrain& train) {
    return fmt::format("{:g} mA, {:g} us a phase, {:g} us between", std::get<Milliamps>(train.amplitude).value(),
                       train.phaseWidth.count(), train.interPhaseGap.count());
}

/// The exit code when the operator does not want it, or is not there.
std::optional<int> confirm(const PulseOrder& order, const Stimulator& device, const SignalStop& interrupts) {
    const auto& who = device.identity();
    const auto prompt = fmt::format(
        "Stimulator {}{}: one biphasic pulse, {}, into a bench load of {}, after a check pulse of {:g} mA.\n"
        "Never into a person. Type \"{}\" within {:g} s; anything else delivers nothing: ",
        who.serial, who.simulated ? " (simulated)" : "", describe(order.pulse), order.load.text(),
        device.traits().checkCurrent.value(), kWord, kAnswerWithin.count());
    const char* why = nullptr;
    switch (askFor(kWord, prompt, kAnswerWithin, interrupts)) {
        case Answer::Confirmed:
            return std::nullopt;
        case Answer::Otherwise:
            why = "it was not confirmed";
            break;
        case Answer::TooLate:
            why = "it was not confirmed in time";
            break;
        case Answer::Signalled:
            why = "stopped by the operator (signal)";
            break;
    }
    fmt::print(stderr, "\ntactoscope-cli: {}: nothing was delivered\n", why);
    return kStopped;
}

const char* unitOf(const SampledPulse& samples) noexcept {
    return samples.measurement == Measurement::Voltage ? "V" : "mA";
}
const char* quantityOf(const SampledPulse& samples) noexcept {
    return samples.measurement == Measurement::Voltage ? "voltage magnitude" : "current magnitude";
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

const char* nameOf(ElectrodeState state) noexcept {
    switch (state) {
        case ElectrodeState::NotMeasured:
            return "not measured";
        case ElectrodeState::Ok:
            return "ok";
        case ElectrodeState::Open:
            return "open";
        case ElectrodeState::Short:
            return "short";
    }
    return "not measured";
}

json toJson(const PulseFinding& finding) {
    json samples = nullptr;
    if (finding.samples) {
        samples = {{"quantity", quantityOf(*finding.samples)},
                   {"unit", unitOf(*finding.samples)},
                   {"step_s", Seconds(finding.samples->step).count()},
                   {"samples", finding.samples->magnitudes}};
    }
    return {{"current_ma", finding.current.value()},
            {"electrode", nameOf(finding.electrode)},
            {"impedance_ohm", finding.impedance ? json(finding.impedance->value()) : json(nullptr)},
            {"read_back", std::move(samples)}};
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

/// As wide as the terminal, at most 80 columns.
int plotColumns() {
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kColumnsMost;
    return std::min<int>(size.ws_col, kColumnsMost);
}

void print(const BenchPulse& order, const PulseOutcome& outcome, const DeviceIdentity& device,
           const std::string& file) {
    const auto& finding = outcome.last();
    const auto range = order.expected();
    const auto ohms = [](Ohms value) { return formatQuantity(value.value(), "ohm", 4); };
    if (finding.samples) {
        TextPlot plot;
        plot.title =
            fmt::format("{} ({}): the device sends no sign", quantityOf(*finding.samples), unitOf(*finding.samples));
        plot.xTitle = outcome.pulse ? "time (us)" : "time (us), check pulse";
        plot.step = finding.samples->step.count();
        plot.values = finding.samples->magnitudes;
        plot.mark = order.order().pulse.phaseWidth.count();
        if (finding.impedance) plot.markText = fmt::format("|Z| {}", ohms(*finding.impedance));
        fmt::print("{}\n", draw(plot, plotColumns()));
    }
    fmt::print("  stimulator  {}\n  pulse       {}{}\n", device.serial, describe(order.order().pulse),
               outcome.pulse ? "" : ": not sent");
    fmt::print("  |Z|         {} at the end of the leading phase\n",
               finding.impedance ? ohms(*finding.impedance) : "not measured");
    fmt::print("  declared    {}: {} to {} is accepted\n", ohms(range.nominal), ohms(range.low), ohms(range.high));
    if (!file.empty()) fmt::print("  file        {}\n", file);
    if (device.simulated) fmt::print("  SIMULATED: no number here was measured on hardware.\n");
    printVerdict(outcome.verdict, outcome.reasons);
}

}  // namespace

void declarePulse(QCommandLineParser& parser) {
    parser.addOption({"current", "Current of both phases in mA, in steps of 0.5.", "MA"});
    parser.addOption({"width", "Width of each phase in us.", "US"});
    parser.addOption({"gap", "Time between the phases in us; 0, or 10 and more.", "US"});
    parser.addOption(
        {"load", "The bench load that is connected, in ohm; the limits are judged at ± 20 % of it.", "OHM"});
    parser.addOption({"yes-bench-load", "Confirms, where nobody can be asked, that a bench load is connected."});
    parser.addOption({"out", "Saves the samples that were read back as a capture.", "FILE.csv"});
}

Result<DeviceUri> scienceModeUri(const QCommandLineParser& parser) {
    const auto text = parser.isSet("device") ? parser.value("device").toStdString() : std::string("sciencemode:");
    auto uri = DeviceUri::parse(text);
    if (uri && uri->scheme != "sciencemode") {
        return fail(ErrorCode::InvalidArgument,
                    "--device is \"{}\"; a ScienceMode stimulator is expected, as "
                    "sciencemode: or sciencemode:?tty=/dev/ttyACM0",
                    text);
    }
    return uri;
}

int pulse(const QCommandLineParser& parser) {
    SignalStop interrupts;
    auto order = orderFrom(parser);
    if (!order) return order.error();
    const auto uri = scienceModeUri(parser);
    if (!uri) return failWith(uri.error());
    if (!parser.isSet("yes-bench-load") && !canAsk()) {
        return usage(
            "sciencemode pulse: nobody can be asked here, without a terminal; --yes-bench-load confirms that a "
            "bench load is connected, and no person");
    }
    auto out = parser.value("out").toStdString();
    if (!out.empty()) {
        if (const auto writable = canWrite(out); !writable) return couldNotRun(writable.error());
    }

    const SteadyClock clock;
    const auto devices = openDevice(*uri, clock);
    if (!devices) return failWith(devices.error());
    auto* device = dynamic_cast<ScienceModeStimulator*>(devices->stimulator.get());
    if (device == nullptr) {
        return couldNotRun(Error{ErrorCode::Device, uri->text() + " opened something else than a stimulator"});
    }
    if (!device->traits().readsBack) {
        return usage(
            "sciencemode pulse: --device asks for measure=current, which reads no impedance back; the pulse "
            "needs measure=voltage");
    }
    // Whatever the gate has against it is a refusal.
    const auto refused = [](const Error& error) {
        fmt::print(stderr, "tactoscope-cli: {}\n", error.message);
        return static_cast<int>(kStopped);
    };
    const auto made = BenchPulse::create(std::move(*order), *device, clock);
    if (!made) return refused(made.error());
    auto& bench = **made;
    if (const auto permitted = bench.request(); !permitted) return refused(permitted.error());
    if (const auto plan = sciencemode::planPulse(bench.order().pulse); !plan) {
        return usage("sciencemode pulse: " + plan.error().message);
    }
    if (!parser.isSet("yes-bench-load")) {
        if (const auto declined = confirm(bench.order(), *device, interrupts)) return *declined;
    }

    interrupts.onStop([&bench] { bench.stop(); });
    if (interrupts.signalled()) bench.stop();
    const auto outcome = bench.deliver();
    interrupts.onStop({});
    if (!outcome) return failWith(outcome.error());
    const auto& finding = outcome->last();
    if (!finding.samples) out.clear();
    if (!out.empty()) {
        const auto saved = writeCapture(out, captureOf(*finding.samples, device->identity().simulated));
        if (!saved) return couldNotRun(saved.error());
    }
    if (parser.isSet("json"))
        printJson(toJson(bench, *outcome, device->identity(), out));
    else
        print(bench, *outcome, device->identity(), out);
    return exitForVerdict(outcome->verdict);
}

}  // namespace tacto::cli
