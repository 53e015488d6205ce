// The object "bench.stimulatorCalibration", the steps of a stimulator's calibration and of its check: the functions for
// scripts and what each does.
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/analysis/RunAnalysis.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "app/scripting/host/record/KeptCalibration.h"
#include "app/scripting/host/report/Cells.h"
#include "app/scripting/host/stimulator_calibration/StimulatorLevels.h"
#include "core/analysis/calibration/CalibrationJson.h"
#include "core/base/QuantityText.h"

namespace tacto {

namespace host::stimulator_calibration {

namespace {

using report::listIn;

constexpr double kClock_pct = 0.5;  // allowed deviation of intervals from the computer's clock (choice)

std::string worstOf(const std::vector<Json>& judged) {
    const auto any = [&judged](std::string_view verdict) {
        return std::ranges::any_of(judged, [&](const Json& one) { return textOr(one, "verdict") == verdict; });
    };
    return any("fail") ? "fail" : any("indeterminate") ? "indeterminate" : "pass";
}

/// Returns the share of its tolerance that the worst level uses; 0 if that is not known.
double worstUse(const Json& found) {
    double worst = 0;
    for (const auto& level : listIn(found, "levels")) {
        const double use = (std::abs(numberOr(level, "worst_error")) + numberOr(level, "worst_expanded_uncertainty")) /
                           numberOr(level, "tolerance");
        if (use > worst) worst = use;
    }
    return worst;
}

}  // namespace

std::string timeBaseProblem(const Json& interval) {
    if (interval.is_null()) return {};
    const double off_pct = 100 * std::abs(numberOr(interval, "gain") - 1);
    const double expanded_pct = 100 * numberOr(interval, "gain_expanded_uncertainty");
    if (off_pct + expanded_pct <= kClock_pct) return {};
    return fmt::format(
        "the time base is not sure: intervals by the computer's clock are read {} off, at most {} % is allowed "
        "(choice)",
        measuredText(off_pct, expanded_pct, "%"), kClock_pct);
}

Json verdictOf(const std::vector<Json>& found, const std::string& clock, bool store) {
    auto verdict = worstOf(found);
    Json reasons = Json::array();
    if (!clock.empty()) {
        if (verdict == "pass") verdict = "indeterminate";
        reasons.push_back(clock + (store ? "; nothing was stored" : ""));
    }
    // The quantity nearest to its tolerance comes first: it is the headline.
    std::vector<const Json*> nearestFirst;
    for (const auto& one : found) nearestFirst.push_back(&one);
    std::ranges::stable_sort(nearestFirst, std::greater(), [](const Json* one) { return worstUse(*one); });
    for (const auto* one : nearestFirst) {
        const auto title = report::titleOfQuantity(textOr(*one, "quantity"));
        for (const auto& reason : listIn(*one, "reasons")) reasons.push_back(title + ": " + reason.get<std::string>());
    }
    return {{"verdict", verdict}, {"reasons", std::move(reasons)}};
}

Json checkVerdictOf(const std::vector<Json>& checks, const std::string& stored) {
    const auto verdict = worstOf(checks);
    Json reasons = Json::array();
    for (const auto& check : checks)
        for (const auto& reason : listIn(check, "reasons")) reasons.push_back(reason);
    if (verdict == "pass") reasons = Json::array({stored + "; it still holds at three levels of each"});
    return {{"type", "check"}, {"verdict", verdict}, {"reasons", std::move(reasons)}};
}

namespace {

/// The state of a calibration.
struct StimulatorRun {
    LevelSettings settings;
    int levels = 0, repeats = 0;
    bool checks = false, store = false;
    double warmUp_s = 0, tolerance_pct = 0, timing_pct = 0, load_pct = 0, reference_pct = 0;
    record::Validity validity;
    Json stored;
    const CalibratedQuantity* quantity = nullptr;  ///< the quantity that is being read
    Json rows = Json::array();                     ///< its readings so far
    Json results = Json::object();
    std::vector<Json> found;  ///< for each quantity, its calibration or check
    std::string unknown;      ///< why a reference does not read correctly
};

/// Refuses at the beginning what would otherwise be refused at the end, after an hour's work.
Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    StimulatorRun first;
    const auto settings = levelSettingsFrom(arguments);
    if (!settings) return failure(settings);
    first.settings = *settings;
    first.levels = arguments.whole("settings.levels");
    first.repeats = arguments.whole("settings.repeats");
    first.checks = arguments.text("settings.mode") == "check";
    first.store = arguments.flag("settings.store");
    first.warmUp_s = arguments.number("settings.warm_up_s");
    first.tolerance_pct = arguments.number("settings.tolerance_pct");
    first.timing_pct = arguments.number("settings.timing_tolerance_pct");
    first.load_pct = arguments.number("settings.load_tolerance_pct");
    first.reference_pct = arguments.number("settings.reference_tolerance_pct");
    first.validity = {arguments.whole("settings.valid_days"), arguments.text("settings.scope_due")};
    const auto quantities = arguments.text("settings.quantities");
    if (first.store && !first.checks && quantities != "all")
        return fail(ErrorCode::InvalidArgument, "quantities is {}; all is expected to keep a result", quantities);
    auto stored = bench::storedCalibration(session);
    if (!stored) return stored;
    first.stored = std::move(*stored);
    if (auto ignored = session.bench().useCalibration(false); !ignored) return failure(ignored);
    const auto known = textOr(first.stored, "text");
    if (auto said = session.reportText("Stored calibration: " + known + "."); !said) return failure(said);
    if (first.checks && first.stored["calibrated"] != true)
        return fail(ErrorCode::InvalidArgument, "{}; there is nothing to check", known);
    auto run = session.begin(arguments.object(), std::move(first));
    if (!run) return failure(run);
    return (*run)->stored;
}

Result<Json> knownLoad(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<StimulatorRun>(arguments.object());
    if (!begun) return failure(begun);
    StimulatorRun& run = **begun;
    const auto reading = readKnownLoad(session, run.settings);
    if (!reading) return reading;
    const auto known =
        bench::judgeReference(session, *reading, {run.settings.load_ohm, run.reference_pct, run.load_pct});
    if (!known) return known;
    auto absolute = bench::absoluteReading(session, arguments, run.tolerance_pct);
    if (!absolute) return absolute;
    run.results["reference"] = *known;
    if (known->at("passed") != true) run.unknown = textOr(*known, "reason");
    if (!absolute->is_null()) {
        if (absolute->at("passed") != true) run.unknown = "the absolute reference: " + textOr(*absolute, "text");
        run.results["absolute"] = std::move(*absolute);
    }
    if (!run.unknown.empty()) return Json(false);
    if (auto warm = warmUp(session, run.settings.load_ohm, run.warmUp_s); !warm) return failure(warm);
    if (run.checks) {
        const auto narrow = narrowed(run.settings, run.stored, arguments);
        if (!narrow) return failure(narrow);
        run.settings = *narrow;
        run.levels = 3;
        run.repeats = 2;
        run.results["check"] = Json::array();
    }
    return Json(true);
}

/// Steps fully up and fully down, again and again; for each repeat the first direction is random.
Json sweepsOf(Random& random, int levels, int repeats) {
    Json steps = Json::array();
    for (int repeat = 1; repeat <= repeats; ++repeat) {
        const bool upFirst = random.below(2) == 1;
        for (const bool isUp : {upFirst, !upFirst}) {
            for (int k = 0; k < levels; ++k) {
                const double share = static_cast<double>(isUp ? k : levels - 1 - k) / (levels - 1);
                steps.push_back({{"repeat", repeat}, {"direction", isUp ? "up" : "down"}, {"share", share}});
            }
        }
    }
    return steps;
}

Result<Json> levels(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<StimulatorRun>(arguments.object());
    if (!begun) return failure(begun);
    StimulatorRun& run = **begun;
    if (!run.results.contains("reference") || !run.unknown.empty())
        return fail(ErrorCode::InvalidArgument, "{0}.levels: {0}.knownLoad() that is true is expected first",
                    arguments.object());
    run.quantity = calibratedQuantity(arguments.text("quantity"));
    run.rows = Json::array();
    if (auto armed = beginLevels(session, run.settings, *run.quantity); !armed) return failure(armed);
    return sweepsOf(session.random(), run.levels, run.repeats);
}

Result<StimulatorRun*> reading(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<StimulatorRun>(arguments.object());
    if (!begun) return failure(begun);
    if ((*begun)->quantity != nullptr) return *begun;
    return fail(ErrorCode::InvalidArgument, "{0} has no quantity yet; {0}.levels() is expected first",
                arguments.object());
}

/// Keeps the state in case the run ends early.
void keep(ScriptSession& session, const StimulatorRun& run) {
    const std::string quantity(run.quantity->id);
    Json results = run.results;
    results[quantity] = {{"readings", run.rows}};
    session.keepPartial(std::move(results),
                        Json::array({{{"caption", report::titleOfQuantity(quantity) + ", readings"},
                                      {"rows", run.rows},
                                      {"columns", {"commanded", "measured", "direction", "repeat"}}}}));
}

Result<Json> read(ScriptSession& session, const Arguments& arguments) {
    const auto begun = reading(session, arguments);
    if (!begun) return failure(begun);
    StimulatorRun& run = **begun;
    const auto level = readLevel(session, run.settings, *run.quantity, arguments.number("level.share"));
    if (!level) return level;
    const std::string key(run.quantity->reading), direction = arguments.text("level.direction");
    run.rows.push_back({{"reading", level->at("reading")},
                        {"commanded", level->at("commanded").at(key)},
                        {"measured", level->at(key)},
                        {"direction", direction},
                        {"repeat", arguments.whole("level.repeat")}});
    auto added = session.addTrial(fmt::format("{} {}", run.quantity->id, direction), *level);
    if (!added) return failure(added);
    if (run.rows.size() % static_cast<std::size_t>(run.levels) == 0) keep(session, run);
    return Json();
}

Result<Json> judge(ScriptSession& session, const Arguments& arguments) {
    const auto begun = reading(session, arguments);
    if (!begun) return failure(begun);
    StimulatorRun& run = **begun;
    session.bench().disarm();
    const std::string quantity(std::exchange(run.quantity, nullptr)->id);
    const bool isAmplitude = quantity == kCalibratedAmplitude.id;
    analysis::CalibrationAsked asked;
    asked.quantity = quantity;
    asked.tolerance_pct = isAmplitude ? run.tolerance_pct : run.timing_pct;
    if (isAmplitude) {
        asked.errors.loadTolerance = run.load_pct / 100;
        // A current source is programmed to A / |Z|, and |Z| is measured anew for each level.
        const bool drivesCurrent = session.bench().devices().stimulator->traits().drive == Drive::Current;
        if (drivesCurrent) asked.fit.sameLevel = 0.02;
    }
    auto found = analysis::calibrationOf(session, run.rows, asked);
    if (!found) return found;
    if (run.checks) {
        found = toJson(checkAgainst(run.stored.at(quantity), asScriptsSeeIt(*found), asked.tolerance_pct));
        for (const auto& row : found->at("rows")) run.results["check"].push_back(row);
    } else {
        if (auto kept = session.keepMeasurement("calibration of " + quantity, *found); !kept) return failure(kept);
        run.results[quantity] = *found;
    }
    run.found.push_back(*found);
    return found;
}

Result<Json> conclude(ScriptSession& session, const Arguments& arguments) {
    const auto begun = session.begun<StimulatorRun>(arguments.object());
    if (!begun) return failure(begun);
    StimulatorRun& run = **begun;
    if (!run.unknown.empty() || run.found.empty()) {
        const auto why = run.unknown.empty() ? std::string("no quantity was judged") : run.unknown;
        run.results.update(
            {{"verdict", "indeterminate"}, {"reasons", Json::array({why + "; nothing was calibrated"})}});
        return run.results;
    }
    if (run.checks) {
        run.results.update(checkVerdictOf(run.found, textOr(run.stored, "text")));
        return run.results;
    }
    const auto clock = timeBaseProblem(run.results.value("interval", Json()));
    if (run.store && clock.empty()) {
        auto stored = record::keepCalibration(session, run.results, run.validity);
        if (!stored) return stored;
        run.results["stored"] = *stored;
        if (auto noted = session.keepEvent("calibration stored", *stored); !noted) return failure(noted);
    }
    run.results.update(verdictOf(run.found, clock, run.store));
    return run.results;
}

}  // namespace

}  // namespace host::stimulator_calibration

std::vector<HostFunction> stimulatorCalibrationFunctions() {
    using namespace takes;
    constexpr std::string_view kErrors = "As bench.arm() and bench.capture().";
    std::vector<HostParameter> settings{
        object("settings", "the parameters of the run"),
        text("settings.mode", "calibrate, or check the stored calibration").oneOf({"full", "check"}),
        text("settings.quantities", "what is calibrated: all, to keep the result")
            .oneOf({"all", "amplitude", "interval", "width", "gap"}),
        whole("settings.levels", "of each quantity").range(2, 1000),
        whole("settings.repeats", "of each level, each way").range(1, 1000),
        number("settings.warm_up_s", "s", "before the first level").range(0, 86'400),
        number("settings.tolerance_pct", "%", "of amplitude").range(0.01, 50),
        number("settings.timing_tolerance_pct", "%", "of interval, width and gap").range(0.01, 50),
        number("settings.load_tolerance_pct", "%", "of the load").range(0, 50),
        number("settings.reference_tolerance_pct", "%", "within which the known load must read").range(0, 100),
        flag("settings.store", "the result is kept"),
        whole("settings.valid_days", "how long it holds").range(1, static_cast<double>(kLongestValidity.count())),
        text("settings.scope_due", "day on which the oscilloscope's own calibration is due").orEmpty()};
    for (auto& one : host::stimulator_calibration::levelSettings()) settings.push_back(std::move(one));
    auto reference = std::vector<HostParameter>{object("settings", "the parameters of the run")};
    for (auto& one : host::bench::absoluteSettings()) reference.push_back(std::move(one));
    return {
        {.name = "begin",
         .parameters = std::move(settings),
         .text = "Refuses what could not be kept at the end, says which calibration is stored, and leaves it aside for "
                 "the rest of the run: what is calibrated is what the stimulator delivers for what it is told.",
         .returns = "As bench.calibration.",
         .errors = "Throws for a range without a length, for one quantity that is to be kept, and for a check where "
                   "nothing is stored.",
         .needs = Role::Stimulator,
         .call = host::stimulator_calibration::begin},
        {.name = "knownLoad",
         .parameters = std::move(reference),
         .text = "Before anything is believed: reads one train of the largest amplitude into the known load, and the "
                 "reference source where the settings have one. Then warms up.",
         .returns = "false where one of them does not read as what it is.",
         .errors = kErrors,
         .asks = {kConfirmArming},
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::stimulator_calibration::knownLoad},
        {.name = "levels",
         .parameters = {text("quantity", "what is calibrated").oneOf({"amplitude", "interval", "width", "gap"})},
         .text = "Begins the levels of a quantity, and arms for those of amplitude and interval.",
         .returns = "Its levels in their order, for read(): fully up and fully down, again and again; which way comes "
                    "first is drawn for each repeat, from the run's seed.",
         .errors = kErrors,
         .asks = {kConfirmArming},
         .failsDisarmed = true,
         .call = host::stimulator_calibration::levels},
        {.name = "read",
         .parameters = {object("level", "of levels()"),
                        number("level.share", "", "0 the lowest level to 1 the largest").range(0, 1),
                        text("level.direction", "of the sweep").oneOf({"up", "down"}),
                        whole("level.repeat", "of the sweep").range(1, 1e6)},
         .text = "Sets a level, waits until it has settled, reads it and records it as a trial.",
         .errors = kErrors,
         .asks = {kConfirmArming},
         .needs = Role::Oscilloscope,
         .failsDisarmed = true,
         .call = host::stimulator_calibration::read},
        {.name = "judge",
         .text =
             "Disarms, and finds the line through the readings of the quantity, its uncertainty and its verdict; in a "
             "check whether the stored line still holds.",
         .returns = "As analysis.calibration(); in a check { rows, verdict, reasons }.",
         .errors = "As analysis.calibration().",
         .needs = Role::Stimulator,
         .failsDisarmed = true,
         .call = host::stimulator_calibration::judge},
        {.name = "conclude",
         .text =
             "The verdict: the worst quantity's, and indeterminate where the time base is not sure by the computer's "
             "clock. Keeps the result where the settings ask for it.",
         .returns = "What verdict() takes.",
         .errors = "As record.calibration().",
         .needs = Role::Stimulator,
         .call = host::stimulator_calibration::conclude},
    };
}

}  // namespace tacto
