// The object "pilot", a study session with a participant: its beginning and end, the protection of the participant
// around the trials, and the procedures. core/pilot says what each function does.
#include <type_traits>

#include "app/scripting/engine/Arguments.h"
#include "app/scripting/engine/ScriptSession.h"
#include "core/pilot/PilotSession.h"

namespace tacto {

namespace host::pilot {

namespace {

using Json = nlohmann::json;

/// Returns the answer of `call(pilot)`: JSON, or nothing. Errors: Unsupported outside a study session; as `call`.
template <class Call>
[[nodiscard]] Result<Json> inPilot(ScriptSession& session, const Call& call) {
    const auto pilot = session.pilot();
    if (!pilot) return failure(pilot);
    if constexpr (std::is_same_v<decltype(call(**pilot)), Result<Json>>)
        return call(**pilot);
    else
        return done(call(**pilot));
}

Result<Json> begin(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) { return pilot.begin(arguments.flag("options.trials")); });
}

Result<Json> skin(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) { return pilot.care().skin(arguments.text("moment")); });
}

Result<Json> sideEffects(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) { return pilot.care().sideEffects(arguments.text("moment")); });
}

Result<Json> ratings(ScriptSession& session, const Arguments&) {
    return inPilot(session,
                   [](PilotSession& pilot) { return pilot.care().ratings(pilot.identification().presented()); });
}

Result<Json> finish(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session,
                   [&](PilotSession& pilot) { return pilot.stage().end(PilotEnd::Complete, arguments.text("why")); });
}

Result<Json> resultsOf(PilotSession& pilot, bool identification) {
    Json found;
    std::string said;
    if (identification) {
        auto all = pilot.identificationResults();
        if (!all) return failure(all);
        auto headline = pilot.headlineText();
        if (!headline) return failure(headline);
        found = std::move(*all);
        said = std::move(*headline);
    } else {
        found = pilot.thresholdResults();
    }
    found["verdict"] = nullptr;
    found["reasons"] = Json::array();
    const auto& range = pilot.thresholds().found();
    if (range && !range->usable) {
        found["verdict"] = "indeterminate";
        found["reasons"].push_back("No usable range: " + range->reason);
    }
    if (!said.empty()) {
        found["headline"] = said;
        found["reasons"].push_back(said);
    }
    return found;
}

Result<Json> results(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session,
                   [&](PilotSession& pilot) { return resultsOf(pilot, arguments.text("of") == "identification"); });
}

Result<Json> blocks(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) -> Result<Json> {
        Json all = Json::array();
        for (int block = 1; block <= pilot.stage().settings().blocks; ++block) all.push_back(block);
        return all;
    });
}

Result<Json> ascendingLimits(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) { return pilot.thresholds().ascendingLimits(); });
}

Result<Json> detection(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) -> Result<Json> {
        const auto method = detectionMethodFrom(arguments.text("options.method"));
        if (!method) return failure(method);
        return done(pilot.thresholds().detection(*method));
    });
}

Result<Json> range(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) -> Result<Json> {
        if (auto found = pilot.thresholds().range(); !found) return failure(found);
        return Json(pilot.thresholds().rangeJson());
    });
}

Result<Json> measureAgain(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) -> Result<Json> {
        const auto again = pilot.thresholds().measureAgain();
        if (!again) return failure(again);
        return Json(*again);
    });
}

Result<Json> comparison(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) { return pilot.thresholds().comparison(); });
}

Result<Json> familiarise(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) { return pilot.identification().familiarise(); });
}

Result<Json> train(ScriptSession& session, const Arguments&) {
    return inPilot(session, [](PilotSession& pilot) { return pilot.identification().train(); });
}

Result<Json> beforeBlock(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) { return pilot.beforeBlock(arguments.whole("block")); });
}

Result<Json> driftCheck(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) -> Result<Json> {
        const auto goesOn = pilot.identification().driftCheck(arguments.whole("block"));
        if (!goesOn) return failure(goesOn);
        return Json(*goesOn);
    });
}

Result<Json> testBlock(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session,
                   [&](PilotSession& pilot) { return pilot.identification().testBlock(arguments.whole("block")); });
}

Result<Json> takeBreak(ScriptSession& session, const Arguments& arguments) {
    return inPilot(session, [&](PilotSession& pilot) {
        return pilot.identification().takeBreak(arguments.whole("block"), Seconds(arguments.number("seconds")));
    });
}

}  // namespace

}  // namespace host::pilot

std::vector<HostFunction> pilotFunctions() {
    using namespace takes;
    constexpr std::string_view kEnds =
        "Throws when the session ends: stopped for the third time, a second fault, a gate that does not hold; and "
        "outside a session of a study.";
    const auto block = whole("block", "of the test, from 1").range(1, 50);
    return {
        {.name = "begin",
         .parameters =
             {flag("options.trials", "the session has trials, so their order is drawn and kept").otherwise(true)},
         .text =
             "Draws the order of the session from its seed and stores it, then goes through the checklist: machine, "
             "both STOPs, skin, electrodes or massager. What an earlier part of the session stored is taken from "
             "there: nothing that was answered is asked or presented again.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::begin},
        {.name = "blocks",
         .kind = HostKind::Property,
         .text = "The numbers of the test's blocks.",
         .returns = "List of whole numbers from 1.",
         .call = host::pilot::blocks},
        {.name = "skin",
         .parameters = {text("moment", "\"before\", \"break 3\", \"after\"")},
         .text =
             "The operator scores redness and swelling from 0 to 4. Before, both must be 0; later 2 ends the session "
             "and is an adverse event.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::skin},
        {.name = "sideEffects",
         .parameters = {text("moment", "\"before\", \"after\"")},
         .text = "Asks which side effects the participant notices, how severe each is and how related.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::sideEffects},
        {.name = "ascendingLimits",
         .text =
             "Three series of rising levels, each until the participant says \"too strong\", under the gate's ceiling "
             "of the last accepted level and one step.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::ascendingLimits},
        {.name = "detection",
         .parameters = {text("options.method", "how the level of each trial is chosen")
                            .oneOf({"quest", "staircase"})
                            .otherwise("quest")},
         .text = "The detection threshold by trials of two intervals, of which one holds a train.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::detection},
        {.name = "range",
         .text = "The levels between which the participant's conditions lie today. The highest is felt for 4 s and "
                 "accepted for half an hour.",
         .returns = "{ usable, reason, min_ma, max_ma, min_v, max_v, jnd, impedance_ohm, limited_by }; with a massager "
                    "{ usable, reason, min_intensity, max_intensity, jnd, limited_by }",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::range},
        {.name = "measureAgain",
         .text = "After a range that is not usable: asks the operator whether ascendingLimits(), detection() and "
                 "range() are done once more, twice at most. What was called too strong stays the ceiling.",
         .returns = "true where they are",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::measureAgain},
        {.name = "comparison",
         .text =
             "The participant's Weber fraction of strength, by 40 trials of two intervals with a train in each, both "
             "within the range: in which was it stronger? Does nothing without a usable range.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::comparison},
        {.name = "familiarise",
         .text = "Three rounds of the four conditions and nothing, each with its name; then any of them on demand.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::familiarise},
        {.name = "train",
         .text = "Blocks of 8 with feedback, until 7 of 8 are right or after four blocks. Excludes no participant.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::train},
        {.name = "beforeBlock",
         .parameters = {block},
         .text = "Asks again whether the study is still approved, and measures the electrodes: within 30 % of the "
                 "session's beginning.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::beforeBlock},
        {.name = "driftCheck",
         .parameters = {block},
         .text =
             "12 detection trials: whether the lowest level is still felt. Where it is not, a rest of 5 min and "
             "again, three times at most; then the block is marked as adapted, and the participant says whether to go "
             "on.",
         .returns = "false where the participant ends the session here",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::driftCheck},
        {.name = "testBlock",
         .parameters = {block},
         .text = "The block's trials, without feedback. A trial without an answer is put once more at its end.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::testBlock},
        {.name = "takeBreak",
         .parameters = {block, number("seconds", "s", "at least").range(0, 3600)},
         .text = "Output off for at least that time after a block, until both people press on.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::takeBreak},
        {.name = "ratings",
         .text = "Each condition once more without its name: intensity, unpleasantness, pain, naturalness, qualities. "
                 "In a session with the participant's second encoding also which was easier, and which is more like "
                 "touch.",
         .errors = kEnds,
         .failsDisarmed = true,
         .call = host::pilot::ratings},
        {.name = "finish",
         .parameters = {text("why", "\"complete\", \"no usable range\"")},
         .text = "Ends the session as complete.",
         .errors = kEnds,
         .call = host::pilot::finish},
        {.name = "results",
         .parameters = {text("of", "which results").oneOf({"thresholds", "identification"})},
         .text = "What the session has come to, from its rows.",
         .returns = "What verdict() takes; indeterminate where there is no usable range, else without a verdict.",
         .errors = "Throws outside a session of a study.",
         .call = host::pilot::results},
    };
}

}  // namespace tacto
