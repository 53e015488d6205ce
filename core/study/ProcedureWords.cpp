#include "core/study/ProcedureWords.h"

#include <algorithm>

namespace tacto {

namespace {

struct SettingName {
    std::string_view key;
    std::string_view words;
    std::string_view withMassager = {};  ///< empty: the key is about current
};

constexpr std::string_view kShortest = "shortest interval", kLongest = "longest interval",
                           kMethod = "method of detection", kTrials = "trials of each condition in a block",
                           kEmpty = "empty trials in a block", kComparison = "Weber fraction of strength",
                           kPain = "pain ceiling";
constexpr SettingName kNames[] = {
    {"procedure.interval_min_s", kShortest, kShortest},
    {"procedure.interval_max_s", kLongest, kLongest},
    {"procedure.method", kMethod, kMethod},
    {"procedure.comparison", kComparison, kComparison},
    {"procedure.conditions_sha256", "conditions, assignment, polarity, pulse rate, load range or ceilings",
     "conditions or their assignment"},
    {"per_condition", kTrials, kTrials},
    {"catch", kEmpty, kEmpty},
    {"pain_ceiling", kPain, kPain},
    {"train.shape", "shape of the pulses"},
    {"train.width_us", "width of a phase"},
    {"train.gap_us", "gap between the phases"},
    {"train.pulses", "pulses of a train"},
    {"train.rate_hz", "pulse rate"},
    {"electrode.type", "type of the electrodes"},
    {"electrode.area_cm2", "area of the electrodes"},
    {"electrode.distance_mm", "distance of the electrodes"},
    {"cap_ma", "highest current"}};

std::string trainWords(const StudyTrain& train) {
    auto words = fmt::format("{}, {} pulse{} of {:g} µs a phase, {:g} µs between the phases", train.shape, train.pulses,
                             train.pulses == 1 ? "" : "s", train.width_us, train.gap_us);
    if (train.pulses > 1 && train.rate_hz > 0) words += fmt::format(", at {:g} Hz", train.rate_hz);
    return words;
}

std::string methodWords(DetectionMethod method) {
    return method == DetectionMethod::Quest ? "QUEST+" : "weighted staircase";
}

}  // namespace

std::vector<ProcedureFact> approvedProcedure(const StudySettings& settings) {
    std::vector<ProcedureFact> all;
    all.push_back({"Site", std::string(nameOf(settings.site))});
    if (settings.modality == Modality::Electrodes) {
        const auto& electrode = settings.electrode;
        all.push_back({"Electrodes", fmt::format("{}, {:g} cm², {:g} mm apart", electrode.type, electrode.area.value(),
                                                 electrode.distance_mm)});
        all.push_back({"Train", trainWords(settings.train)});
    }
    if (const auto& procedure = settings.procedure) {
        all.push_back({"Intervals", fmt::format("{:g} to {:g} s from onset to onset", procedure->intervalMin_s,
                                                procedure->intervalMax_s)});
        const auto* const hashed = settings.modality == Modality::Massager
                                       ? "assignment"
                                       : "assignment, polarity, pulse rate, load range and ceilings";
        all.push_back(
            {"Conditions", fmt::format("texture and pressure, {}; with {} as hashed: {:.12}…",
                                       fmt::join(settings.encodings, " and "), hashed, procedure->conditionsSha256)});
        all.push_back({"Detection", methodWords(procedure->method)});
        all.push_back({"Weber fraction of strength",
                       procedure->comparison ? "measured with the thresholds, 40 trials" : "not measured"});
    } else {
        all.push_back({"Intervals, conditions, detection",
                       "not kept by this approval, so a session is not held to them; an amendment names them"});
    }
    all.push_back({"Test", fmt::format("{} blocks, each {} times each condition and {} times nothing", settings.blocks,
                                       settings.perCondition, settings.catchTrials)});
    all.push_back(
        {"Pain ceiling", settings.painCeiling
                             ? fmt::format("{} of 10", *settings.painCeiling)
                             : fmt::format("not kept by this approval; sessions are held to {} of 10", kPainCeiling)});
    return all;
}

std::string amendedWords(std::string_view key, Modality modality) {
    const auto* const found = std::ranges::find(kNames, key, &SettingName::key);
    if (found == std::end(kNames)) return std::string(key);
    const auto words = modality == Modality::Massager ? found->withMassager : found->words;
    return std::string(words.empty() ? key : words);
}

}  // namespace tacto
