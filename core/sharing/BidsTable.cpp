#include "core/sharing/BidsTable.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

#include "core/study/NextDay.h"

namespace tacto {

namespace {

constexpr std::string_view kMissing = "n/a";

/// Replaces tabs and line ends, which would begin another cell.
std::string oneCell(std::string_view value) {
    if (value.empty()) return std::string(kMissing);
    std::string out(value);
    for (char& c : out) {
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    return out;
}

}  // namespace

BidsCell::BidsCell(double value) : text(std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string(kMissing)) {}
BidsCell::BidsCell(std::size_t value) : text(fmt::format("{}", value)) {}
BidsCell::BidsCell(bool value) : text(value ? "true" : "false") {}
BidsCell::BidsCell(std::string_view value) : text(oneCell(value)) {}
BidsCell::BidsCell(std::optional<int> value) : text(value ? fmt::format("{}", *value) : std::string(kMissing)) {}
BidsCell::BidsCell(std::optional<bool> value) : text(!value ? kMissing : *value ? "true" : "false") {}

void BidsTable::add(std::vector<BidsCell> cells) {
    assert(cells.size() == columns_.size());
    rows_.push_back(std::move(cells));
}

std::string BidsTable::tsv() const {
    std::string out;
    for (const auto& column : columns_) out += (&column == &columns_.front() ? "" : "\t") + column.name;
    out += '\n';
    for (const auto& row : rows_) {
        for (const auto& cell : row) out += (&cell == &row.front() ? "" : "\t") + cell.text;
        out += '\n';
    }
    return out;
}

nlohmann::json BidsTable::sidecar() const {
    auto out = nlohmann::json::object();
    for (const auto& column : columns_) {
        nlohmann::json about{{"Description", column.description}};
        if (!column.units.empty()) about["Units"] = column.units;
        for (const auto& [level, meaning] : column.levels) about["Levels"][level] = meaning;
        out[column.name] = std::move(about);
    }
    return out;
}

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

/// The words of BIDS contain only letters, digits and underscores; conditions keep their names.
std::string shared(std::string_view response) {
    return response == kNotSureResponse ? "not_sure" : std::string(response);
}

/// Whether the answer was right; nothing if there was no answer or no question.
std::optional<bool> isRight(const IdentificationTrial& trial) {
    if (trial.response.empty()) return std::nullopt;
    if (trial.condition == kCatchCondition) return trial.response == kNoneResponse;
    return trial.response == trial.condition;
}

const BidsColumn kCurrent{"current_ma", "Amplitude of each phase of the pulses", "mA"};
const BidsColumn kIntensity{"intensity", "Strength of the massager, 0 to 1"};

const std::vector<BidsColumn> kStimulated = {
    kCurrent,
    kIntensity,
    {"voltage_v", "Current times the magnitude of the impedance", "V"},
    {"interval_s", "Between the onsets of trains", "s"},
    {"trains", "Trains delivered"},
    {"impedance_ohm", "Magnitude of the electrodes' impedance, measured last before the trial", "ohm"},
    {"detection_ma", "Detection threshold (80 % right of two intervals), measured last before it", "mA"}};
const std::vector<BidsColumn> kVibrated = {
    kIntensity,
    {"interval_s", "Between the commanded onsets of vibrations", "s"},
    {"vibrations", "Vibrations delivered"},
    {"detection_intensity", "Detection threshold (80 % right of two intervals), measured last before it"},
    {"acceleration_m_s2", "Of the motor in its vibrations, root mean square; n/a where no accelerometer was on it",
     "m/s^2"},
    {"latency_s", "From the command to the motor's onset, measured", "s"},
    {"measured_interval_s", "Between the motor's onsets, measured", "s"}};

void append(std::vector<BidsCell>& cells, std::initializer_list<BidsCell> more) {
    cells.insert(cells.end(), more.begin(), more.end());
}

}  // namespace

BidsTable identificationTable(const BidsSession& session, bool massager) {
    std::vector<BidsColumn> columns = {
        {"trial", "Number in the session's plan; training that was not needed leaves holes"},
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
        {"attempt", "2 and more where the presentation was interrupted, or not answered, before"}};
    const auto& felt = massager ? kVibrated : kStimulated;
    columns.insert(columns.end(), felt.begin(), felt.end());
    columns.push_back({"adapted", "Whether the weakest level may not have been felt in this block", "", kYesNo});
    BidsTable table(std::move(columns));
    for (const auto& row : session.trials) {
        const auto& trial = row.trial;
        const bool isCatch = trial.condition == kCatchCondition;
        const auto features = isCatch ? LabelFeatures{} : featuresOf(trial.condition);
        const double interval_s = isCatch ? kNaN : trial.interval_s;
        std::vector<BidsCell> cells = {trial.number,    trial.block,      nameOf(trial.phase), session.encoding,
                                       trial.condition, features.texture, features.pressure,   shared(trial.response),
                                       isRight(trial),  trial.rt_s,       trial.attempt};
        if (massager)
            append(cells, {row.intensity, interval_s, trial.trains, row.detection, row.vibration.strength_m_s2,
                           row.vibration.latency_s, row.vibration.interval_s});
        else
            append(cells,
                   {trial.current, row.intensity, row.voltage, interval_s, trial.trains, row.impedance, row.detection});
        cells.emplace_back(row.adapted);
        table.add(std::move(cells));
    }
    return table;
}

BidsTable thresholdsTable(const BidsSession& session, bool massager) {
    std::vector<BidsColumn> columns = {
        {"trial", "Number within its procedure, from 1"},
        {"procedure",
         "How the threshold was sought",
         "",
         {{"ascending", "ascending limits, from 0"},
          {"detection", "two intervals, which of them held the train"},
          {"range", "whether half an hour of this level would be borne"},
          {"comparison", "two intervals with a train in each, which of them was stronger"},
          {"drift", "detection again before a later block"}}},
        {"measurement", "Which measurement of the range, from 1; thresholds in the table of sessions are of the last"},
        {"series", "Series of the ascending limits, or the block before which drift was checked"},
        {"trial_type",
         "What was presented",
         "",
         {{"stimulus", "trains at the level"},
          {"catch", "nothing"},
          {"first", "a train in the first interval; in a comparison the stronger"},
          {"second", "a train in the second interval; in a comparison the stronger"}}}};
    if (!massager) columns.push_back(kCurrent);
    columns.push_back(kIntensity);
    columns.push_back(massager
                          ? BidsColumn{"weaker_intensity", "Strength in the other interval of a comparison, 0 to 1"}
                          : BidsColumn{"weaker_ma", "Amplitude in the other interval of a comparison", "mA"});
    columns.push_back({"response", "What was answered; stop: the person stopped the output"});
    columns.push_back({"correct", "Whether the right interval was named", "", kYesNo});
    columns.push_back({"response_time", "From the appearance of the targets to the answer", "s"});
    BidsTable table(std::move(columns));
    for (const auto& row : session.thresholds) {
        std::vector<BidsCell> cells = {row.number, row.procedure, row.measurement,
                                       row.series > 0 ? BidsCell(row.series) : BidsCell(kNaN), row.type};
        if (!massager) cells.emplace_back(row.current);
        append(cells, {row.intensity, row.weaker, row.response, row.correct, row.response_s});
        table.add(std::move(cells));
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

BidsTable sideEffectsTable(const BidsSession& session, bool massager) {
    BidsTable table({{"moment",
                      "When it was asked",
                      "",
                      {{"before", "before the first stimulation"},
                       {"after", massager ? "after the massager was taken off" : "after the electrodes were taken off"},
                       {kNextDayMoment, "on a later day"}}},
                     {"item", "What was noticed"},
                     {"severity", scaleText(kSideEffectSeverities)},
                     {"relation", "To the stimulation: " + scaleText(kRelations)}});
    for (const auto& row : session.sideEffects) table.add({row.moment, row.item, row.severity, row.relation});
    return table;
}

}  // namespace tacto
