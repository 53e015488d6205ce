#include "core/study/StudyLog.h"

#include <algorithm>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "core/base/Words.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto {

namespace {

using Is = StudyLogField::Is;

std::vector<StudyLogKind> describedKinds() {
    return {
        {kParticulars,
         "Particulars of the study",
         "Particulars of the study",
         "What a reader of the results asks. Leave empty what is not known: reports then say “unknown”.",
         true,
         {{"rationale", "Background", "What is known, and why a pilot comes before a larger study."},
          {"objectives", "Objectives", "What the pilot is to find out."},
          {"assessments", "What is measured for each objective", "And when."},
          {"progression_criteria", "Progression criteria", "By which it is decided whether a larger study follows."},
          {"sample_size_rationale", "Reason for the number of participants", ""},
          {"changes", "Why the plan was changed", "The reason of each amendment."},
          {"stopping_rule", "When the study would end early", ""},
          {"ended_because", "Why the study ended", ""},
          {"setting", "Setting", "Kind of place and of people; never an address of a participant."},
          {"recruitment", "How participants were found", ""},
          {"medication",
           "Medication of participants",
           "What was permitted, and what was taken; never of one person.",
           Is::Text,
           {},
           false,
           "Medication"},
          {"concurrent_task",
           "Task during the stimulation",
           "What people did besides answering; none.",
           Is::Text,
           {},
           false,
           "ConcurrentTask"},
          {"investigators", "Investigators and sites", "Who is responsible, and where."},
          {"sponsor", "Sponsor", ""},
          {"registration", "Registration", "Register and number."},
          {"plan_access", "Where the study plan can be read", ""},
          {"funding", "Funding", "Who paid, and what for."},
          {"interests", "Interests", "What ties those who run the study to its outcome; none."},
          {"stimulator_make", "Make of the stimulator", "", Is::Text, {}, false, "Manufacturer"},
          {"stimulator_model", "Model of the stimulator", "", Is::Text, {}, false, "ManufacturersModelName"},
          {"stimulator_serial", "Serial number of the stimulator", "", Is::Text, {}, false, "DeviceSerialNumber"},
          {"electrode_make", "Make and model of the electrodes", "", Is::Text, {}, false, "ElectrodeModelName"},
          {"electrode_shape",
           "Shape of the electrodes",
           "",
           Is::Words,
           {"circular", "rectangular", "oval", "ring", "other"},
           false,
           "ElectrodeShape"},
          {"electrode_material",
           "Material of the electrodes",
           "Ag/AgCl, carbon rubber, steel.",
           Is::Text,
           {},
           false,
           "ElectrodeMaterial"},
          {"contact_medium",
           "Between electrode and skin",
           "",
           Is::Words,
           {"hydrogel", "gel", "paste", "saline", "water", "dry", "other"},
           false,
           "ContactMedium"},
          {"skin_preparation",
           "Preparation of the skin",
           "Cleaned with alcohol, abraded, shaved, none.",
           Is::Text,
           {},
           false,
           "SkinPreparation"},
          {"electrode_placement",
           "How the place of the electrodes was found",
           "Landmarks, a twitch, where it is felt.",
           Is::Text,
           {},
           false,
           "ElectrodePlacement"},
          {"leading_electrode",
           "Electrode that leads",
           "Whose phase comes first as cathode.",
           Is::Words,
           {"proximal", "distal", "alternating"},
           false,
           "LeadingElectrode"}}},
        {kAssessed,
         "A person who was assessed and not enrolled",
         "Assessed and not enrolled",
         "Note a reason, and nothing by which the person could be known.",
         false,
         {{"reason",
           "Reason",
           "",
           Is::Words,
           {"did not meet the criteria", "declined", "no date was found", "other"},
           true},
          {"more", "More on the reason", "Which criterion, for example."}}},
        {"device",
         "Device accountability",
         "Device accountability",
         "Each device of the study, from its receipt to its return.",
         false,
         {{"serial", "Device and serial number", "", Is::Text, {}, true},
          {"what",
           "What happened",
           "",
           Is::Words,
           {"received", "checked", "put into use", "taken out of use", "returned", "disposed of"},
           true},
          {"day", "Day", "", Is::Date, {}, true},
          {"by", "Initials", "", Is::Text, {}, true},
          {"more", "Remarks", ""}}},
        {"deficiency",
         "A device deficiency",
         "Device deficiencies",
         "A fault, a misuse or a wrong label of a device, even if it harmed no one.",
         false,
         {{"serial", "Device and serial number", "", Is::Text, {}, true},
          {"what", "What was deficient", "", Is::Text, {}, true},
          {"day", "Day", "", Is::Date},
          {"could_harm", "It could have led to a serious event", "", Is::Words, {"yes", "no"}},
          {"action", "What was done", ""},
          {"reported", "Reported to committee or sponsor", "", Is::Words, {"yes", "no"}}}},
        {"deviation",
         "A deviation from the plan",
         "Deviations from the plan",
         "What was done otherwise than approved, by whom it was noticed, and what follows.",
         false,
         {{"what", "What was done otherwise", "", Is::Text, {}, true},
          {"day", "Day", "", Is::Date},
          {"why", "Why", ""},
          {"safety", "It touched safety or rights", "", Is::Words, {"yes", "no"}},
          {"action", "What was done", ""},
          {"reported", "Reported to the committee", "", Is::Words, {"yes", "no"}}}}};
}

}  // namespace

const StudyLogField* StudyLogKind::field(std::string_view fieldKey) const noexcept {
    const auto found = std::ranges::find(fields, fieldKey, &StudyLogField::key);
    return found == fields.end() ? nullptr : &*found;
}

const std::vector<StudyLogKind>& studyLogKinds() {
    static const auto all = describedKinds();
    return all;
}

Result<const StudyLogKind*> studyLogKind(std::string_view key) {
    std::vector<std::string_view> keys;
    for (const auto& kind : studyLogKinds()) {
        if (kind.key == key) return &kind;
        keys.emplace_back(kind.key);
    }
    return invalid("\"{}\" is no kind of note; one of {} is expected", key.substr(0, 40), fmt::join(keys, ", "));
}

std::string StudyNote::text(std::string_view field) const {
    const auto found = said.find(std::string(field));
    return found == said.end() || found->second.empty() ? std::string(kNoWord) : found->second;
}

Result<void> checkNote(const StudyNote& note) {
    constexpr std::size_t kMaxBytes = 2000;
    const auto kind = studyLogKind(note.kind);
    if (!kind) return failure(kind);
    std::vector<std::string_view> keys;
    for (const auto& field : (*kind)->fields) keys.emplace_back(field.key);
    bool says = false;
    for (const auto& [key, text] : note.said) {
        const auto* field = (*kind)->field(key);
        if (field == nullptr)
            return invalid("\"{}\" is no field of {}; there are {}", key, note.kind, fmt::join(keys, ", "));
        if (text.empty()) continue;
        says = true;
        if (text.size() > kMaxBytes)
            return invalid("{} has {} bytes; up to {} are accepted", key, text.size(), kMaxBytes);
        if (field->is == Is::Words && text != kNoWord && std::ranges::find(field->words, text) == field->words.end()) {
            return invalid("{} is \"{}\"; one of {} is accepted, or unknown", key, text.substr(0, 40),
                           fmt::join(field->words, ", "));
        }
        if (field->is == Is::Date && text != kNoWord && !parseDate(text))
            return invalid("{} is \"{}\"; a day as 2026-11-21 is accepted, or unknown", key, text.substr(0, 40));
    }
    for (const auto& field : (*kind)->fields) {
        const auto given = note.said.find(field.key);
        if (field.needed && (given == note.said.end() || given->second.empty()))
            return invalid("{} of {} is missing; a text is expected, or unknown", field.key, note.kind);
    }
    if (!says) return invalid("the note says nothing; at least one of its {} fields is expected", keys.size());
    return {};
}

StudyNote particularsOf(std::span<const StudyNote> notes) {
    StudyNote all{kParticulars, {}, {}};
    for (const auto& note : notes) {
        if (note.kind != kParticulars) continue;
        all.at = note.at;
        for (const auto& [key, text] : note.said) all.said[key] = text;
    }
    return all;
}

nlohmann::json toJson(const StudyNote& note) { return note.said; }

Result<std::map<std::string, std::string>> noteTextsFrom(const nlohmann::json& json) {
    std::map<std::string, std::string> said;
    for (const auto& [key, text] : json.items()) {
        if (!text.is_string()) return fail(ErrorCode::ParseError, "\"{}\" of a note is not a text", key);
        said.emplace(key, text.get<std::string>());
    }
    return said;
}

}  // namespace tacto
