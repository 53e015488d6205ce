#include "app/run/OpenedStudy.h"

#include <algorithm>

#include "app/run/VirtualPerson.h"
#include "core/base/JsonText.h"

namespace tacto {

namespace {

bool isSimulated(const DeviceUri& uri) { return uri.scheme == "sim"; }

bool isMassager(const DeviceUri& uri) { return uri.scheme == "hid" || (isSimulated(uri) && uri.path == "massager"); }

/// Returns the modality in the settings, or nothing if the study decides.
std::optional<Modality> wantedModality(const RunOrder& order) {
    return valueFor(kModalities, textOr(order.settings.parameters, "modality"));
}

Result<Study> rehearsalFor(const RunOrder& order, const std::filesystem::path& folder) {
    StudySettings settings;
    const bool massager = std::ranges::any_of(order.uris, isMassager);
    settings.modality = wantedModality(order).value_or(massager ? Modality::Massager : Modality::Electrodes);
    return Study::createRehearsal(folder, std::move(settings));
}

Result<Study> existing(const PilotOrder& pilot) {
    auto opened = Study::open(pilot.study, pilot.passphrase ? &*pilot.passphrase : nullptr, Study::Access::Change);
    if (!opened || opened->hasKey()) return opened;
    return fail(ErrorCode::NotFound, "the study in {} is sealed; --passphrase-file is expected", pilot.study.string());
}

/// Returns the participant of a rehearsal, even if the program died after the enrolment and before the consent.
Result<Participant> enrolledByItself(OpenedStudy& opened, const std::string& name, std::uint64_t seed) {
    auto& study = opened.study;
    auto found = study.find(name);
    if (!found) {
        Participant enrolled;
        enrolled.virtualSeed = seed;
        found = study.enrol(std::move(enrolled));
        if (!found) return failure(found);
    }
    if (!found->consents.empty()) return found;
    const Consent consent{study.settings().consentVersion, study.today(), "simulated"};
    if (auto given = study.consent(found->code, consent); !given) return failure(given);
    found = study.find(name);
    if (found)
        opened.remarks.push_back(name + " was enrolled as " + found->code +
                                 " and consented by itself, as it does in rehearsals only.");
    return found;
}

}  // namespace

Result<OpenedStudy> openStudyFor(const RunOrder& order, const PilotOrder& pilot) {
    const auto participant = textOr(order.settings.parameters, "participant");
    if (participant.empty())
        return fail(ErrorCode::NotFound, "no participant is named; --set participant=CODE or virtual:SEED is expected");
    if (pilot.study.empty())
        return fail(ErrorCode::NotFound, "no study is named; --out with the study's folder is expected");
    const auto seed = virtualSeed(participant);
    if (!seed) return failure(seed);
    if (*seed && !std::ranges::all_of(order.uris, isSimulated))
        return fail(kGateRefused, "{} is a virtual participant; only simulated devices are accepted", participant);
    const bool isThere = Study::isThere(pilot.study);
    if (!isThere && !*seed)
        return fail(ErrorCode::NotFound, "there is no study in {}; study create makes one", pilot.study.string());
    auto study = isThere ? existing(pilot) : rehearsalFor(order, pilot.study);
    if (!study) return failure(study);
    OpenedStudy opened{std::move(*study), {}, {}};
    if (!isThere)
        opened.remarks.push_back("A rehearsal was made in " + pilot.study.string() +
                                 (pilot.people == nullptr ? "; its participants are simulated." : "."));
    const auto modality = opened.study.settings().modality;
    if (const auto wanted = wantedModality(order); wanted && *wanted != modality)
        return fail(kGateRefused, "modality is {}; {}, that of the study in {}, is expected", nameOf(*wanted),
                    nameOf(modality), pilot.study.string());
    auto found = *seed && opened.study.isRehearsal() ? enrolledByItself(opened, participant, **seed)
                                                     : opened.study.find(participant);
    if (!found) return failure(found);
    opened.who = std::move(*found);
    if (!opened.who.virtualSeed && pilot.people == nullptr)
        return fail(ErrorCode::NotFound, "{} is a person, who needs the window: tactoscope, Pilot", opened.who.code);
    if (!opened.study.isRehearsal() && order.settings.given.contains("blocks"))
        return fail(kGateRefused, "the number of blocks is the study's, {}; --set blocks is for rehearsals",
                    opened.study.settings().blocks);
    return opened;
}

}  // namespace tacto
