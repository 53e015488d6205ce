#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "app/cli/CaptureOptions.h"
#include "app/cli/Command.h"
#include "app/cli/ReportProgram.h"
#include "app/cli/TerminalOperator.h"
#include "app/cli/Verdicts.h"
#include "app/run/AllDrivers.h"
#include "app/run/PilotRun.h"
#include "app/run/ProtocolRun.h"
#include "app/run/Shipped.h"
#include "app/run/SignalStop.h"
#include "app/scripting/engine/Arming.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "app/scripting/wire/ScriptMessage.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/base/ProgramStart.h"
#include "core/calibration/CertificateDetails.h"
#include "core/devices/Registry.h"
#include "core/dsp/RoughnessFlags.h"
#include "core/kinds/ResultKinds.h"
#include "core/session/Origin.h"

namespace tacto::cli {

namespace {

using nlohmann::json;

void declareRun(QCommandLineParser& parser) {
    parser.addOption({"device", "A device to use; sim: fills every role that is still needed.", "URI"});
    parser.addOption({"set", "A parameter of the protocol, or an answer to one of its questions.", "KEY=VALUE"});
    parser.addOption({"seed", "Seed of everything random (1).", "N"});
    parser.addOption(
        {"reset-fault", "Resets the fault in which an earlier run left the stimulator, if its cause is gone."});
    parser.addOption({"realtime", "Runs on the real clock even where a virtual one could serve."});
    parser.addOption({"profile", "Profile to use instead of the shipped one.", "F"});
    parser.addOption({"operator", "Who runs the protocol, for its report.", "NAME"});
    parser.addOption({"sample", "What is measured, by the laboratory's own id, for its report.", "ID"});
    parser.addOption({"reviewer", "Who checks it, for its report.", "NAME"});
    parser.addOption({"ambient", "Ambient conditions, for its report: \"22.5 °C, 45 % RH\".", "TEXT"});
    parser.addOption({"certificate-details",
                      "JSON file of what the certificate of a stimulator calibration says beside: laboratory, address, "
                      "place, number, customer, contact, make, model, serial, condition, received, issued, "
                      "authorised_by, function.",
                      "F"});
    parser.addOption({"out", "Folder for the session, its reports and its captures.", "DIR"});
    parser.addOption(
        {"passphrase-file", "File whose first line is the study's passphrase, for sessions of a study.", "F"});
    parser.addOption({"markers",
                      "Of a pilot session: where recorders of EEG or EMG connect for its markers, a port of this "
                      "computer or ADDRESS:PORT.",
                      "PORT"});
    parser.addOption(
        {"lsl",
         "Sends what the session records, while it does, as streams of the Lab Streaming Layer: "
         "Tactoscope-markers, Tactoscope-frames and Tactoscope-trains; of a pilot session its markers alone. "
         "Needs liblsl and real time."});
    parser.addOption({"lsl-markers",
                      "Takes the texts of another program's LSL stream into the session, as the operator's marks.",
                      "NAME"});
    parser.addOption({"report", "Which report is written: none, html or pdf; both where left out.", "KIND"});
    parser.addOption({"json", "Prints one JSON value."});
}

/// Returns the file endings of the requested reports. Errors: InvalidArgument for an unknown kind.
Result<std::vector<const char*>> reportsFrom(const QCommandLineParser& parser) {
    if (!parser.isSet("report")) return std::vector<const char*>{".html", ".pdf"};
    const auto kind = parser.value("report").toStdString();
    if (kind == "none") return std::vector<const char*>{};
    if (kind == "html") return std::vector<const char*>{".html"};
    if (kind == "pdf") return std::vector<const char*>{".pdf"};
    return fail(ErrorCode::InvalidArgument, "--report is \"{}\"; none, html or pdf is expected", kind);
}

Result<std::map<std::string, std::string>> settingsFrom(const QCommandLineParser& parser) {
    std::map<std::string, std::string> settings;
    for (const auto& given : parser.values("set")) {
        const auto text = given.toStdString();
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            return fail(ErrorCode::InvalidArgument, "--set {}: KEY=VALUE is expected", text);
        }
        const auto key = text.substr(0, equals);
        const auto [at, isNew] = settings.emplace(key, text.substr(equals + 1));
        if (isNew) continue;
        // A run that arms several loads needs several confirmations: see OperatorQuestion::confirms.
        if (key != kConfirmArming) return fail(ErrorCode::InvalidArgument, "{}", givenTwice("--set {}", key));
        at->second += '\n' + text.substr(equals + 1);
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

/// In case of an error, returns the exit code.
tl::expected<RunOrder, int> orderFrom(const QCommandLineParser& parser, const SignalStop& interrupts) {
    const auto name = onlyArgument(parser, "PROTOCOL");
    if (!name) return tl::unexpected(usage("run: " + name.error().message));
    RunOrder order;
    const auto settings = settingsFrom(parser);
    if (!settings) return tl::unexpected(usage("run: " + settings.error().message));
    const auto seed = seedFrom(parser);
    if (!seed) return tl::unexpected(usage("run: " + seed.error().message));
    order.seed = *seed;
    order.realtime = parser.isSet("realtime");
    order.resetFault = parser.isSet("reset-fault");
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
    auto declaration =
        readDeclaration(order.script, std::chrono::seconds(1), [&interrupts] { return interrupts.signalled(); });
    if (!declaration) {
        const bool stopped = declaration.error().code == ErrorCode::Stopped;
        return tl::unexpected(stopped ? failWith(declaration.error()) : couldNotRun(declaration.error()));
    }
    order.declaration = std::move(*declaration);
    auto applied = applySettings(order.declaration, *settings);
    if (!applied) return tl::unexpected(usage("run: " + applied.error().message));
    order.settings = std::move(*applied);
    auto profile = profileOption(parser);
    if (!profile) return tl::unexpected(couldNotRun(profile.error()));
    order.profile = std::move(*profile);
    auto limits = shippedLimits();
    if (!limits) return tl::unexpected(couldNotRun(limits.error()));
    order.limits = std::move(*limits);
    if (const auto added = addedLimitsText(order.limits); !added.empty()) say(stderr, "{}\n", added);
    order.out = parser.value("out").toStdString();
    order.notes = {parser.value("operator").toStdString(), parser.value("sample").toStdString(),
                   parser.value("reviewer").toStdString(), parser.value("ambient").toStdString()};
    if (const auto checked = checkNotes(order.notes); !checked)
        return tl::unexpected(usage("run: " + checked.error().message));
    order.lsl = {parser.isSet("lsl"), parser.value("lsl-markers").toStdString()};
    if (parser.isSet("lsl-markers"))
        if (const auto named = LslNotes::checkName(order.lsl.markers); !named)
            return tl::unexpected(usage("run: " + named.error().message));
    order.certificateDetails = parser.value("certificate-details").toStdString();
    if (!order.certificateDetails.empty()) {
        if (resultTraits(order.declaration.kind).kind != ResultKind::StimulatorCalibration) {
            return tl::unexpected(
                usage(fmt::format("run: --certificate-details is given for {}; a stimulator calibration is expected",
                                  order.script.name)));
        }
        // Checked before devices are opened.
        if (const auto read = certificateDetails(order.certificateDetails, utcToday()); !read)
            return tl::unexpected(couldNotRun(read.error()));
    }
    return order;
}

/// Prints one line on a terminal and rewrites it; prints nothing elsewhere.
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
        say(stderr, "\r\033[K{} [{}{}] {}/{}, {:.0f} s left", progress.label, std::string(filled, '#'),
            std::string(30 - filled, '.'), progress.done, progress.total, left);
        std::fflush(stderr);
        drawn_ = true;
    }
    void clear() {
        if (std::exchange(drawn_, false)) say(stderr, "\r\033[K");
    }

private:
    const bool terminal_ = isatty(STDERR_FILENO) != 0;
    const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point shown_{};
    bool drawn_ = false;
};

/// A run of a protocol, inside or outside a study.
struct Running {
    std::unique_ptr<ProtocolRun> alone;
    std::unique_ptr<PilotRun> session;

    [[nodiscard]] ProtocolRun& run() const { return session ? session->run() : *alone; }
    [[nodiscard]] Result<void> start(RunRequest hooks) const {
        return session ? session->start(std::move(hooks)) : alone->start(std::move(hooks));
    }
    [[nodiscard]] RunResult finish() const { return session ? session->finish() : alone->finish(); }
};

Result<Running> prepareRun(RunOrder order, const QCommandLineParser& parser, Registry& registry) {
    Running running;
    if (!resultTraits(order.declaration.kind).ofStudy || !order.script.shipped) {
        if (parser.isSet("markers"))
            return fail(ErrorCode::InvalidArgument, "run: --markers is given for {}; only pilot sessions send markers",
                        order.script.name);
        auto alone = ProtocolRun::prepare(std::move(order), registry);
        if (!alone) return failure(alone);
        running.alone = std::move(*alone);
        return running;
    }
    PilotOrder pilot;
    pilot.study = order.out;
    if (parser.isSet("passphrase-file")) {
        auto passphrase = Passphrase::fromFile(parser.value("passphrase-file").toStdString());
        if (!passphrase) return failure(passphrase);
        pilot.passphrase = std::move(*passphrase);
    }
    if (parser.isSet("markers")) {
        const auto at = MarkerAddress::parse(parser.value("markers").toStdString());
        if (!at) return failure(at);
        pilot.markers = *at;
    }
    auto session = PilotRun::prepare(std::move(order), std::move(pilot), registry);
    if (!session) return failure(session);
    running.session = std::move(*session);
    for (const auto& remark : running.session->remarks()) say(stderr, "{}\n", lines(remark));
    return running;
}

constexpr std::size_t kMaxLogLine = 1000;  // bytes; the printed line fits into a pipe at once

RunResult runScript(const Running& running, const std::map<std::string, std::string>& answers, SignalStop& interrupts) {
    auto& run = running.run();
    ProgressLine line;
    TerminalOperator desk(answers, interrupts, [&line] { line.clear(); });
    RunRequest hooks;
    hooks.operatorDesk = &desk;
    hooks.onProgress = [&](const ScriptProgress& progress) { line.show(progress); };
    hooks.onLog = [&](const std::string& text) {
        if (!takesMore(STDERR_FILENO)) return;  // the session has every line
        line.clear();
        say(stderr, "{}\n", lines(shortened(text, kMaxLogLine)));
    };
    if (const auto started = running.start(std::move(hooks)); !started) return running.finish();
    interrupts.onStop([&run] { run.script()->stop("operator (signal)"); });
    if (interrupts.signalled()) run.script()->stop("operator (signal)");
    static_cast<void>(run.script()->wait());
    interrupts.onStop({});
    line.clear();
    auto result = running.finish();
    // A study session answers the operator's questions by itself.
    if (result.outcome.error || running.session) return result;
    for (const auto& name : desk.unasked()) say(stderr, "--set {}: the protocol did not ask for it.\n", name);
    return result;
}

int exitFor(const RunResult& result) {
    if (result.stoppedBySafety) return kStopped;
    return result.outcome.error ? static_cast<int>(kCouldNotRun) : exitForVerdict(result.verdict());
}

/// A script may return anything under any name; the verdict is valid in every case.
void printAnyResults(const json& results) {
    if (!results.is_object()) return;
    const auto kind = results.contains("kind") && results["kind"].is_string() ? results["kind"].get<std::string>() : "";
    try {
        resultTraits(kind).tables.empty() ? printResults(results) : printTables(kind, results);
    } catch (const json::exception& problem) {
        say("\n  The results do not have the shape that is shown here ({}); the session holds them as they are.\n",
            printable(problem.what()));
    }
}

void printSummary(const ScriptOutcome& outcome, const json& value) {
    printAnyResults(outcome.results);
    say("\n");
    for (const auto& mark : value["marks"]) say("  {}\n", flagSentence(mark.get<std::string>()));
    printVerdict(value["verdict"].is_string() ? value["verdict"].get<std::string>()
                 : outcome.error              ? "none: the run ended before there was one"
                                              : "none: this protocol judges nothing",
                 outcome.error ? std::vector<std::string>{} : outcome.reasons);
    say("  session  {}\n", value["session"].get<std::string>());
    if (value["report"].is_string()) say("  report   {}\n", value["report"].get<std::string>());
}

/// Ends the program at once: a report may take long and can be made later.
[[noreturn]] void endBeforeReports(const std::string& session) {
    if (takesMore(STDERR_FILENO))
        say(stderr,
            "tactoscope-cli: ended by a signal before the reports were written. The session is complete: "
            "tactoscope-cli report {} --out FILE writes one.\n",
            session);
    std::_Exit(kStopped);
}

/// Writes the reports next to the session; returns the path of the last report, or null if there is none.
json writeReports(const RunFiles& files, const std::vector<const char*>& endings) {
    if (endings.empty()) return nullptr;
    std::vector<std::filesystem::path> paths;
    for (const auto* ending : endings) paths.push_back(files.report(ending));
    if (const auto made = makeReports(files.session, paths); !made)
        say(stderr, "tactoscope-cli: no report: {}\n", lines(made.error().message));
    std::error_code error;
    std::erase_if(paths, [&](const auto& path) { return !std::filesystem::exists(path, error); });
    return paths.empty() ? json(nullptr) : json(paths.back().string());
}

int runRun(const QCommandLineParser& parser) {
    const auto stops = std::make_shared<StopCounter>();
    const auto asked = stops->mark();  // the command itself requests the run, so every signal comes later
    SignalStop interrupts;
    interrupts.onStop([stops] { stops->raise(); });
    if (interrupts.signalled()) stops->raise();
    const auto reports = reportsFrom(parser);
    if (!reports) return usage("run: " + reports.error().message);
    auto order = orderFrom(parser, interrupts);
    if (!order) return order.error();
    order->stops = stops;
    order->asked = asked;
    const auto protocol = order->script.name;
    const auto origin = originOf(order->script);
    const bool shipped = order->script.shipped;
    const auto seed = order->seed;
    const auto answers = order->settings.answers;
    auto registry = allDrivers()();
    auto prepared = prepareRun(std::move(*order), parser, registry);
    if (!prepared) return failWith(prepared.error());
    const auto& running = *prepared;
    if (!shipped) say(stderr, "The script is {}.\n", origin);

    const auto result = runScript(running, answers, interrupts);
    const auto& outcome = result.outcome;
    if (outcome.error) say(stderr, "tactoscope-cli: {}\n", lines(outcome.error->message));
    for (const auto& trouble : result.troubles) say(stderr, "tactoscope-cli: {}\n", lines(trouble.message));

    // The output is off and the session closed: from here on a signal ends the program.
    interrupts.onStop([session = result.session.string()] { endBeforeReports(session); });
    const int exitCode = exitFor(result);
    const auto verdict = result.verdict();
    if (result.markers) say(stderr, "{}\n", markersSentence(*result.markers));
    if (result.lsl) say(stderr, "{}\n", lines(lslSentence(*result.lsl)));
    json value{{"protocol", protocol},
               {"script_from", origin},
               {"verdict", verdict.empty() ? json(nullptr) : json(verdict)},
               {"simulated", result.simulated},
               {"marks", result.marks},
               {"devices", devicesJson(result.devices)},
               {"seed", running.session ? running.session->session().stage().settings().seed : seed},
               {"session", result.session.string()},
               {"report", running.session ? json(nullptr) : writeReports(running.run().files(), *reports)},
               {"results", outcome.results},
               {"reasons", outcome.reasons},
               {"error", outcome.error ? json(outcome.error->message) : json(nullptr)}};
    if (result.lsl) value["lsl"] = toJson(*result.lsl);
    if (running.session) value["markers"] = result.markers ? toJson(*result.markers) : json(nullptr);
    if (parser.isSet("json"))
        printJson(value);
    else
        printSummary(outcome, value);
    return exitCode;
}

}  // namespace

const Command kRun{
    "run",
    "PROTOCOL [--device URI]... [--set KEY=VALUE]... [--seed N] [--profile F] [--realtime] [--reset-fault] "
    "[--operator NAME] [--sample ID] [--reviewer NAME] [--ambient TEXT] [--certificate-details F] [--out DIR] "
    "[--passphrase-file F] [--markers [ADDRESS:]PORT] [--lsl] [--lsl-markers NAME] [--report none|html|pdf] [--json]",
    "Runs a protocol script, records it and writes its report", declareRun, runRun};

}  // namespace tacto::cli
