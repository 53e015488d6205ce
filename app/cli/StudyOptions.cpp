#include "app/cli/StudyOptions.h"

#include "app/cli/Command.h"
#include "app/cli/ProfileOption.h"
#include "app/cli/StudyPassphrase.h"
#include "app/run/StudyProgram.h"

namespace tacto::cli {

namespace {

Result<void> takeSets(const QCommandLineParser& parser, StudySettings& settings) {
    for (const auto& set : parser.values("set")) {
        const auto text = set.toStdString();
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            return fail(ErrorCode::InvalidArgument, "--set {}: KEY=VALUE is expected", text);
        if (auto done = setStudyField(settings, text.substr(0, equals), text.substr(equals + 1)); !done) return done;
    }
    return {};
}

/// With what --set changes and what this program and --profile are.
Result<StudySettings> asSetHere(const QCommandLineParser& parser, StudySettings settings) {
    if (!settings.procedure) settings.procedure.emplace();
    if (!settings.painCeiling) settings.painCeiling = kPainCeiling;
    if (auto taken = takeSets(parser, settings); !taken) return failure(taken);
    const auto profile = profileOption(parser);
    if (!profile) return failure(profile);
    if (auto stated = stateProgram(settings, *profile); !stated) return failure(stated);
    return settings;
}

Result<int> scoreGiven(const QCommandLineParser& parser, const char* name, int least, int most) {
    bool isNumber = false;
    const int score = parser.value(name).toInt(&isNumber);
    if (isNumber && score >= least && score <= most) return score;
    if (!parser.isSet(name)) return fail(ErrorCode::InvalidArgument, "--{} is missing", name);
    return fail(ErrorCode::InvalidArgument, "--{} is \"{}\"; a whole number from {} to {} is expected", name,
                parser.value(name).toStdString(), least, most);
}

}  // namespace

void declareStudyOptions(QCommandLineParser& parser) {
    parser.addOption({"title", "Title of the study.", "T"});
    parser.addOption({"approval", "Reference of the committee's approval.", "REF"});
    parser.addOption({"from", "First day of the approval, as 2026-11-21.", "DATE"});
    parser.addOption({"expires", "Its last day.", "DATE"});
    parser.addOption({"consent-version", "Version of the consent form in force.", "V"});
    parser.addOption(
        {"set", "A setting of the study: blocks=3, electrode.area_cm2=5, license=CC-BY-4.0.", "KEY=VALUE"});
    parser.addOption({"profile", "Profile that its sessions are run with; the shipped one where left out.", "FILE"});
    parser.addOption({"reference", "Reference of the committee's amendment.", "REF"});
    parser.addOption({"virtual", "Enrols a virtual participant of this seed.", "SEED"});
    parser.addOption({"version", "Version of the consent form that was signed.", "V"});
    parser.addOption({"date", "Day on which it was signed.", "DATE"});
    parser.addOption({"by", "The investigator's initials.", "INITIALS"});
    parser.addOption({"confirm",
                      "The code once more: the participant's records are lost for good. Of go-back the word that it "
                      "names: newer rows of the ledger are.",
                      "WORD"});
    parser.addOption({"session", "Number of the participant's session; the last where left out.", "N"});
    parser.addOption({"what", "What happened; never a name.", "TEXT"});
    parser.addOption(
        {"severity", QString::fromStdString("How severe it was: " + scaleText(kEventSeverities) + "."), "1..4"});
    parser.addOption({"relation",
                      QString::fromStdString("How it is related to the stimulation: " + scaleText(kRelations) + "."),
                      "1..5"});
    parser.addOption({"serious", "It was a serious adverse event."});
    parser.addOption({"action", "What was done.", "TEXT"});
    parser.addOption({"outcome", "What became of it.", "TEXT"});
    parser.addOption({"reported", "It was reported to the committee."});
    parser.addOption({"group", "intact, or \"limb difference\"; intact where left out.", "GROUP"});
    parser.addOption({"age", "Age in whole years, where the approval asks for it.", "YEARS"});
    parser.addOption({"sex", "female, male or other, where the approval asks for it.", "SEX"});
    parser.addOption({"handedness", "right, left or ambidextrous, where the approval asks for it.", "HAND"});
    parser.addOption({"erythema", "Redness of the skin on a day after, 0 to 4.", "0..4"});
    parser.addOption({"oedema", "Swelling of the skin on a day after, 0 to 4.", "0..4"});
    parser.addOption({"side-effect", "What was noticed by then, its severity 1 to 4 and relation 1 to 5: redness:2:4.",
                      "ITEM:SEVERITY:RELATION"});
    declarePassphrase(parser);
    parser.addOption({"json", "Prints one JSON value."});
}

std::string given(const QCommandLineParser& parser, const char* name) {
    return parser.value(name).trimmed().toStdString();
}

Result<CalibrationDate> dateGiven(const QCommandLineParser& parser, const char* name) {
    const auto text = given(parser, name);
    if (const auto date = parseDate(text)) return *date;
    return fail(ErrorCode::InvalidArgument, "--{} is \"{}\"; a day as 2026-11-21 is expected", name, text);
}

Result<StudySettings> settingsGiven(const QCommandLineParser& parser) {
    StudySettings settings;
    settings.title = given(parser, "title");
    settings.approval.reference = given(parser, "approval");
    settings.consentVersion = given(parser, "consent-version");
    for (const char* name : {"title", "approval", "consent-version"}) {
        if (given(parser, name).empty()) return fail(ErrorCode::InvalidArgument, "--{} is missing", name);
    }
    const auto from = dateGiven(parser, "from");
    if (!from) return failure(from);
    const auto expires = dateGiven(parser, "expires");
    if (!expires) return failure(expires);
    settings.approval.from = *from;
    settings.approval.expires = *expires;
    return asSetHere(parser, std::move(settings));
}

Result<StudySettings> settingsAmended(const QCommandLineParser& parser, StudySettings settings) {
    if (given(parser, "reference").empty()) return fail(ErrorCode::InvalidArgument, "--reference is missing");
    for (const auto& [name, day] :
         {std::pair{"from", &settings.approval.from}, std::pair{"expires", &settings.approval.expires}}) {
        if (!parser.isSet(name)) continue;
        const auto date = dateGiven(parser, name);
        if (!date) return failure(date);
        *day = *date;
    }
    if (parser.isSet("consent-version")) settings.consentVersion = given(parser, "consent-version");
    return asSetHere(parser, std::move(settings));
}

Result<Participant> participantGiven(const QCommandLineParser& parser) {
    Participant participant;
    if (parser.isSet("group")) {
        const auto word = given(parser, "group");
        const auto group = valueFor(kParticipantGroups, word);
        if (!group) {
            return fail(ErrorCode::InvalidArgument, "--group is \"{}\"; {} or {} is expected", word,
                        kParticipantGroups[0].text, kParticipantGroups[1].text);
        }
        participant.group = *group;
    }
    participant.age = given(parser, "age");
    participant.sex = given(parser, "sex");
    participant.handedness = given(parser, "handedness");
    return participant;
}

Result<NextDay> nextDayGiven(const QCommandLineParser& parser) {
    NextDay said;
    for (const auto& [name, score] : {std::pair{"erythema", &said.erythema}, std::pair{"oedema", &said.oedema}}) {
        const auto given = scoreGiven(parser, name, 0, 4);
        if (!given) return failure(given);
        *score = *given;
    }
    for (const auto& text : parser.values("side-effect")) {
        auto effect = sideEffectFrom(text.toStdString());
        if (!effect) return failure(effect);
        said.sideEffects.push_back(std::move(*effect));
    }
    if (auto sound = checkNextDay(said); !sound) return failure(sound);
    return said;
}

Result<AdverseEvent> adverseEventGiven(const QCommandLineParser& parser) {
    AdverseEvent event;
    event.what = given(parser, "what");
    if (event.what.empty()) return fail(ErrorCode::InvalidArgument, "--what is missing");
    const auto severity = scoreGiven(parser, "severity", 1, 4);
    if (!severity) return failure(severity);
    const auto relation = scoreGiven(parser, "relation", 1, 5);
    if (!relation) return failure(relation);
    event.severity = *severity;
    event.relation = *relation;
    event.serious = parser.isSet("serious");
    event.reported = parser.isSet("reported");
    event.action = given(parser, "action");
    event.outcome = given(parser, "outcome");
    return event;
}

}  // namespace tacto::cli
