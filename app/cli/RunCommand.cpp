#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "app/cli/Command.h"
#include "app/cli/Profiles.h"
#include "app/cli/RunFiles.h"
#include "app/cli/SignalStop.h"
#include "app/cli/Verdicts.h"
#include "app/report/Report.h"
#include "app/scripting/ProtocolLibrary.h"
#include "app/scripting/ScriptRun.h"
#include "core/bench/Bench.h"
#include "core/session/Digest.h"
#include "core/session/SessionWriter.h"

namespace tacto::cli {

namespace {

using nlohmann::json;

void declare(QCommandLineParser& parser) {
    parser.addOption({"device", "A device to use; sim: fills every role that is still needed.", "URI"});
    parser.addOption({"set", "A parameter of the protocol, or an answer to one of its questions.", "KEY=VALUE"});
    parser.addOption({"seed", "Seed of everything random (1).", "N"});
    parser.addOption({"realtime", "Runs on the real clock even where a virtual one could serve."});
    parser.addOption({"profile", "Profile to use instead of the shipped one.", "F"});
    parser.addOption({"out", "Folder for the session, its reports and its captures.", "DIR"});
    parser.addOption({"json", "Prints one JSON value."});
}

/// All that the command line says, checked.
struct Order {
    ProtocolSource script;
    ProtocolDeclaration declaration;
    ProtocolSettings settings;
    std::uint64_t seed = 1;
    std::vector<DeviceUri> uris;
    bool realtime = false;
};

Result<std::map<std::string, std::string>> settingsFrom(const QCommandLineParser& parser) {
    std::map<std::string, std::string> settings;
    for (const auto& given : parser.values("set")) {
        const auto text = given.toStdString();
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            return fail(ErrorCode::InvalidArgument, "--set {}: KEY=VALUE is expected", text);
        }
        settings[text.substr(0, equals)] = text.substr(equals + 1);
    }
    return settings;
}

Result<std::uint64_t> seedFrom(const QCommandLineParser& parser) {
    if (!parser.isSet("seed")) return 1;
    bool isNumber = false;
    const auto seed = parser.value("seed").toULongLong(&isNumber);
    if (isNumber) return seed;
    return fail(ErrorCode::InvalidArgument, "--seed is \"{}\"; a whole number from 0 is expected",
                parser.value("seed").toStdString());
}

/// The value is an exit code when something is wrong.
tl::expected<Order, int> orderFrom(const QCommandLineParser& parser) {
    const auto name = onlyArgument(parser, "PROTOCOL");
    if (!name) return tl::unexpected(usage("run: " + name.error().message));
    Order order;
    const auto settings = settingsFrom(parser);
    if (!settings) return tl::unexpected(usage("run: " + settings.error().message));
    const auto seed = seedFrom(parser);
    if (!seed) return tl::unexpected(usage("run: " + seed.error().message));
    order.seed = *seed;
    order.realtime = parser.isSet("realtime");
    for (const auto& text : parser.values("device")) {
        const auto uri = DeviceUri::parse(text.toStdString());
        if (!uri) return tl::unexpected(usage("run: " + uri.error().message));
        order.uris.push_back(*uri);
    }
    auto script = ProtocolLibrary().find(*name);
    if (!script) {
        const bool isFile = name->find('/') != std::string::npos || name->ends_with(".js");
        return tl::unexpected(isFile ? couldNotRun(script.error()) : usage("run: " + script.error().message));
    }
    order.script = std::move(*script);
    auto declaration = readDeclaration(order.script);
    if (!declaration) return tl::unexpected(couldNotRun(declaration.error()));
    order.declaration = std::move(*declaration);
    auto applied = applySettings(order.declaration, *settings);
    if (!applied) return tl::unexpected(usage("run: " + applied.error().message));
    order.settings = std::move(*applied);
    return order;
}

/// The load that the protocol's parameters declare: what the simulated bench starts with.
std::string declaredLoad(const json& parameters) {
    const auto load = parameters.find("load");
    if (load == parameters.end()) return kDefaultLoad;
    return load->is_number() ? fmt::format("{} ohm", load->get<double>()) : load->get<std::string>();
}

SessionAbout aboutOf(const Order& order, const DeviceSet& devices, const Profile& profile,
                     const ShippedLimits& limits) {
    SessionAbout about;
    about.programVersion = TACTOSCOPE_VERSION;
    about.protocol = order.script.name;
    about.protocolSha256 = order.script.sha256;
    about.parameters = order.settings.parameters;
    about.seed = order.seed;
    for (const auto& device : devices.identities()) {
        about.devices.push_back({device.uri, std::string(nameOf(device.role)), device.name, device.serial,
                                 device.firmware, device.simulated});
        about.simulated = about.simulated || device.simulated;
    }
    about.profileJson = toJson(profile).dump();
    for (std::size_t i = 0; i < limits.sets.size(); ++i)
        about.limitSets.push_back({limits.sets[i].id, limits.sha256[i]});
    about.mode = nameOf(OutputMode::BenchLoad);
    about.wallStart = wallTimeUtc();
    return about;
}

/// One line on a terminal, rewritten; nothing elsewhere.
class ProgressLine {
public:
    void show(const ScriptProgress& progress) {
        using std::chrono::steady_clock;
        const auto now = steady_clock::now();
        if (!terminal_ || now - begun_ < std::chrono::seconds(1) || now - shown_ < std::chrono::milliseconds(100))
            return;
        shown_ = now;
        const auto part =
            progress.total > 0 ? static_cast<double>(progress.done) / static_cast<double>(progress.total) : 0;
        const double left = part > 0 ? std::chrono::duration<double>(now - begun_).count() * (1 - part) / part : 0;
        const auto filled = static_cast<std::size_t>(part * 30);
        fmt::print(stderr, "\r\033[K{} [{}{}] {}/{}, {:.0f} s left", progress.label, std::string(filled, '#'),
                   std::string(30 - filled, '.'), progress.done, progress.total, left);
        std::fflush(stderr);
        drawn_ = true;
    }
    void clear() {
        if (std::exchange(drawn_, false)) fmt::print(stderr, "\r\033[K");
    }

private:
    const bool terminal_ = isatty(STDERR_FILENO) != 0;
    const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point shown_{};
    bool drawn_ = false;
};

struct Finished {
    ScriptOutcome outcome;
    bool stoppedBySafety = false;
};

Finished runScript(const Order& order, Bench& bench, SessionWriter& session, const RunFiles& files,
                   SignalStop& interrupts) {
    PresetOperator desk(order.settings.answers);
    ProgressLine line;
    RunRequest request;
    request.script = order.script;
    request.parameters = order.settings.parameters;
    request.seed = order.seed;
    request.bench = &bench;
    request.session = &session;
    request.operatorDesk = &desk;
    request.captureFolder = files.captures;
    request.onProgress = [&](const ScriptProgress& progress) { line.show(progress); };
    request.onLog = [&](const std::string& text) {
        line.clear();
        fmt::print(stderr, "{}\n", text);
    };
    auto run = ScriptRun::start(std::move(request));
    if (!run) {
        Finished failed;
        failed.outcome.error = run.error();
        return failed;
    }
    interrupts.onStop([&run] { (*run)->stop("operator (signal)"); });
    if (interrupts.signalled()) (*run)->stop("operator (signal)");
    Finished finished;
    finished.outcome = (*run)->wait();
    interrupts.onStop({});
    line.clear();
    finished.stoppedBySafety = bench.faults() > 0;
    return finished;
}

int exitFor(const Finished& finished) {
    if (finished.stoppedBySafety) return kStopped;
    if (!finished.outcome.error) return exitForVerdict(nameOf(finished.outcome.verdict));
    const auto code = finished.outcome.error->code;
    const bool safety = code == ErrorCode::LimitExceeded || code == ErrorCode::NotArmed || code == ErrorCode::Stopped;
    return safety ? kStopped : kCouldNotRun;
}

void printSummary(const Finished& finished, const json& value) {
    const auto& outcome = finished.outcome;
    if (outcome.results.is_object() && outcome.results.contains("confusion"))
        printSeparability(outcome.results);
    else if (outcome.results.is_object())
        printResults(outcome.results);
    fmt::print("\n");
    if (value["simulated"].get<bool>()) fmt::print("  SIMULATED: no number here was measured on hardware.\n");
    printVerdict(value["verdict"].is_string() ? value["verdict"].get<std::string>()
                 : outcome.error              ? "none: the run ended before there was one"
                                              : "none: this protocol judges nothing",
                 outcome.error ? std::vector<std::string>{} : outcome.reasons);
    fmt::print("  session  {}\n", value["session"].get<std::string>());
    if (value["report"].is_string()) fmt::print("  report   {}\n", value["report"].get<std::string>());
}

int run(const QCommandLineParser& parser) {
    SignalStop interrupts;
    const auto order = orderFrom(parser);
    if (!order) return order.error();
    const auto profile = profileOption(parser);
    if (!profile) return couldNotRun(profile.error());
    const auto limits = shippedLimits();
    if (!limits) return couldNotRun(limits.error());

    auto registry = makeRegistry();
    const auto allVirtual = registry.allVirtual(order->uris);
    if (!allVirtual) return failWith(allVirtual.error());
    std::shared_ptr<Clock> clock;
    if (*allVirtual && !order->realtime)
        clock = std::make_shared<VirtualClock>();
    else
        clock = std::make_shared<SteadyClock>();
    auto devices = registry.open(order->uris, order->declaration.needs,
                                 OpenContext{*clock, order->seed, declaredLoad(order->settings.parameters)});
    if (!devices) return failWith(devices.error());

    const auto files = prepareRunFiles(parser.value("out").toStdString(), order->script.name);
    if (!files) return failWith(files.error());
    const auto about = aboutOf(*order, *devices, *profile, *limits);
    auto session = SessionWriter::create(files->session, about, *clock);
    if (!session) return couldNotRun(session.error());

    Finished finished;
    {
        BenchConfig config;
        config.devices = std::move(*devices);
        config.clock = clock;
        config.profile = *profile;
        config.limits = limits->sets;
        config.session = session->get();
        auto bench = Bench::create(std::move(config));
        if (!bench) return couldNotRun(bench.error());
        finished = runScript(*order, **bench, **session, *files, interrupts);
        if (finished.outcome.abandoned) {
            // The script's thread still runs and may never end: what it could touch is left as it is.
            static_cast<void>(bench->release());
        }
    }
    const auto& outcome = finished.outcome;
    if (outcome.error) fmt::print(stderr, "tactoscope-cli: {}\n", outcome.error->message);
    if (const auto closed = (*session)->close(outcome.error ? "ended by an error" : "finished"); !closed) {
        fmt::print(stderr, "tactoscope-cli: {}\n", closed.error().message);
    }

    const int exitCode = exitFor(finished);
    json report = nullptr;
    for (const auto* ending : {".html", ".pdf"}) {
        const auto path = files->report(ending);
        const auto made =
            writeSessionReport(QString::fromStdString(files->session.string()), QString::fromStdString(path.string()));
        if (made)
            report = path.string();
        else
            fmt::print(stderr, "tactoscope-cli: no report: {}\n", made.error().message);
    }
    const auto verdict = exitCode == kStopped ? std::string("stopped") : std::string(nameOf(outcome.verdict));
    const json value{{"protocol", order->script.name},
                     {"verdict", verdict.empty() ? json(nullptr) : json(verdict)},
                     {"simulated", about.simulated},
                     {"seed", order->seed},
                     {"session", files->session.string()},
                     {"report", report},
                     {"results", outcome.results},
                     {"reasons", outcome.reasons},
                     {"error", outcome.error ? json(outcome.error->message) : json(nullptr)}};
    if (parser.isSet("json"))
        printJson(value);
    else
        printSummary(finished, value);
    if (outcome.abandoned) {
        std::fflush(nullptr);
        std::_Exit(exitCode);
    }
    return exitCode;
}

}  // namespace

const Command kRun{"run",
                   "PROTOCOL [--device URI]... [--set KEY=VALUE]... [--seed N] [--realtime] [--out DIR] [--json]",
                   "Runs a protocol script, records it and writes its report",
                   true,
                   declare,
                   run};

}  // namespace tacto::cli
