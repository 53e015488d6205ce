#include "core/sharing/BidsSessionTables.h"

#include <algorithm>

namespace tacto {

namespace {

using Levels = std::vector<std::pair<std::string, std::string>>;

const Levels kYesNo = {{"true", "yes"}, {"false", "no"}};

Levels conditionLevels(const BidsSession& session, bool withAnswers) {
    Levels levels;
    for (const auto& label : session.labels)
        levels.emplace_back(label, "texture, then pressure, as named to the person");
    if (!withAnswers) {
        levels.emplace_back("catch", "nothing was presented");
        return levels;
    }
    levels.emplace_back("none", "nothing was felt");
    levels.emplace_back("not_sure", "the person could not say");
    return levels;
}

/// BIDS has letters, digits and underscores in words of its own; conditions keep their names.
std::string shared(std::string_view response) {
    return response == kNotSureResponse ? "not_sure" : std::string(response);
}

/// Whether the answer was right; nothing without one, and where nothing was asked.
std::optional<bool> isRight(const IdentificationTrial& trial) {
    if (trial.response.empty()) return std::nullopt;
    if (trial.condition == kCatchCondition) return trial.response == kNoneResponse;
    return trial.response == trial.condition;
}

const BidsColumn kCurrent{"current_ma", "Amplitude of each phase of the pulses", "mA"};
const BidsColumn kIntensity{"intensity", "Strength of the massager, 0 to 1"};

}  // namespace

BidsTable identificationTable(const BidsSession& session) {
    BidsTable table(
        {{"trial", "Number in the session's plan; training that was not needed leaves holes"},
         {"block", "Block within its phase, from 1"},
         {"phase",
          "Part of the session",
          "",
          {{"familiarisation", "named, nothing asked"}, {"training", "with feedback"}, {"test", "without feedback"}}},
         {"encoding", "Which stimulus has which name"},
         {"trial_type", "What was presented", "", conditionLevels(session, false)},
         {"texture", "Texture of the condition's name"},
         {"pressure", "Pressure of the condition's name"},
         {"response", "What was answered", "", conditionLevels(session, true)},
         {"correct", "Whether the answer names what was presented; none is right for catch trials", "", kYesNo},
         {"response_time", "From the appearance of the targets to the answer", "s"},
         {"attempt", "2 and more where the presentation was interrupted, or not answered, before"},
         kCurrent,
         kIntensity,
         {"voltage_v", "Current times the magnitude of the impedance", "V"},
         {"interval_s", "Between the onsets of trains", "s"},
         {"trains", "Trains delivered"},
         {"impedance_ohm", "Magnitude of the electrodes' impedance, measured last before the trial", "ohm"},
         {"detection_ma", "Detection threshold (80 % right of two intervals), measured last before it", "mA"},
         {"adapted", "Whether the weakest level may not have been felt in this block", "", kYesNo}});
    for (const auto& row : session.trials) {
        const auto& trial = row.trial;
        const bool isCatch = trial.condition == kCatchCondition;
        const auto features = isCatch ? LabelFeatures{} : featuresOf(trial.condition);
        table.add({trial.number, trial.block, nameOf(trial.phase), session.encoding, trial.condition, features.texture,
                   features.pressure, shared(trial.response), isRight(trial), trial.rt_s, trial.attempt, trial.current,
                   row.intensity, row.voltage, isCatch ? kNaN : trial.interval_s, trial.trains, row.impedance,
                   row.detection_ma, row.adapted});
    }
    return table;
}

BidsTable thresholdsTable(const BidsSession& session) {
    BidsTable table({{"trial", "Number within its procedure, from 1"},
                     {"procedure",
                      "How the threshold was sought",
                      "",
                      {{"ascending", "ascending limits, from 0"},
                       {"detection", "two intervals, which of them held the train"},
                       {"range", "whether half an hour of this level would be borne"},
                       {"drift", "detection again before a later block"}}},
                     {"series", "Series of the ascending limits, or the block before which drift was checked"},
                     {"trial_type",
                      "What was presented",
                      "",
                      {{"stimulus", "trains at the level"},
                       {"catch", "nothing"},
                       {"first", "a train in the first interval"},
                       {"second", "a train in the second interval"}}},
                     kCurrent,
                     kIntensity,
                     {"response", "What was answered; stop: the person stopped the output"},
                     {"correct", "Whether the right interval was named", "", kYesNo},
                     {"response_time", "From the appearance of the targets to the answer", "s"}});
    for (const auto& row : session.thresholds) {
        table.add({row.number, row.procedure, row.series > 0 ? BidsCell(row.series) : BidsCell(kNaN), row.type,
                   row.current, row.intensity, row.response, row.correct, row.response_s});
    }
    return table;
}

BidsTable ratingsTable(const BidsSession& session) {
    BidsTable table({{"item",
                      "What was asked",
                      "",
                      {{"intensity", "how strong, 0 to 10"},
                       {"unpleasantness", "how unpleasant, 0 to 10"},
                       {"pain", "how painful, 0 to 10"},
                       {"naturalness", "totally natural to totally unnatural, five words"},
                       {"qualities", "what it felt like, any number of words"},
                       {"easier", "after a second encoding: which was easier to tell"},
                       {"more-like-touch", "after a second encoding: which fits better what touch is like"}}},
                     {"trial_type", "What was presented", "", conditionLevels(session, false)},
                     {"value", "The answer: a number, or words"}});
    for (const auto& row : session.ratings) table.add({row.item, row.condition, row.value});
    return table;
}

BidsTable sideEffectsTable(const BidsSession& session) {
    BidsTable table({{"moment",
                      "When it was asked",
                      "",
                      {{"before", "before the first stimulation"},
                       {"after", "after the electrodes were taken off"},
                       {"next day", "on the day after"}}},
                     {"item", "What was noticed"},
                     {"severity", "1 absent, 2 mild, 3 moderate, 4 severe"},
                     {"relation", "To the stimulation: 1 none, 2 remote, 3 possible, 4 probable, 5 definite"}});
    for (const auto& row : session.sideEffects) table.add({row.moment, row.item, row.severity, row.relation});
    return table;
}

}  // namespace tacto
