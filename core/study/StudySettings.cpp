#include "core/study/StudySettings.h"

#include <algorithm>

#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/TypedNumber.h"
#include "core/session/Digest.h"
#include "core/study/Gates.h"

namespace tacto {

namespace {

constexpr Word<StudyKind> kStudyKinds[] = {{"study", StudyKind::Study}, {"rehearsal", StudyKind::Rehearsal}};
constexpr Word<ElectrodeSite> kElectrodeSites[] = {{"forearm", ElectrodeSite::Forearm},
                                                   {"residual limb's end", ElectrodeSite::ResidualLimbEnd},
                                                   {"upper arm", ElectrodeSite::UpperArm},
                                                   {"hand", ElectrodeSite::Hand}};
constexpr Word<Nerve> kNerves[] = {{"radial", Nerve::Radial}, {"median", Nerve::Median}, {"ulnar", Nerve::Ulnar}};
constexpr Word<Limb> kLimbs[] = {{"left", Limb::Left}, {"right", Limb::Right}};
constexpr Word<DataOnRequest> kDataOnRequest[] = {{"destroy", DataOnRequest::Destroy}, {"keep", DataOnRequest::Keep}};
/// The four conditions of two textures and two pressures. Their names are in the protocol, never in plain text here.
constexpr std::string_view kTexturePressure = "texture-pressure";
/// The encodings: texture and pressure as they are, or exchanged.
constexpr std::string_view kEncodings[] = {"standard", "swapped"};

constexpr std::size_t kMaxOwnExclusions = 20;

constexpr AcceptedText kShortText{.mostBytes = 200};
constexpr AcceptedText kOptionalText{.mayBeEmpty = true, .mostBytes = 200};

RecordFields<Approval> approvalFields() {
    using A = Approval;
    RecordFields<A> all;
    all.text("reference", &A::reference, kOptionalText);
    all.text("committee", &A::committee, kOptionalText);
    all.add("from", &A::from, dateKind());
    all.add("expires", &A::expires, dateKind());
    all.text("protocol_version", &A::protocolVersion, kOptionalText);
    all.text("protocol_sha256", &A::protocolSha256, kOptionalText);
    all.rule([](const A& approval) -> Result<void> {
        if (approval.from <= approval.expires) return {};
        return invalid("the approval begins on {} and expires on {}; a later day is expected", dateText(approval.from),
                       dateText(approval.expires));
    });
    return all;
}

RecordFields<StudyElectrode> electrodeFields() {
    using E = StudyElectrode;
    RecordFields<E> all;
    all.text("type", &E::type, kShortText);
    all.number("area_cm2", &E::area, {.low = 0, .high = 500, .openLow = true, .unit = "cm²"});
    all.number("distance_mm", &E::distance_mm, {.low = 0, .high = 500, .openLow = true, .unit = "mm"});
    return all;
}

RecordFields<StudyTrain> trainFields() {
    using T = StudyTrain;
    RecordFields<T> all;
    all.text("shape", &T::shape, kShortText);
    all.number("width_us", &T::width_us, {.low = 10, .high = 1000, .unit = "µs"});
    all.number("gap_us", &T::gap_us, {.low = 0, .high = 1000, .unit = "µs"});
    all.number("pulses", &T::pulses, {.low = 1, .high = 1000});
    all.number("rate_hz", &T::rate_hz, {.low = 0, .high = 1000, .unit = "Hz"});
    all.rule([](const T& train) -> Result<void> {
        if (train.shape == kBiphasic) return {};
        return invalid("\"shape\" is \"{}\"; \"{}\" is expected: a person is given nothing else", train.shape,
                       kBiphasic);
    });
    return all;
}

RecordFields<StudyProcedure> procedureFields() {
    using P = StudyProcedure;
    RecordFields<P> all;
    all.number("interval_min_s", &P::intervalMin_s, {.low = 0.01, .high = 60, .unit = "s"});
    all.number("interval_max_s", &P::intervalMax_s, {.low = 0.01, .high = 60, .unit = "s"});
    all.word("method", &P::method, kDetectionMethods);
    all.text("conditions_sha256", &P::conditionsSha256, kOptionalText);
    all.flag("comparison", &P::comparison);
    return all;
}

RecordFields<WordsHash> wordsFields() {
    using W = WordsHash;
    RecordFields<W> all;
    all.texts({{"language", &W::code}, {"version", &W::version}, {"sha256", &W::sha256}}, kShortText);
    return all;
}

template <class Named>
RecordFields<Named> namedHashFields(std::string_view name, std::string Named::*member) {
    RecordFields<Named> all;
    all.text(name, member, kShortText);
    all.text("sha256", &Named::sha256, kShortText);
    return all;
}

RecordFields<StudySettings> buildStudyFields() {
    using S = StudySettings;
    RecordFields<S> all;
    all.text("id", &S::id, kOptionalText);
    all.text("title", &S::title, kShortText);
    all.word("kind", &S::kind, kStudyKinds);
    all.word("modality", &S::modality, kModalities);
    all.record("approval", &S::approval, approvalFields());
    all.text("consent_version", &S::consentVersion, kShortText);
    all.number("participants_max", &S::participantsMax, {.low = 1, .high = 10'000});
    all.number("sessions_max", &S::sessionsMax, {.low = 1, .high = 10'000});
    all.number("age_min", &S::ageMin, {.low = 1, .high = 120});
    all.number("gap_min_h", &S::gapMin_h, {.low = 0, .high = 10'000, .unit = "h"});
    all.number("session_max_min", &S::sessionMax_min, {.low = 1, .high = 240, .unit = "min"});
    all.number("cap_ma", &S::cap_mA, {.low = 0, .high = 15, .openLow = true, .unit = "mA"});
    all.list("limits", &S::limits, namedHashFields<LimitSetHash>("id", &LimitSetHash::id).kind(), 0, 20);
    all.word("site", &S::site, kElectrodeSites);
    all.word("nerve", &S::nerve, kNerves);
    all.word("limb", &S::limb, kLimbs);
    all.record("electrode", &S::electrode, electrodeFields());
    all.record("train", &S::train, trainFields());
    all.text("conditions", &S::conditions, kShortText);
    all.list("encodings", &S::encodings, textKind(kShortText), 1, 6);
    all.number("blocks", &S::blocks, {.low = 1, .high = 20});
    all.number("per_condition", &S::perCondition, {.low = 1, .high = 20});
    all.number("catch", &S::catchTrials, {.low = 0, .high = 20});
    all.flag("blind", &S::blind);
    all.word("data_on_request", &S::dataOnRequest, kDataOnRequest);
    all.number("pain_ceiling", &S::painCeiling, {.low = 1, .high = 10});
    all.list("exclusions", &S::exclusions, textKind(kShortText), 0, kMaxOwnExclusions);
    all.text("license", &S::license, kOptionalText);
    all.list("scripts", &S::scripts, namedHashFields<ScriptHash>("name", &ScriptHash::name).kind(), 0, 100);
    all.list("words", &S::words, wordsFields().kind(), 0, 100);
    all.record("procedure", &S::procedure, procedureFields());
    all.rule([](const S& settings) -> Result<void> {
        if (settings.conditions == kTexturePressure) return {};
        return invalid("\"conditions\" is \"{}\"; \"{}\" is expected", settings.conditions, kTexturePressure);
    });
    all.rule([](const S& settings) -> Result<void> {
        for (const auto& encoding : settings.encodings) {
            if (std::ranges::find(kEncodings, encoding) == std::end(kEncodings))
                return invalid("\"encodings\" holds \"{}\"; {} are accepted", encoding, fmt::join(kEncodings, " and "));
        }
        if (const auto* second = secondIn(settings.encodings))
            return invalid("\"encodings\": {}", givenTwice("\"{}\"", *second));
        return {};
    });
    return all;
}

/// Its values are separated by semicolons, because questions have commas.
constexpr std::string_view kExclusions = "exclusions";

/// Returns `text` as JSON of the same type as the field's value `before`.
Result<nlohmann::json> asJson(const nlohmann::json& before, std::string_view key, std::string_view text) {
    const auto refused = [&](std::string_view what) {
        return invalid("{} is \"{}\"; {} is expected", key, text, what);
    };
    if (before.is_boolean()) {
        if (text == "true" || text == "yes" || text == "on") return true;
        if (text == "false" || text == "no" || text == "off") return false;
        return refused("true or false");
    }
    if (before.is_number()) {
        if (const auto number = typedNumber(text)) return *number;
        return invalid("{} is \"{}\"; a number is expected{}", key, text, typedTrouble(text));
    }
    if (before.is_array()) {
        auto list = nlohmann::json::array();
        for (std::size_t from = 0; from <= text.size();) {
            const auto end = std::min(text.find(key == kExclusions ? ';' : ',', from), text.size());
            if (const auto each = trimmed(text.substr(from, end - from)); !each.empty() || key != kExclusions)
                list.push_back(std::string(each));
            from = end + 1;
        }
        return list;
    }
    if (before.is_object()) return refused("one of its fields, as KEY.FIELD=VALUE,");
    return nlohmann::json(std::string(text));
}

}  // namespace

std::string_view nameOf(StudyKind kind) noexcept { return wordFor(kStudyKinds, kind); }
std::string_view nameOf(ElectrodeSite site) noexcept { return wordFor(kElectrodeSites, site); }

std::string_view nameOf(DetectionMethod method) noexcept { return wordFor<DetectionMethod>(kDetectionMethods, method); }

std::string_view nameOf(DataOnRequest kept) noexcept { return wordFor<DataOnRequest>(kDataOnRequest, kept); }

std::string nameOf(const WordsHash& words) {
    return fmt::format("{}, version {} ({:.12}…)", words.code, words.version, words.sha256);
}

const RecordFields<StudySettings>& studyFields() { return builtOnce<buildStudyFields>(); }

Result<void> setStudyField(StudySettings& settings, std::string_view key, std::string_view value) {
    constexpr std::string_view kOwnOptions[] = {"id",
                                                "kind",
                                                "limits",
                                                "scripts",
                                                "words",
                                                "approval.reference",
                                                "approval.from",
                                                "approval.expires",
                                                "approval.protocol_sha256",
                                                "procedure.interval_min_s",
                                                "procedure.interval_max_s",
                                                "procedure.conditions_sha256"};
    const auto hasOwnOption = [&](std::string_view name) {
        return std::ranges::find(kOwnOptions, name) != std::end(kOwnOptions);
    };
    auto json = studyFields().write(settings);
    const auto dot = key.find('.');
    const auto outer = std::string(key.substr(0, dot));
    const bool known = json.contains(outer) && !hasOwnOption(key);
    auto* field = known ? &json[outer] : nullptr;
    if (field != nullptr && dot != std::string_view::npos) {
        const auto inner = std::string(key.substr(dot + 1));
        field = field->is_object() && field->contains(inner) ? &(*field)[inner] : nullptr;
    }
    if (field == nullptr) {
        std::string names;
        for (const auto& info : studyFields().infos()) {
            if (hasOwnOption(info.key) || info.key == "approval") continue;
            if (info.members.empty()) names += fmt::format("{}{}", names.empty() ? "" : ", ", info.key);
            for (const auto& member : info.members) {
                const auto name = fmt::format("{}.{}", info.key, member.key);
                if (!hasOwnOption(name)) names += ", " + name;
            }
        }
        return invalid("a study has no setting \"{}\"; there are {}", key, names);
    }
    auto next = asJson(*field, key, value);
    if (!next) return failure(next);
    *field = *std::move(next);
    auto changed = settings;
    if (auto read = studyFields().read({{outer, json[outer]}}, changed, RecordPlace{}); !read)
        return tl::unexpected<Error>(asInvalidArgument(read.error()));
    settings = std::move(changed);
    return {};
}

std::string protocolHash(const StudySettings& settings) {
    auto json = studyFields().write(settings);
    for (const char* key : {"id", "approval", "license"}) json.erase(key);
    if (!settings.procedure) json.erase("procedure");
    if (settings.words.empty()) json.erase("words");
    if (!settings.painCeiling) json.erase("pain_ceiling");
    if (!settings.ageMin) json.erase("age_min");
    if (settings.exclusions.empty()) json.erase("exclusions");
    return sha256Hex(dumpJson(json));
}

std::string runHash(StudySettings settings, const StudyProcedure& procedure) {
    settings.procedure = procedure;
    return protocolHash(settings);
}

namespace {

struct SettingName {
    std::string_view key;
    std::string_view words;
    std::string_view withMassager = {};  ///< empty: the key is about current
};

constexpr std::string_view kShortest = "shortest interval", kLongest = "longest interval",
                           kMethod = "method of detection", kTrials = "trials of each condition in a block",
                           kEmpty = "empty trials in a block", kComparison = "Weber fraction of strength",
                           kPain = "pain ceiling", kAge = "lowest age",
                           kOwn = "own questions of the exclusion checklist", kReads = "words of the participant";
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
    {"age_min", kAge, kAge},
    {"exclusions", kOwn, kOwn},
    {"words", kReads, kReads},
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
        all.push_back({"Nerve and side",
                       fmt::format("{}, {}", wordFor(kNerves, settings.nerve), wordFor(kLimbs, settings.limb))});
        const auto& electrode = settings.electrode;
        all.push_back({"Electrodes", fmt::format("{}, {:g} cm², {:g} mm apart", electrode.type, electrode.area.value(),
                                                 electrode.distance_mm)});
        all.push_back({"Train", trainWords(settings.train)});
    }
    for (const auto& each : settings.words) all.push_back({"Words of the participant", nameOf(each)});
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
                       procedure->comparison ? "measured in each session after the range, 40 trials" : "not measured"});
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
    if (settings.ageMin) all.push_back({"Age", fmt::format("{} years or more", *settings.ageMin)});
    std::string asked;
    for (const auto& item : exclusionItems(settings)) asked += (asked.empty() ? "" : " ") + item.question;
    all.push_back({"Excluded who says yes", asked});
    all.push_back({"Sessions", fmt::format("at most {} of each participant and of {:g} min, {:g} h or more apart",
                                           settings.sessionsMax, settings.sessionMax_min, settings.gapMin_h)});
    all.push_back({"Levels",
                   "from zero by a step of the device, or by 5 % where that is more; none at or above what "
                   "was too strong"});
    all.push_back({"Orders", settings.encodings.size() > 1
                                 ? "conditions drawn by the session’s seed before its first trial; encodings balanced "
                                   "by enrolment, one a session"
                                 : "conditions drawn by the session’s seed before its first trial"});
    all.push_back(
        {"Blind", settings.blind ? "the participant, and the operator until a session has ended" : "the participant"});
    return all;
}

std::string amendedWords(std::string_view key, Modality modality) {
    const auto* const found = std::ranges::find(kNames, key, &SettingName::key);
    if (found == std::end(kNames)) return std::string(key);
    const auto words = modality == Modality::Massager ? found->withMassager : found->words;
    return std::string(words.empty() ? key : words);
}

}  // namespace tacto
