#include "app/scripting/engine/ScriptSession.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/scripting/engine/Arguments.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/LocaleFreeText.h"
#include "core/encoding/Rounding.h"
#include "core/measure/CaptureDescription.h"
#include "core/measure/CaptureFile.h"
#include "core/measure/InstrumentStatement.h"
#include "core/session/SessionWriter.h"

namespace tacto {

ScriptSession::ScriptSession(const RunRequest& request) : request_(request), random_(request.seed, "protocol script") {
    if (request.bench != nullptr) chosen_ = request.bench->profile();
}

Result<PilotSession*> ScriptSession::pilot() {
    if (request_.pilot != nullptr) return request_.pilot;
    return fail(ErrorCode::Unsupported, "this runs in a session of a study only; --out names its folder");
}

Result<nlohmann::json> ScriptSession::ask(const OperatorQuestion& question) {
    if (request_.operatorDesk == nullptr) {
        return fail(ErrorCode::NotFound, "this run has no operator to answer \"{}\"; give --set {}=...", question.text,
                    question.name);
    }
    request_.operatorDesk->present = [bench = request_.bench] { bench->attend(); };
    request_.bench->attend(request_.operatorDesk->unwatchedFor());
    auto answer = request_.operatorDesk->ask(question);
    request_.operatorDesk->present = {};
    request_.bench->attend();
    // The key of a choice is the script's word; a text that was entered is the operator's.
    if (question.kind == OperatorQuestion::Kind::Enter && answer && answer->is_string()) {
        answered_.insert(answer->get<std::string>());
    }
    if (request_.session != nullptr) {
        const nlohmann::json details = {{"name", question.name},
                                        {"question", question.text},
                                        {"answer", answer ? *answer : nlohmann::json(answer.error().message)}};
        if (auto written = request_.session->event(now(), "operator", details); !written) return failure(written);
    }
    return answer;
}

Result<void> ScriptSession::askTo(std::string name, std::string text) {
    OperatorQuestion question;
    question.name = std::move(name);
    question.text = std::move(text);
    if (const auto answer = ask(question); !answer) return failure(answer);
    return {};
}

void ScriptSession::log(const std::string& text) {
    log_.push_back(text);
    if (request_.onLog) request_.onLog(text);
    // A log line that cannot be written does not end the run: the next row that must be kept will report the error.
    if (request_.session != nullptr) (void)request_.session->log(now(), "info", text);
}

void ScriptSession::progress(const ScriptProgress& progress) {
    if (request_.onProgress) request_.onProgress(progress);
}

tl::unexpected<Error> ScriptSession::endWith(Error error) {
    if (!end_) end_ = std::move(error);
    return tl::unexpected<Error>(*end_);
}

/// Returns the uncertainty of the whole path from load to reading, or nothing if the operator stated none.
InstrumentStatement ScriptSession::operatorsStatement() const {
    InstrumentStatement out;
    const Stated nothingElse{0, "the operator"};
    if (const auto gain = operatorsNumber("scope_gain_pct"); gain && *gain > 0) {
        for (auto* channel : {&out.voltage, &out.current}) {
            channel->gain = {*gain * 1e-2, "the operator"};
            channel->probe = nothingElse;
        }
    }
    if (const auto base = operatorsNumber("timebase_ppm"); base && *base > 0)
        out.timeBase = {*base * 1e-6, "the operator"};
    return out;
}

nlohmann::json ScriptSession::hold(std::vector<Capture> captures) {
    nlohmann::json handles = nlohmann::json::array();
    for (auto& capture : captures) {
        applyStatement(capture, operatorsStatement());
        scopeSeen_.add(capture);
        if (request_.onCapture) request_.onCapture(capture);
        for (const auto& warning : capture.warnings) {
            if (writer() != nullptr) static_cast<void>(writer()->event(now(), "capture warning", {{"text", warning}}));
        }
        handles.push_back({{"capture", nextCapture_},
                           {"start_s", capture.start_s},
                           {"trigger_s", capture.trigger_s},
                           {"rate_hz", capture.rate_hz},
                           {"samples", capture.samples()},
                           {"stamp_tolerance_s", numberOrNull(capture.stampTolerance_s)},
                           {"not_stated", notStatedText(capture)}});
        const auto command = commandOf(capture);
        captures_.push_back({nextCapture_++, std::move(capture), command, {}});
        if (captures_.size() > kHeldCaptures) captures_.pop_front();
    }
    return handles;
}

namespace {

/// True if all trains in a record were programmed with the same amplitude and interval. If the encoder moves in steps
/// from level to level, the train before the record must match too. Otherwise the reading has no known command: a mean
/// over unlike trains would look like an error of the stimulator (hazard H1).
bool programmedAlike(const Capture& capture, const Telemetry& now, const EncodingProfile& encoding) {
    constexpr double kSame = 1e-3;    // relative
    constexpr double kNear_s = 0.05;  // seconds from the planned onset to the trigger
    const auto same = [](double a, double b) { return std::abs(a - b) <= kSame * std::max(std::abs(a), std::abs(b)); };
    const double end_s = capture.start_s + static_cast<double>(capture.samples()) / capture.rate_hz;
    std::vector<ProgrammedTrain> programmed;
    for (const auto& train : now.programmed) {
        if (std::isfinite(train.amplitude) && toSeconds(train.onset) < end_s) programmed.push_back(train);
    }
    std::ranges::sort(programmed, {}, &ProgrammedTrain::onset);
    // The train at the trigger, as programmedFor() finds it; a check pulse may come shortly before.
    auto first = std::ranges::min_element(programmed, {}, [&](const ProgrammedTrain& train) {
        return std::abs(toSeconds(train.onset) - capture.trigger_s);
    });
    const bool inSteps = encoding.movesInSteps();
    if (first == programmed.end() || !(std::abs(toSeconds(first->onset) - capture.trigger_s) < kNear_s))
        return !inSteps;
    if (inSteps && first != programmed.begin()) --first;
    for (auto next = first + 1; next != programmed.end(); ++first, ++next) {
        if (!same(next->amplitude, first->amplitude)) return false;
        if (!same(toSeconds(next->onset - first->onset), now.interval_s)) return false;
    }
    return true;
}

}  // namespace

/// Returns the command that the gate judged and the device was programmed to, on the device's grid. A record with
/// several commands has no amplitude: another train's amplitude would look like an error of the stimulator.
CapturedCommand ScriptSession::commandOf(const Capture& capture) const {
    const auto& bench = *request_.bench;
    const Telemetry now = bench.telemetry();
    const PulseTrain& train = bench.profile().encoding.train;
    const auto& stimulator = request_.bench->devices().stimulator;
    const auto onGrid = [&](Micros time) {
        return stimulator ? towardZero(time.count(), stimulator->traits().widthStep.count()) / 1e6 : kNaN;
    };
    const bool steady = programmedAlike(capture, now, bench.profile().encoding);
    return {.amplitude = steady ? capture.programmed : kNaN,
            .interval_s = steady ? now.interval_s : kNaN,
            .width_s = onGrid(train.phaseWidth),
            .gap_s = onGrid(train.interPhaseGap),
            .calibrationApplied = bench.calibration().has_value(),
            .simulated = capture.simulated};
}

Result<const ScriptSession::Held*> ScriptSession::find(const nlohmann::json& handle) const {
    const auto id = handle.is_object() ? handle.value("capture", nlohmann::json()) : handle;
    if (!id.is_number_integer()) {
        return fail(ErrorCode::InvalidArgument, "{} is not a capture; pass what bench.capture() returned",
                    shown(handle));
    }
    const auto same = [&](const Held& held) { return held.id == id.get<std::int64_t>(); };
    const auto at = std::find_if(captures_.begin(), captures_.end(), same);
    if (at != captures_.end()) return &*at;
    return fail(ErrorCode::InvalidArgument, "capture {} is held no longer; measure captures before {} more are taken",
                shown(id), kHeldCaptures);
}

Result<std::vector<const Capture*>> ScriptSession::held(const nlohmann::json& handles) const {
    std::vector<const Capture*> captures;
    for (const auto& handle : handles) {
        const auto found = find(handle);
        if (!found) return failure(found);
        captures.push_back(&(*found)->capture);
    }
    return captures;
}

Result<std::vector<CapturedCommand>> ScriptSession::commandsOf(const nlohmann::json& handles) const {
    std::vector<CapturedCommand> commands;
    for (const auto& handle : handles) {
        const auto found = find(handle);
        if (!found) return failure(found);
        commands.push_back((*found)->command);
    }
    return commands;
}

bool ScriptSession::isOperatorsText(const std::string& text) const {
    const auto holds = [&](const std::string& given) {
        if (trimmed(given) == text) return true;
        const auto apart = [](char c) { return c == ';' || c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
        for (auto at = given.find(text); at != std::string::npos && !text.empty(); at = given.find(text, at + 1)) {
            const auto end = at + text.size();
            if ((at == 0 || apart(given[at - 1])) && (end == given.size() || apart(given[end]))) return true;
        }
        return false;
    };
    if (std::any_of(answered_.begin(), answered_.end(), holds)) return true;
    return std::any_of(request_.operatorGave.begin(), request_.operatorGave.end(), [&](const std::string& name) {
        const auto given = request_.parameters.find(name);
        return given != request_.parameters.end() && given->is_string() && holds(given->get<std::string>());
    });
}

std::optional<double> ScriptSession::operatorsNumber(const std::string& name) const {
    const auto given = request_.parameters.find(name);
    if (!request_.operatorGave.contains(name) || given == request_.parameters.end() || !given->is_number()) {
        return std::nullopt;
    }
    return given->get<double>();
}

Result<void> ScriptSession::reportItem(const nlohmann::json& item) {
    if (writer() == nullptr) return {};
    if (auto written = writer()->reportItem(now(), item); !written) return failure(written);
    return {};
}

Result<void> ScriptSession::keepEvent(const std::string& kind, const nlohmann::json& details) {
    if (writer() == nullptr) return {};
    if (auto written = writer()->event(now(), "script: " + kind, asScriptsSeeIt(details)); !written)
        return failure(written);
    return {};
}

bool ScriptSession::isSimulated() const {
    const auto all = request_.bench->devices().identities();
    return std::ranges::all_of(all, &DeviceIdentity::simulated);
}

Result<void> ScriptSession::keepMeasurement(std::string_view name, const nlohmann::json& values) {
    if (writer() == nullptr) return {};
    if (auto written = writer()->measurement(now(), std::string(name), asScriptsSeeIt(values)); !written)
        return failure(written);
    return {};
}

Result<int> ScriptSession::addTrial(const std::string& condition, const nlohmann::json& given) {
    const auto measured = asScriptsSeeIt(given);
    int number = static_cast<int>(trials_.size()) + 1;
    if (request_.session != nullptr) {
        auto written = request_.session->trial(now(), condition, measured);
        if (!written) return failure(written);
        number = *written;
    }
    const auto handles = measured.value("captures", nlohmann::json::array());
    for (auto& held : captures_) {
        if (std::find(handles.begin(), handles.end(), nlohmann::json(held.id)) == handles.end()) continue;
        if (auto stored = store(held, number); !stored) return failure(stored);
        const auto known = [&](const Exemplar& exemplar) { return exemplar.condition == condition; };
        if (std::none_of(exemplars_.begin(), exemplars_.end(), known)) {
            exemplars_.push_back({condition, held.row, held.capture});
        }
    }
    nlohmann::json trial = measured.is_object() ? measured : nlohmann::json::object();
    trial["condition"] = condition;
    trial["trial"] = number;
    if (request_.onTrial) request_.onTrial(trial);
    trials_.push_back(std::move(trial));
    return number;
}

Result<void> ScriptSession::store(Held& held, int trial) {
    if (request_.session != nullptr && !held.row) {
        auto row = request_.session->capture(now(), held.capture, trial);
        if (!row) return failure(row);
        held.row = *row;
    }
    if (request_.captureFolder.empty()) return {};
    if (auto stated = stateCaptureOrigin(request_.captureFolder, held.capture.simulated); !stated) return stated;
    return writeCapture(request_.captureFolder / fmt::format("trial-{:04}-{:05}.csv", trial, held.id), held.capture);
}

nlohmann::json ScriptSession::worstExposure() const {
    nlohmann::json rows = nlohmann::json::array();
    if (request_.bench == nullptr) return rows;
    const auto worst = request_.bench->worstExposure();
    for (const auto& row : worst.rows()) {
        std::string name(titleOf(row.quantity));
        if (row.judged == JudgedAt::Ohm500) name += " into 500 ohm";
        nlohmann::json out = {{"name", name},
                              {"value", row.evaluated ? nlohmann::json(row.value) : nlohmann::json()},
                              {"limit", numberOrNull(row.limit)},
                              {"unit", row.unit},
                              {"source", row.set.view()},
                              {"warning", row.action != LimitAction::Refuse},
                              {"measured", numberOrNull(row.measured)},
                              {"measured_beyond", row.beyond}};
        if (!row.reason.empty()) out["reason"] = row.reason.view();
        rows.push_back(std::move(out));
    }
    return rows;
}

void ScriptSession::recordExposure() {
    auto rows = worstExposure();
    if (writer() != nullptr && !rows.empty())
        (void)writer()->measurement(now(), kExposureMeasurement, {{"rows", std::move(rows)}});
}

void ScriptSession::keepPartial(nlohmann::json results, nlohmann::json tables) {
    partial_ = asScriptsSeeIt(std::move(results));
    partialTables_ = asScriptsSeeIt(std::move(tables));
}

nlohmann::json ScriptSession::takePartial() {
    if (!partial_.is_object()) return {};
    auto out = std::exchange(partial_, {});
    if (const auto kind = kindOf(out); !kind.empty()) out["kind"] = kind;
    addBasis(out);
    out["partial"] = true;
    out["verdict"] = nullptr;  // a run that ended early never passes, whatever its result so far (hazard H9)
    if (request_.session == nullptr) return out;
    for (const auto& table : partialTables_) {
        nlohmann::json item = table;
        item["kind"] = table.value("kind", "") == "matrix" ? "matrix" : "table";
        item["caption"] = table.value("caption", "") + " (partial: the run ended early)";
        // The run has already failed and reports that; a table that cannot be written changes nothing.
        (void)request_.session->reportItem(now(), item);
    }
    return out;
}

void ScriptSession::addBasis(nlohmann::json& results) const {
    const auto& devices = request_.bench->devices();
    const auto& scope = devices.oscilloscope;
    if (!results.is_object() || !scope || !scopeSeen_.any()) return;
    auto instruments = scopeSeen_.rows(scope->identity());
    for (const auto& device : devices.identities()) {
        if (device.role != Role::Oscilloscope) instruments.push_back(toJson(instrumentOf(device)));
    }
    results["instruments"] = std::move(instruments);
    results["rests_on"] = scopeSeen_.restsOn();
}

void ScriptSession::judge(ScriptVerdict verdict, std::vector<std::string> reasons, nlohmann::json results) {
    verdict_ = verdict;
    reasons_ = std::move(reasons);
    results_ = std::move(results);
    const auto kind = kindOf(results_);
    if (results_.is_object() && !results_.contains("kind") && !kind.empty()) results_["kind"] = kind;
    addBasis(results_);
}

std::string ScriptSession::kindOf(const nlohmann::json& results) const {
    if (!results.is_object() || !results.contains("kind"))
        return request_.declaration ? request_.declaration->kind : std::string();
    return results["kind"].is_string() ? results["kind"].get<std::string>() : std::string();
}

void ScriptSession::recordBasis(const nlohmann::json& results) {
    if (request_.session == nullptr || !results.is_object()) return;
    nlohmann::json basis = nlohmann::json::object();
    for (const auto* key : {"kind", "decision_rule", "rests_on", "not_evaluated", "instruments", "reference"}) {
        if (results.contains(key)) basis[key] = results[key];
    }
    // If the basis is missing, the report says that it is not known.
    (void)request_.session->reportItem(now(), {{"kind", "basis"}, {"results", std::move(basis)}});
}

void ScriptSession::finish(ScriptOutcome& outcome) {
    outcome.verdict = verdict_;
    outcome.expectedFaults = expectedFaults_;
    outcome.reasons = std::move(reasons_);
    outcome.results = std::move(results_);
    outcome.log = std::move(log_);
}

}  // namespace tacto
