#include "app/cli/ScienceModePulse.h"

#include <algorithm>
#include <filesystem>
#include <unistd.h>

#include "app/cli/BenchPulse.h"
#include "app/cli/Command.h"
#include "app/cli/PulseText.h"
#include "app/cli/TerminalOperator.h"
#include "app/cli/Verdicts.h"
#include "app/run/AllDrivers.h"
#include "app/run/Shipped.h"
#include "core/measure/CaptureFile.h"
#include "drivers/sciencemode/PulsePlan.h"

namespace tacto::cli {

namespace {

using sciencemode::ScienceModeStimulator;

constexpr const char* kWord = "bench load";
constexpr Seconds kAnswerWithin = Interlock::kConfirmWithin;

/// Returns a number option that is above 0, or at least 0 if `zeroToo`.
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
    // A single pulse has no rate, so this rate only leaves enough time for the pulse.
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

/// In case of an error, returns the exit code.
tl::expected<PulseOrder, int> pulseOrderFrom(const QCommandLineParser& parser) {
    const auto wrong = [](const Error& error) { return tl::unexpected(usage("sciencemode pulse: " + error.message)); };
    auto train = pulseFrom(parser);
    if (!train) return wrong(train.error());
    auto load = loadFrom(parser);
    if (!load) return wrong(load.error());
    auto profile = shippedProfile();
    if (!profile) return tl::unexpected(couldNotRun(profile.error()));
    auto limits = shippedLimits();
    if (limits && !addedLimitsText(*limits).empty()) say(stderr, "{}\n", addedLimitsText(*limits));
    if (!limits) return tl::unexpected(couldNotRun(limits.error()));
    return PulseOrder{*train,
                      *load,
                      std::move(limits->sets),
                      std::move(profile->ceilings),
                      profile->electrodeArea,
                      parser.isSet("reset-fault")};
}

/// Checked before anything is delivered: a record that cannot be written would be lost.
Result<void> canWrite(const std::filesystem::path& file) {
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) {
        return fail(ErrorCode::Io, "--out {} is a folder; a file's name is expected", file.string());
    }
    if (std::filesystem::is_directory(folder, error) && access(folder.c_str(), W_OK) == 0) return {};
    return fail(ErrorCode::Io, "--out {}: {} is not a folder that can be written to", file.string(), folder.string());
}

Result<DeviceSet> openDevice(const DeviceUri& uri, const Clock& clock) {
    auto registry = allDrivers()();
    return registry.open({&uri, 1}, {Role::Stimulator}, OpenContext{clock});
}

/// Returns the exit code if the operator refuses or cannot be asked.
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
    say(stderr, "\ntactoscope-cli: {}: nothing was delivered\n", why);
    return kStopped;
}

}  // namespace

void declarePulse(QCommandLineParser& parser) {
    parser.addOption({"current", "Current of both phases in mA, in steps of 0.5.", "MA"});
    parser.addOption({"width", "Width of each phase in us.", "US"});
    parser.addOption({"gap", "Time between the phases in us; 0, or 10 and more.", "US"});
    parser.addOption(
        {"load", "The bench load that is connected, in ohm; the limits are judged at ± 20 % of it.", "OHM"});
    parser.addOption({"yes-bench-load", "Confirms, where no question can be asked, that a bench load is connected."});
    parser.addOption(
        {"reset-fault", "Resets the fault in which an earlier run left the stimulator, if its cause is gone."});
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
    auto order = pulseOrderFrom(parser);
    if (!order) return order.error();
    const auto uri = scienceModeUri(parser);
    if (!uri) return failWith(uri.error());
    if (!parser.isSet("yes-bench-load") && !canAsk()) {
        return usage(
            "sciencemode pulse: without a terminal no question can be asked; --yes-bench-load confirms that a "
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
        return couldNotRun(Error{ErrorCode::Device, uri->text() + " opened something other than a stimulator"});
    }
    if (!device->traits().readsBack) {
        return usage(
            "sciencemode pulse: --device asks for measure=current, which reads no impedance back; the pulse "
            "needs measure=voltage");
    }
    // Every error from the gate is a refusal.
    const auto refused = [](const Error& error) {
        say(stderr, "tactoscope-cli: {}\n", lines(error.message));
        return static_cast<int>(kStopped);
    };
    const auto made = BenchPulse::create(std::move(*order), *device, clock);
    if (!made) {
        const bool isOfGate = made.error().code != ErrorCode::Device && made.error().code != ErrorCode::Io;
        return isOfGate ? refused(made.error()) : couldNotRun(made.error());
    }
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
