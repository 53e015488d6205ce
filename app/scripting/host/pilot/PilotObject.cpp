// The object "pilot", a session of a study with a participant: what scripts can call, and what each function takes and
// returns.
#include "app/scripting/host/pilot/PilotObject.h"

namespace tacto {

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
