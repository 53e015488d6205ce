#include "app/cli/SensorCompare.h"

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/cli/CaptureOptions.h"
#include "app/cli/Command.h"
#include "app/cli/EncoderOptions.h"
#include "app/cli/TextTable.h"
#include "app/cli/Verdicts.h"
#include "app/run/AllDrivers.h"
#include "app/run/EncoderComparison.h"
#include "app/run/Shipped.h"
#include "app/run/SignalStop.h"

namespace tacto::cli {

namespace {

struct Compared {
    EncoderAgreement found;
    std::size_t refused = 0;  ///< by the bench
    bool simulated = false;

    /// Where no train was due, or something was lost on the way, nothing is shown.
    [[nodiscard]] const char* verdict() const {
        if (found.lost > 0) return "indeterminate";
        if (!found.holds()) return "fail";
        return found.trains + refused > 0 ? "pass" : "indeterminate";
    }
};

/// A file is a recording; anything else is a device's address.
Result<DeviceUri> addressOf(const std::string& text) {
    std::error_code absent;
    if (std::filesystem::exists(text, absent)) return DeviceUri{"recording", text, {}};
    const auto uri = DeviceUri::parse(text);
    if (!uri) return fail(ErrorCode::NotFound, "\"{}\" is neither a file nor a folder nor a device's address", text);
    return uri;
}

/// Lets both sides take what comes for `seconds`, or until nothing more comes or Ctrl+C is pressed.
Result<Compared> compareOn(const DeviceUri& uri, const Profile& profile, EncoderOutput output,
                           const std::vector<LimitSet>& limits, double seconds, const SignalStop& interrupts) {
    auto registry = allDrivers()();
    const auto isVirtual = registry.allVirtual({&uri, 1});
    if (!isVirtual) return failure(isVirtual);
    VirtualClock simulated;
    const SteadyClock steady;
    const Clock& clock = *isVirtual ? static_cast<const Clock&>(simulated) : steady;
    auto devices = registry.open({&uri, 1}, {Role::Sensor}, OpenContext{clock});
    if (!devices) return failure(devices);
    output.ceilings = profile.ceilings;
    auto comparison = EncoderComparison::create(*devices->sensor, profile, output, limits, clock);
    if (!comparison) return failure(comparison);
    const Instant begin = clock.now();
    for (bool last = false; !last && !interrupts.signalled() && toSeconds(clock.now() - begin) < seconds;) {
        last = devices->sensor->finished();
        if (const auto turned = (*comparison)->turn(); !turned) return failure(turned);
        if (*isVirtual)
            simulated.advanceTo(clock.now() + EncoderComparison::kTurn);
        else
            std::this_thread::sleep_for(EncoderComparison::kTurn);
    }
    return Compared{(*comparison)->agreement(), (*comparison)->bench().refused_s.size(),
                    devices->sensor->identity().simulated};
}

void printCompared(const Compared& compared) {
    const auto& found = compared.found;
    if (compared.simulated) say("SIMULATED: no number here was measured on hardware.\n");
    say("{} frames and {} trains that both made; the largest differences:\n", found.frames, found.trains);
    TextTable table({"", ">differs by", "accepted"});
    table.add({"roughness R", fmt::format("{:.2g}", found.maxR), fmt::format("{}", found.acceptedR)});
    table.add({"pressure P", fmt::format("{:.2g}", found.maxP), fmt::format("{}", found.acceptedP)});
    table.add({"amplitude", fmt::format("{:.2g} %", 100 * found.maxAmplitude),
               fmt::format("{:.2g} %", 100 * found.acceptedAmplitude)});
    table.add({"onset", fmt::format("{:.2g} ms", 1e3 * found.maxOnset_s),
               fmt::format("{:.3g} ms", 1e3 * found.acceptedOnset_s)});
    table.print();
    std::vector<std::string> reasons;
    if (found.lost > 0)
        reasons.push_back(fmt::format("{} blocks or messages of the board were lost on the way here", found.lost));
    if (!found.unlike.empty()) reasons.push_back(found.unlike);
    if (found.trains + compared.refused == 0) reasons.emplace_back("no train was due: nothing slid under the finger");
    printVerdict(compared.verdict(), reasons);
}

}  // namespace

int compareSensor(const QCommandLineParser& parser, double seconds) {
    const auto given = parser.positionalArguments();
    if (given.size() != 2) return usage("sensor compare: one RECORDING or URI is expected");
    const auto uri = addressOf(given.at(1).toStdString());
    if (!uri) return couldNotRun(uri.error());
    const auto profile = profileOption(parser);
    if (!profile) return couldNotRun(profile.error());
    EncoderOutput output = idealOutput();
    if (encoderOptionsGiven(parser)) {
        const auto bench = encoderBench(parser);
        if (!bench) {
            const bool wrong = bench.error().code == ErrorCode::InvalidArgument;
            return wrong ? usage("sensor compare: " + bench.error().message) : couldNotRun(bench.error());
        }
        if (!bench->streams.empty()) return usage("sensor compare: --device is the address of a stimulator");
        output = bench->output;
    }
    const auto limits = shippedLimits();
    if (!limits) return couldNotRun(limits.error());
    const bool endless = uri->scheme != "recording";
    const SignalStop interrupts;
    const auto compared = compareOn(*uri, *profile, output, limits->sets, endless ? seconds : 1e9, interrupts);
    if (!compared) return couldNotRun(compared.error());
    const auto& found = compared->found;
    if (parser.isSet("json")) {
        printJson({{"frames", found.frames},
                   {"trains", found.trains},
                   {"max_dR", found.maxR},
                   {"max_dP", found.maxP},
                   {"max_dA_pct", 100 * found.maxAmplitude},
                   {"max_onset_s", found.maxOnset_s},
                   {"refused_alike", found.refusedAlike},
                   {"lost", found.lost},
                   {"unlike", found.unlike.empty() ? nlohmann::json(nullptr) : nlohmann::json(found.unlike)},
                   {"simulated", compared->simulated},
                   {"verdict", compared->verdict()}});
    } else {
        printCompared(*compared);
    }
    return exitForVerdict(compared->verdict());
}

}  // namespace tacto::cli
